package gazed.spy;

/**
 * A pinhole with radial distortion (Brown 1966), as fixation_t has it: focal length and centre in pixels, k1 and k2. Tangential
 * distortion and k3 are not in the message; a robot that has them is drawn without.
 */
record Lens(double focalPx, double centreX, double centreY, double k1, double k2) {
  /** Steps of the fixed point that undoes the distortion: each makes the error some k1 r^2 times smaller. */
  private static final int STEPS = 30;

  /** The pixel that a direction (optical frame: x right, y down, z forward) is seen at; null where it is not seen, or no number. */
  double[] project(double[] direction) {
    if (!(direction[2] > 0)) return null;
    double x = direction[0] / direction[2], y = direction[1] / direction[2];
    double r2 = x * x + y * y;
    // Where the polynomial falls again, it shows what the lens does not see.
    if (!(1 + 3 * k1 * r2 + 5 * k2 * r2 * r2 > 0)) return null;
    double factor = 1 + k1 * r2 + k2 * r2 * r2;
    double u = centreX + focalPx * factor * x, v = centreY + focalPx * factor * y;
    return Double.isFinite(u) && Double.isFinite(v) ? new double[] {u, v} : null;
  }

  /** The direction with z = 1 that is seen at a pixel. */
  double[] direction(double[] pixel) {
    double seenX = (pixel[0] - centreX) / focalPx, seenY = (pixel[1] - centreY) / focalPx;
    double x = seenX, y = seenY;
    for (int i = 0; i < STEPS; ++i) {
      double r2 = x * x + y * y;
      double factor = 1 + k1 * r2 + k2 * r2 * r2;
      x = seenX / factor;
      y = seenY / factor;
    }
    return new double[] {x, y, 1};
  }
}

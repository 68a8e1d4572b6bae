package gazed.spy;

import java.awt.geom.AffineTransform;
import java.awt.geom.Rectangle2D;
import java.util.List;

/** Which part of a plane is drawn, and where its metres lie in the component. */
record PlanScale(double pixelsPerMetre, double left, double bottom, int height) {
  /** About the robot so much is always seen, metres. */
  private static final Rectangle2D ROBOT = new Rectangle2D.Double(-0.2, -0.2, 0.5, 0.5);
  /** No further than this, metres: what is wrong by kilometres does not make the rest a dot. */
  private static final double FARTHEST_M = 12;
  /** The edges move in such steps, so that the picture stands still from one fixation to the next. */
  private static final double STEP_M = 0.2;
  private static final double MARGIN = 0.06;

  /** Shows the robot, what was located, and the fixation that is looked at. */
  static PlanScale fit(Plane plane, List<Fixation> fixations, Fixation chosen, int width, int height) {
    Rectangle2D box = (Rectangle2D) ROBOT.clone();
    for (Fixation fixation : fixations) {
      if (!fixation.hasPosition() || (fixation != chosen && fixation.outcome() != Outcome.LOCATED)) continue;
      double[] p = fixation.point().position_m;
      double reach = Ellipse.sigmas(0.95);
      double du = reach * Math.sqrt(Math.max(0, plane.uu(fixation.point().covariance_m2)));
      double dv = reach * Math.sqrt(Math.max(0, plane.vv(fixation.point().covariance_m2)));
      include(box, plane.u(p) - du, plane.v(p) - dv);
      include(box, plane.u(p) + du, plane.v(p) + dv);
    }
    double left = Math.floor(box.getMinX() / STEP_M) * STEP_M, right = Math.ceil(box.getMaxX() / STEP_M) * STEP_M;
    double bottom = Math.floor(box.getMinY() / STEP_M) * STEP_M, top = Math.ceil(box.getMaxY() / STEP_M) * STEP_M;
    double scale = Math.min(width / (right - left), height / (top - bottom)) * (1 - 2 * MARGIN);
    return new PlanScale(scale, (left + right) / 2 - width / scale / 2, (bottom + top) / 2 - height / scale / 2, height);
  }

  private static void include(Rectangle2D box, double u, double v) {
    if (Double.isFinite(u) && Double.isFinite(v)) {
      box.add(Math.max(-FARTHEST_M, Math.min(FARTHEST_M, u)), Math.max(-FARTHEST_M, Math.min(FARTHEST_M, v)));
    }
  }

  double x(double u) {
    return (u - left) * pixelsPerMetre;
  }

  double y(double v) {
    return height - (v - bottom) * pixelsPerMetre;
  }

  /** For shapes in metres. */
  AffineTransform toScreen() {
    return new AffineTransform(pixelsPerMetre, 0, 0, -pixelsPerMetre, x(0), y(0));
  }

  /** The distance between grid lines: 1, 2 or 5 times a power of ten metres, at least so many pixels. */
  double gridStep(int pixelsMin) {
    double step = Math.pow(10, Math.floor(Math.log10(pixelsMin / pixelsPerMetre)));
    for (double factor : new double[] {1, 2, 5}) {
      if (factor * step * pixelsPerMetre >= pixelsMin) return factor * step;
    }
    return 10 * step;
  }
}

package gazed.spy;

import java.awt.Shape;
import java.awt.geom.AffineTransform;
import java.awt.geom.Ellipse2D;

/** The ellipse that holds a share of a two-dimensional normal distribution. */
final class Ellipse {
  private Ellipse() {}

  /** How many sigmas it reaches: in two dimensions the share inside of k is 1 - exp(-k^2/2). 68 %: 1.51; 95 %: 2.45. */
  static double sigmas(double share) {
    return Math.sqrt(-2 * Math.log(1 - share));
  }

  /**
   * The ellipse about (x, y) of a covariance {{xx, xy}, {xy, yy}}, in the same units; null for one that is none (not finite, or negative
   * in some direction).
   */
  static Shape of(double x, double y, double xx, double xy, double yy, double share) {
    double mean = (xx + yy) / 2;
    double difference = Math.hypot((xx - yy) / 2, xy);
    double greater = mean + difference, lesser = mean - difference;
    // Rounding may take what is flat a little below 0.
    if (lesser < 0 && lesser > -1e-9 * greater) lesser = 0;
    if (!(lesser >= 0) || !Double.isFinite(greater) || !Double.isFinite(x) || !Double.isFinite(y)) return null;
    double a = sigmas(share) * Math.sqrt(greater), b = sigmas(share) * Math.sqrt(lesser);
    AffineTransform place = AffineTransform.getTranslateInstance(x, y);
    place.rotate(Math.atan2(2 * xy, xx - yy) / 2);
    return place.createTransformedShape(new Ellipse2D.Double(-a, -b, 2 * a, 2 * b));
  }
}

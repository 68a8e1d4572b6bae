package gazed.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.awt.Shape;
import java.util.Random;
import org.junit.Test;

public class EllipseTest {
  private static final double ROUNDING = 1e-9;
  /** Four standard deviations of a share of 0.68 in 100000 draws. */
  private static final double SHARE_NOISE = 0.006;

  @Test
  public void holdsTheShareOfADistributionThatItSays() {
    // x = 3 a + b, y = b: variances 10 and 1, covariance 1.
    Random random = new Random(1);
    int draws = 100_000;
    for (double share : new double[] {0.68, 0.95}) {
      Shape ellipse = Ellipse.of(2, -1, 10, 1, 1, share);
      int inside = 0;
      for (int i = 0; i < draws; ++i) {
        double b = random.nextGaussian();
        if (ellipse.contains(2 + 3 * random.nextGaussian() + b, -1 + b)) ++inside;
      }
      assertEquals(share, inside / (double) draws, SHARE_NOISE);
    }
  }

  @Test
  public void alongAnAxisItReachesSoManySigmas() {
    // Quantiles of chi-square with two degrees of freedom: 5.991 for 95 %.
    assertEquals(Math.sqrt(5.991), Ellipse.sigmas(0.95), 1e-3);
    assertEquals(2 * Ellipse.sigmas(0.95) * 3, Ellipse.of(0, 0, 9, 0, 1, 0.95).getBounds2D().getWidth(), ROUNDING);
  }

  @Test
  public void aFlatOneIsALine() {
    assertTrue(Ellipse.of(0, 0, 4, 2, 1, 0.68).getBounds2D().getWidth() > 0);
  }

  @Test
  public void noCovarianceGivesNone() {
    assertNull(Ellipse.of(0, 0, Double.NaN, 0, 1, 0.68));
    assertNull(Ellipse.of(0, 0, 1, 2, 1, 0.68));
    assertNull(Ellipse.of(0, 0, -1, 0, -1, 0.68));
    assertNull(Ellipse.of(Double.POSITIVE_INFINITY, 0, 1, 0, 1, 0.68));
  }
}

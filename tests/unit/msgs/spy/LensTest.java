package gazed.spy;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public class LensTest {
  /** The fixed point has converged to rounding. */
  private static final double ROUNDING_PX = 1e-6;

  private final Lens lens = new Lens(600, 320, 240, -0.12, 0.03);

  @Test
  public void directionAndProjectAreEachOthersInverse() {
    for (double[] pixel : new double[][] {{320, 240}, {0, 0}, {639, 479}, {12.5, 400.25}}) {
      assertArrayEquals(pixel, lens.project(lens.direction(pixel)), ROUNDING_PX);
    }
  }

  @Test
  public void distortionMovesAPixelByItsPolynomial() {
    // r = 0.5: 1 - 0.12 * 0.25 + 0.03 * 0.0625 = 0.971875.
    assertArrayEquals(new double[] {320 + 600 * 0.5 * 0.971875, 240}, lens.project(new double[] {0.5, 0, 1}), ROUNDING_PX);
  }

  @Test
  public void whatIsBehindOrBeyondTheLensIsNotSeen() {
    assertNull(lens.project(new double[] {0, 0, -1}));
    assertNull(lens.project(new double[] {1, 0, 0}));
    assertNull(lens.project(new double[] {Double.NaN, 0, Double.NaN}));
    // 1 - 3 * 0.3 r^2 is negative: the polynomial folds back.
    assertNull(new Lens(600, 320, 240, -0.3, 0).project(new double[] {1.5, 0, 1}));
  }
}

package gazed.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import gazed.fixation_t;
import gazed.look_t;
import java.util.List;
import org.junit.Test;

public class EpipolarLineTest {
  private static final double ROUNDING_PX = 1e-6;
  /** Between two of the line's points it is straight; the lens bends it by less than this. */
  private static final double BEND_PX = 0.1;

  private static fixation_t robot(double k1) {
    fixation_t fixation = new fixation_t();
    fixation.robot = new double[] {608, 319.5, 239.5, k1, 0, 0, 0, 0, 0.05871, 0, 0.06364, 0, 0};
    return fixation;
  }

  private static look_t look(double yaw, double pitch) {
    look_t look = new look_t();
    look.refined_rad = new double[] {yaw, pitch};
    return look;
  }

  @Test
  public void passesThroughThePlaceWhereAPointOfTheRayIsSeen() {
    fixation_t fixation = robot(-0.1);
    BelievedRobot robot = BelievedRobot.of(fixation);
    look_t first = look(0.05, 0.1), later = look(-0.2, 0.25);
    first.pixel = new double[] {400, 300};
    double[] ray = robot.lens().direction(first.pixel);
    for (double depth : new double[] {0.2, 0.5, 3}) {
      double[] torso = robot.torsoFromCam(first).apply(new double[] {depth * ray[0], depth * ray[1], depth});
      double[] seen = robot.lens().project(robot.torsoFromCam(later).inverse().apply(torso));
      assertTrue(distance(EpipolarLine.of(fixation, first, later), seen) < BEND_PX);
    }
  }

  @Test
  public void withoutABaselineItIsOnePoint() {
    look_t first = look(0.1, 0.1);
    first.pixel = new double[] {100, 200};
    for (double[] pixel : EpipolarLine.of(robot(0), first, look(0.1, 0.1))) {
      assertEquals(100, pixel[0], ROUNDING_PX);
      assertEquals(200, pixel[1], ROUNDING_PX);
    }
  }

  @Test
  public void aTargetThatWasNotFoundGivesNoLine() {
    look_t first = look(0, 0);
    first.pixel = new double[] {Double.NaN, Double.NaN};
    assertTrue(EpipolarLine.of(robot(0), first, look(0.3, 0)).isEmpty());
  }

  @Test
  public void whatLiesBehindTheLaterLookIsLeftOut() {
    look_t first = look(0, 0);
    first.pixel = new double[] {319.5, 239.5};
    assertTrue(EpipolarLine.of(robot(0), first, look(2.0, 0)).isEmpty());
  }

  private static double distance(List<double[]> line, double[] pixel) {
    double least = Double.POSITIVE_INFINITY;
    for (int i = 1; i < line.size(); ++i) {
      double[] a = line.get(i - 1), b = line.get(i);
      least = Math.min(least, java.awt.geom.Line2D.ptSegDist(a[0], a[1], b[0], b[1], pixel[0], pixel[1]));
    }
    return least;
  }
}

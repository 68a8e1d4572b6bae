package gazed.spy;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertSame;

import gazed.fixation_t;
import gazed.look_t;
import org.junit.Test;

public class BelievedRobotTest {
  /** The expected numbers have eight digits. */
  private static final double ROUNDING_M = 1e-8;

  private static fixation_t v5() {
    fixation_t fixation = new fixation_t();
    // agent/geometry, "Profiles": nao-v5, without its pitch, as tests/unit/agent/geometry/head_test.cpp has it.
    fixation.robot = new double[] {557, 309.4, 230.6, 0, 0, 0, 0, 0, 0.05871, 0, 0.06364, 0, 0};
    return fixation;
  }

  @Test
  public void cameraStandsWhereTheChainOfGazedSaysIt() {
    BelievedRobot robot = BelievedRobot.of(v5());
    // tests/unit/agent/geometry/head_test.cpp.
    assertArrayEquals(new double[] {0.06704841, 0.02074050, 0.17720756}, robot.torsoFromCam(0.3, 0.2).translation(), ROUNDING_M);
    assertArrayEquals(new double[] {0.01135296, -0.01768118, 0.21049643}, robot.torsoFromCam(-1.0, -0.5).translation(), ROUNDING_M);
  }

  @Test
  public void zerosAreAddedToWhatTheSensorsSay() {
    fixation_t fixation = v5();
    fixation.robot[11] = 0.1;
    fixation.robot[12] = -0.2;
    assertArrayEquals(BelievedRobot.of(v5()).torsoFromCam(0.3, 0.2).translation(), BelievedRobot.of(fixation).torsoFromCam(0.2, 0.4).translation(), ROUNDING_M);
  }

  @Test
  public void aTorsoThatMovedTakesTheCameraAlong() {
    look_t look = new look_t();
    look.torso_rad = new double[] {0, 0, Math.PI / 2};
    look.torso_m = new double[] {1, 2, 3};
    double[] standing = BelievedRobot.of(v5()).torsoFromCam(0, 0).translation();
    // A quarter turn to the left: x becomes y.
    assertArrayEquals(new double[] {1 - standing[1], 2 + standing[0], 3 + standing[2]}, BelievedRobot.of(v5()).torsoFromCam(look).translation(), ROUNDING_M);
  }

  @Test
  public void robotOfNoNumbersIsTheUnknownOne() {
    fixation_t fixation = v5();
    fixation.robot[4] = Double.NaN;
    assertSame(BelievedRobot.UNKNOWN, BelievedRobot.of(fixation));
    assertSame(BelievedRobot.UNKNOWN, BelievedRobot.of(new fixation_t()));
  }
}

package gazed.spy;

import gazed.head_state_t;
import java.awt.geom.AffineTransform;

/** Where what was seen in one image appears in another, after the head has turned. */
final class Turn {
  /** Between pixels that are so far apart the mapping counts as linear. */
  private static final double APART_PX = 60;

  private Turn() {}

  /**
   * Pixels of the image taken at `then` to those of the one taken at `now`, near a pixel: exact for a distant thing, and off by a few
   * pixels for a near one, whose direction changes with the camera's place too. No turn where angles are missing (null); null where what
   * was seen has left the picture's half of the world.
   */
  static AffineTransform between(BelievedRobot robot, head_state_t then, head_state_t now, double x, double y) {
    if (then == null || now == null) return new AffineTransform();
    Pose nowFromThen = robot.torsoFromCam(now.yaw_rad, now.pitch_rad).inverse().times(robot.torsoFromCam(then.yaw_rad, then.pitch_rad));
    double[] origin = moved(robot, nowFromThen, x, y);
    double[] right = moved(robot, nowFromThen, x + APART_PX, y), below = moved(robot, nowFromThen, x, y + APART_PX);
    if (origin == null || right == null || below == null) return null;
    double xx = (right[0] - origin[0]) / APART_PX, yx = (right[1] - origin[1]) / APART_PX;
    double xy = (below[0] - origin[0]) / APART_PX, yy = (below[1] - origin[1]) / APART_PX;
    return new AffineTransform(xx, yx, xy, yy, origin[0] - xx * x - xy * y, origin[1] - yx * x - yy * y);
  }

  private static double[] moved(BelievedRobot robot, Pose nowFromThen, double x, double y) {
    return robot.lens().project(nowFromThen.rotate(robot.lens().direction(new double[] {x, y})));
  }
}

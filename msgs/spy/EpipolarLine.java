package gazed.spy;

import gazed.fixation_t;
import gazed.look_t;
import java.util.ArrayList;
import java.util.List;

/** Where in a later look the target of look 1 may appear, from close by to infinity: a line, bent by the lens. */
final class EpipolarLine {
  /** Nearer than this nothing is looked at: the head would touch it. */
  private static final double NEAREST_M = 0.1;
  /** So many pieces look smooth in 400 pixels. */
  private static final int PIECES = 64;

  private EpipolarLine() {}

  /** Pixels of the later look, from the nearest to infinity; those that its camera does not see are left out. */
  static List<double[]> of(fixation_t fixation, look_t first, look_t later) {
    BelievedRobot robot = BelievedRobot.of(fixation);
    double[] ray = robot.lens().direction(first.pixel);
    double length = Math.sqrt(ray[0] * ray[0] + ray[1] * ray[1] + 1);
    Pose laterFromFirst = robot.torsoFromCam(later).inverse().times(robot.torsoFromCam(first));
    double[] turned = laterFromFirst.rotate(ray);
    List<double[]> line = new ArrayList<>();
    for (int i = 0; i <= PIECES; ++i) {
      // Even steps of the inverse range are nearly even steps along the line.
      double inverseRange = (1 - i / (double) PIECES) / NEAREST_M;
      double[] point = new double[3];
      for (int k = 0; k < 3; ++k) point[k] = turned[k] / length + laterFromFirst.translation()[k] * inverseRange;
      double[] pixel = robot.lens().project(point);
      if (pixel != null) line.add(pixel);
    }
    return line;
  }
}

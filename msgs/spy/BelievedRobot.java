package gazed.spy;

import gazed.fixation_t;
import gazed.look_t;

/** The camera and the head as fixation_t believes them: where the camera is at given angles, what its lens does. */
record BelievedRobot(Lens lens, double[] mountRotation, double[] mountOffset, double[] zeros) {
  /** From the torso's origin up to where the axes of the head's joints meet, the same in every NAO: Aldebaran documentation, "Links". */
  private static final double NECK_M = 0.1265;

  /** x forward, y left, z up are the optical z, -x, -y. */
  private static final Pose HEAD_AXES_FROM_OPTICAL_AXES = Pose.turned(new double[][] {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}});

  /** What a NAO V6 is before anybody calibrates it, for a robot that has told nothing yet: agent/geometry, "Profiles". */
  static final BelievedRobot UNKNOWN =
      new BelievedRobot(new Lens(608, 319.5, 239.5, 0, 0), new double[3], new double[] {0.05871, 0, 0.06364}, new double[2]);

  static BelievedRobot of(fixation_t fixation) {
    double[] r = fixation.robot;
    for (double value : r) {
      if (!Double.isFinite(value)) return UNKNOWN;
    }
    if (!(r[0] > 0)) return UNKNOWN;
    return new BelievedRobot(new Lens(r[0], r[1], r[2], r[3], r[4]), new double[] {r[5], r[6], r[7]}, new double[] {r[8], r[9], r[10]},
        new double[] {r[11], r[12]});
  }

  /** What the sensors say, or should have said, and the zeros are added here. */
  Pose torsoFromCam(double yaw, double pitch) {
    Pose mount = Pose.translation(mountOffset[0], mountOffset[1], mountOffset[2]).times(Pose.aboutZ(mountRotation[2]))
        .times(Pose.aboutY(mountRotation[1])).times(Pose.aboutX(mountRotation[0])).times(HEAD_AXES_FROM_OPTICAL_AXES);
    return Pose.translation(0, 0, NECK_M).times(Pose.aboutZ(yaw + zeros[0])).times(Pose.aboutY(pitch + zeros[1])).times(mount);
  }

  /** The camera of a look in the torso frame of look 1: the torso may have moved since. */
  Pose torsoFromCam(look_t look) {
    Pose turned = Pose.rotationVector(look.torso_rad);
    Pose moved = new Pose(turned.rotation(), look.torso_m);
    return moved.times(torsoFromCam(look.refined_rad[0], look.refined_rad[1]));
  }
}

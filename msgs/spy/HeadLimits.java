package gazed.spy;

/** Where a NAO's head may go. The numbers are those of agent/geometry/limits.cpp, with their source; a test compares them. */
final class HeadLimits {
  static final double YAW_MAX = 2.08567;
  static final double PITCH_MIN = -0.671952;
  static final double PITCH_MAX = 0.514872;

  /** Yaw (of either sign), least and greatest pitch; linear between the rows. Radians. */
  static final double[][] ROWS = {
    {0.0, -0.671951, 0.515047},
    {0.486074, -0.671951, 0.422021},
    {0.756077, -0.548033, 0.370010},
    {0.903033, -0.479965, 0.330041},
    {1.089958, -0.430049, 0.300022},
    {1.526988, -0.330041, 0.200015},
    {2.086017, -0.449073, 0.330041}
  };

  private HeadLimits() {}

  /** Around the allowed angles once: {yaw, pitch}, from the least yaw along the upper side (least pitch) and back. */
  static double[][] outline() {
    int rows = ROWS.length;
    double[][] outline = new double[4 * rows - 2][];
    int n = 0;
    for (int i = rows - 1; i > 0; --i) outline[n++] = corner(-1, ROWS[i], 1);
    for (int i = 0; i < rows; ++i) outline[n++] = corner(1, ROWS[i], 1);
    for (int i = rows - 1; i > 0; --i) outline[n++] = corner(1, ROWS[i], 2);
    for (int i = 0; i < rows; ++i) outline[n++] = corner(-1, ROWS[i], 2);
    return outline;
  }

  private static double[] corner(int side, double[] row, int column) {
    return new double[] {side * Math.min(row[0], YAW_MAX), Math.max(PITCH_MIN, Math.min(PITCH_MAX, row[column]))};
  }
}

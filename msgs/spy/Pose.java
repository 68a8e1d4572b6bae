package gazed.spy;

/** A rigid motion: takes coordinates of one frame to those of another, p -> rotation p + translation. Metres. */
record Pose(double[][] rotation, double[] translation) {
  static Pose translation(double x, double y, double z) {
    return new Pose(new double[][] {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, new double[] {x, y, z});
  }

  static Pose aboutX(double angle) {
    double c = Math.cos(angle), s = Math.sin(angle);
    return turned(new double[][] {{1, 0, 0}, {0, c, -s}, {0, s, c}});
  }

  static Pose aboutY(double angle) {
    double c = Math.cos(angle), s = Math.sin(angle);
    return turned(new double[][] {{c, 0, s}, {0, 1, 0}, {-s, 0, c}});
  }

  static Pose aboutZ(double angle) {
    double c = Math.cos(angle), s = Math.sin(angle);
    return turned(new double[][] {{c, -s, 0}, {s, c, 0}, {0, 0, 1}});
  }

  static Pose turned(double[][] rotation) {
    return new Pose(rotation, new double[3]);
  }

  /** Rodrigues' formula; the angle is the vector's length. */
  static Pose rotationVector(double[] v) {
    double angle = Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    // sin(a)/a and (1 - cos a)/a^2; below this angle their series' first terms are exact in double.
    boolean small = angle < 1e-8;
    double a = small ? 1 : Math.sin(angle) / angle;
    double b = small ? 0.5 : (1 - Math.cos(angle)) / (angle * angle);
    double[][] cross = {{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
    double[][] r = new double[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double square = 0;
        for (int k = 0; k < 3; ++k) square += cross[i][k] * cross[k][j];
        r[i][j] = (i == j ? 1 : 0) + a * cross[i][j] + b * square;
      }
    }
    return turned(r);
  }

  double[] rotate(double[] v) {
    double[] result = new double[3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) result[i] += rotation[i][j] * v[j];
    }
    return result;
  }

  double[] apply(double[] point) {
    double[] result = rotate(point);
    for (int i = 0; i < 3; ++i) result[i] += translation[i];
    return result;
  }

  /** a_from_b.times(b_from_c) is a_from_c. */
  Pose times(Pose inner) {
    double[][] r = new double[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) r[i][j] += rotation[i][k] * inner.rotation[k][j];
      }
    }
    return new Pose(r, apply(inner.translation));
  }

  Pose inverse() {
    double[][] transposed = new double[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) transposed[i][j] = rotation[j][i];
    }
    double[] back = turned(transposed).rotate(translation);
    return new Pose(transposed, new double[] {-back[0], -back[1], -back[2]});
  }
}

package gazed.spy;

/** From which side the torso frame (x forward, y left, z up) is looked at. On paper: u to the right, v up, metres. */
enum Plane {
  /** The robot looks up the page: u is -y, v is x. */
  ABOVE(1, -1, 0),
  /** The robot looks to the right: u is x, v is z. */
  SIDE(0, 1, 2);

  private final int uAxis;
  private final double uSign;
  private final int vAxis;

  Plane(int uAxis, double uSign, int vAxis) {
    this.uAxis = uAxis;
    this.uSign = uSign;
    this.vAxis = vAxis;
  }

  double u(double[] point) {
    return uSign * point[uAxis];
  }

  double v(double[] point) {
    return point[vAxis];
  }

  /** Of a covariance in the torso frame. */
  double uu(double[][] covariance) {
    return covariance[uAxis][uAxis];
  }

  double vv(double[][] covariance) {
    return covariance[vAxis][vAxis];
  }

  double uv(double[][] covariance) {
    return uSign * (covariance[uAxis][vAxis] + covariance[vAxis][uAxis]) / 2;
  }
}

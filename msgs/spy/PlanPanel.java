package gazed.spy;

import gazed.look_t;
import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.Shape;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.awt.geom.Rectangle2D;
import java.util.List;
import java.util.Locale;
import javax.swing.JComponent;

/**
 * The torso frame from above or from the side: the robot, what its camera sees now, the points of the listed fixations with their
 * uncertainties, and of the chosen one also the places from which it was looked at.
 */
final class PlanPanel extends JComponent {
  private static final int GRID_PX = 55;
  private static final int OTHERS_ALPHA = 60;
  private static final double DEFAULT_WIDTH_PX = 640, DEFAULT_HEIGHT_PX = 480;
  /** Where lines that go on for ever end, metres. */
  private static final double FAR_M = 50;

  private final Plane plane;
  private Robot.Sight sight;
  private Fixation chosen;

  PlanPanel(Plane plane) {
    this.plane = plane;
  }

  void show(Robot.Sight next, Fixation fixation) {
    if (sight != null && next.head() == sight.head() && next.fixations() == sight.fixations() && fixation == chosen) return;
    sight = next;
    chosen = fixation;
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D g = Drawing.on(Palette.PANEL, graphics, this);
    g.clipRect(0, 0, getWidth(), getHeight());
    List<Fixation> fixations = sight == null ? List.of() : sight.fixations();
    PlanScale scale = PlanScale.fit(plane, fixations, chosen, getWidth(), getHeight());
    drawGrid(g, scale);
    drawViewCone(g, scale);
    RobotFigure.draw(g, plane, scale);
    for (int i = fixations.size() - 1; i >= 0; --i) {
      if (fixations.get(i) != chosen) drawPoint(g, scale, fixations.get(i), false);
    }
    if (chosen != null) {
      drawLooks(g, scale);
      drawPoint(g, scale, chosen, true);
      drawRange(g, scale);
    }
    g.dispose();
  }

  private void drawGrid(Graphics2D g, PlanScale scale) {
    double step = scale.gridStep(GRID_PX);
    String unit = step < 1 ? "%.1f m" : "%.0f m";
    g.setStroke(new BasicStroke(1));
    g.setFont(Palette.SMALL);
    for (double v = Math.ceil(scale.bottom() / step) * step; scale.y(v) > 0; v += step) {
      drawGridLine(g, new Line2D.Double(0, scale.y(v), getWidth(), scale.y(v)));
      // The corner has the other axis's label.
      if (scale.y(v) < getHeight() - 24) drawLabel(g, String.format(Locale.ROOT, unit, v), 3, scale.y(v) - 3);
    }
    for (double u = Math.ceil(scale.left() / step) * step; scale.x(u) < getWidth(); u += step) {
      drawGridLine(g, new Line2D.Double(scale.x(u), 0, scale.x(u), getHeight()));
      double shown = plane == Plane.ABOVE ? -u : u;
      if (scale.x(u) < getWidth() - 40) drawLabel(g, String.format(Locale.ROOT, unit, shown), scale.x(u) + 3, getHeight() - 4);
    }
  }

  private static void drawGridLine(Graphics2D g, Line2D line) {
    g.setColor(Palette.GRID);
    g.draw(line);
  }

  private static void drawLabel(Graphics2D g, String text, double x, double y) {
    g.setColor(Palette.FAINT);
    // Rounding leaves a -0.
    g.drawString(text.matches("-0(\\.0)? m") ? text.substring(1) : text, (float) x, (float) y);
  }

  /** What the camera sees: between the rays of the picture's edges, at the newest measured head angles. */
  private void drawViewCone(Graphics2D g, PlanScale scale) {
    if (sight == null || sight.head() == null) return;
    BelievedRobot robot = sight.believed();
    Pose camera = robot.torsoFromCam(sight.head().yaw_rad, sight.head().pitch_rad);
    double[] centre = camera.translation();
    double width = sight.image() != null ? sight.image().width : DEFAULT_WIDTH_PX;
    double height = sight.image() != null ? sight.image().height : DEFAULT_HEIGHT_PX;
    boolean above = plane == Plane.ABOVE;
    double[][] edges = above ? new double[][] {{-0.5, height / 2}, {width - 0.5, height / 2}}
                             : new double[][] {{width / 2, -0.5}, {width / 2, height - 0.5}};
    Path2D cone = new Path2D.Double();
    cone.moveTo(scale.x(plane.u(centre)), scale.y(plane.v(centre)));
    for (double[] edge : edges) {
      double[] ray = robot.lens().direction(edge);
      double[] far = camera.apply(new double[] {FAR_M * ray[0], FAR_M * ray[1], FAR_M});
      if (!Double.isFinite(plane.u(far)) || !Double.isFinite(plane.v(far))) return;
      cone.lineTo(scale.x(plane.u(far)), scale.y(plane.v(far)));
    }
    cone.closePath();
    g.setColor(Palette.VIEW_CONE);
    g.fill(cone);
  }

  /** The others are thin lines: twenty that lie on each other are still to be told apart. */
  private void drawPoint(Graphics2D g, PlanScale scale, Fixation fixation, boolean strong) {
    if (!fixation.hasPosition()) return;
    double[] p = fixation.point().position_m;
    double[][] c = fixation.point().covariance_m2;
    Color colour = fixation.outcome().colour;
    for (double share : new double[] {0.95, 0.68}) {
      Shape metres = Ellipse.of(plane.u(p), plane.v(p), plane.uu(c), plane.uv(c), plane.vv(c), share);
      if (metres == null) continue;
      Shape ellipse = scale.toScreen().createTransformedShape(metres);
      if (strong) {
        g.setColor(Palette.faded(colour, share == 0.68 ? 60 : 25));
        g.fill(ellipse);
      }
      g.setColor(Palette.faded(colour, strong ? 255 : OTHERS_ALPHA));
      g.setStroke(new BasicStroke(strong ? 2 : 1));
      g.draw(ellipse);
    }
    Drawing.dot(g, scale.x(plane.u(p)), scale.y(plane.v(p)), strong ? 3.5 : 2, Palette.faded(colour, strong ? 255 : OTHERS_ALPHA));
  }

  /** The cameras of the chosen fixation's looks, their rays to the point, and the answer of the report's steps. */
  private void drawLooks(Graphics2D g, PlanScale scale) {
    if (chosen.account() == null) return;
    BelievedRobot robot = BelievedRobot.of(chosen.account());
    for (look_t look : chosen.account().looks) {
      double[] centre = robot.torsoFromCam(look).translation();
      if (!Double.isFinite(plane.u(centre)) || !Double.isFinite(plane.v(centre))) continue;
      double x = scale.x(plane.u(centre)), y = scale.y(plane.v(centre));
      if (look.used && chosen.hasPosition()) {
        g.setColor(Palette.faded(Palette.CAMERA, 90));
        g.setStroke(new BasicStroke(1));
        g.draw(new Line2D.Double(x, y, scale.x(plane.u(chosen.point().position_m)), scale.y(plane.v(chosen.point().position_m))));
      }
      Drawing.dot(g, x, y, 3, look.used ? Palette.CAMERA : Palette.CORNER_REJECTED);
    }
    double[] report = chosen.account().report_position_m;
    double x = scale.x(plane.u(report)), y = scale.y(plane.v(report));
    if (!Double.isFinite(x) || !Double.isFinite(y)) return;
    g.setColor(Palette.REPORT);
    g.setStroke(new BasicStroke(2));
    g.draw(new Line2D.Double(x - 4, y - 4, x + 4, y + 4));
    g.draw(new Line2D.Double(x - 4, y + 4, x + 4, y - 4));
  }

  /** Beside the ellipses where there is room, above them otherwise. */
  private void drawRange(Graphics2D g, PlanScale scale) {
    if (!chosen.hasPosition()) return;
    double[] p = chosen.point().position_m;
    double[][] c = chosen.point().covariance_m2;
    Shape metres = Ellipse.of(plane.u(p), plane.v(p), plane.uu(c), plane.uv(c), plane.vv(c), 0.95);
    double x = scale.x(plane.u(p)), y = scale.y(plane.v(p)), besideX = x, aboveY = y;
    if (metres != null) {
      Rectangle2D bounds = scale.toScreen().createTransformedShape(metres).getBounds2D();
      besideX = bounds.getMaxX();
      aboveY = bounds.getMinY();
    }
    g.setFont(Palette.BOLD);
    g.setColor(chosen.outcome().colour);
    String text = Words.range(chosen);
    int width = g.getFontMetrics().stringWidth(text);
    boolean beside = besideX + width + 12 < getWidth();
    double left = beside ? besideX + 8 : Math.min(x - width / 2.0, getWidth() - width - 4.0);
    double base = beside ? y - 4 : aboveY - 6;
    g.drawString(text, (float) Math.max(4, left), (float) Math.max(14, Math.min(base, getHeight() - 20)));
  }
}

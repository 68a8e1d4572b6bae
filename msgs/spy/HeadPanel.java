package gazed.spy;

import gazed.look_t;
import java.awt.BasicStroke;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import javax.swing.JComponent;

/** Where the head is within where it may be: yaw to the left and pitch down, as the robot itself would point. */
final class HeadPanel extends JComponent {
  private static final double YAW_SHOWN = 2.3, PITCH_SHOWN = 0.85;
  private static final double STEP_RAD = 0.5;
  private static final int TEXT_PX = 18;

  private Robot.Sight sight;
  private Fixation chosen;

  void show(Robot.Sight next, Fixation fixation) {
    if (sight != null && next.head() == sight.head() && next.command() == sight.command() && fixation == chosen) return;
    sight = next;
    chosen = fixation;
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D g = Drawing.on(Palette.PANEL, graphics, this);
    g.setFont(Palette.SMALL);
    drawGrid(g);
    drawLimits(g);
    if (chosen != null && chosen.account() != null) {
      for (look_t look : chosen.account().looks) {
        Drawing.dot(g, x(look.measured_rad[0]), y(look.measured_rad[1]), 3, look.used ? Palette.CAMERA : Palette.CORNER_REJECTED);
      }
    }
    if (sight != null && sight.command() != null) {
      g.setColor(Palette.COMMAND);
      g.setStroke(new BasicStroke(2));
      double x = x(sight.command().yaw_rad), y = y(sight.command().pitch_rad);
      g.draw(new java.awt.geom.Rectangle2D.Double(x - 6, y - 6, 12, 12));
    }
    g.setColor(Palette.TEXT);
    if (sight == null || sight.head() == null) {
      g.drawString("no head angles come", 4, getHeight() - 4);
    } else {
      Drawing.dot(g, x(sight.head().yaw_rad), y(sight.head().pitch_rad), 5, Palette.TEXT);
      g.drawString("yaw " + Words.angle(sight.head().yaw_rad) + "   pitch " + Words.angle(sight.head().pitch_rad), 4, getHeight() - 4);
    }
    g.dispose();
  }

  /** The same scale both ways. */
  private double scale() {
    return Math.min(getWidth() / (2 * YAW_SHOWN), (getHeight() - TEXT_PX) / (2 * PITCH_SHOWN));
  }

  private double x(double yaw) {
    return getWidth() / 2.0 - yaw * scale();
  }

  private double y(double pitch) {
    return (getHeight() - TEXT_PX) / 2.0 + pitch * scale();
  }

  private void drawGrid(Graphics2D g) {
    g.setStroke(new BasicStroke(1));
    for (double yaw = -2; yaw <= 2; yaw += STEP_RAD) {
      g.setColor(Palette.GRID);
      g.draw(new Line2D.Double(x(yaw), y(-PITCH_SHOWN), x(yaw), y(PITCH_SHOWN)));
      g.setColor(Palette.FAINT);
      if (Math.abs(yaw) % 1 == 0) g.drawString(String.format(Locale.ROOT, "%.0f", yaw), (float) x(yaw) + 3, (float) y(PITCH_SHOWN) - 3);
    }
    for (double pitch = -0.5; pitch <= 0.5; pitch += STEP_RAD) {
      g.setColor(Palette.GRID);
      g.draw(new Line2D.Double(x(YAW_SHOWN), y(pitch), x(-YAW_SHOWN), y(pitch)));
      g.setColor(Palette.FAINT);
      g.drawString(String.format(Locale.ROOT, "%.1f", pitch), (float) x(YAW_SHOWN) + 3, (float) y(pitch) - 3);
    }
  }

  private void drawLimits(Graphics2D g) {
    List<double[]> corners = new ArrayList<>();
    for (double[] corner : HeadLimits.outline()) corners.add(new double[] {x(corner[0]), y(corner[1])});
    Path2D path = Drawing.path(corners, true);
    g.setColor(Palette.VIEW_CONE);
    g.fill(path);
    g.setColor(Palette.ROBOT);
    g.setStroke(new BasicStroke(1.5f));
    g.draw(path);
  }
}

package gazed.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.RenderingHints;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.util.List;
import javax.swing.JComponent;

/** Marks and lines that several panels draw. */
final class Drawing {
  private Drawing() {}

  static Graphics2D smooth(Graphics graphics) {
    Graphics2D g = (Graphics2D) graphics.create();
    g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
    g.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON);
    g.setRenderingHint(RenderingHints.KEY_INTERPOLATION, RenderingHints.VALUE_INTERPOLATION_BILINEAR);
    g.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE);
    g.setFont(Palette.PLAIN);
    return g;
  }

  /** To paint a component's contents, on that ground; to be disposed of. */
  static Graphics2D on(Color ground, Graphics graphics, JComponent component) {
    Graphics2D g = smooth(graphics);
    g.setColor(ground);
    g.fillRect(0, 0, component.getWidth(), component.getHeight());
    return g;
  }

  /** From point to point. */
  static Path2D path(List<double[]> points, boolean closed) {
    Path2D path = new Path2D.Double();
    for (double[] point : points) {
      if (path.getCurrentPoint() == null) {
        path.moveTo(point[0], point[1]);
      } else {
        path.lineTo(point[0], point[1]);
      }
    }
    if (closed) path.closePath();
    return path;
  }

  /** Over a picture of any colour: a dark edge about it. */
  static void cross(Graphics2D g, double x, double y, double arm, Color colour) {
    Line2D across = new Line2D.Double(x - arm, y, x + arm, y), down = new Line2D.Double(x, y - arm, x, y + arm);
    for (boolean edge : new boolean[] {true, false}) {
      g.setColor(edge ? Color.BLACK : colour);
      g.setStroke(new BasicStroke(edge ? 5 : 3));
      g.draw(across);
      g.draw(down);
    }
  }

  static void ring(Graphics2D g, double x, double y, double radius, Color colour) {
    Ellipse2D ring = new Ellipse2D.Double(x - radius, y - radius, 2 * radius, 2 * radius);
    g.setColor(Color.BLACK);
    g.setStroke(new BasicStroke(5));
    g.draw(ring);
    g.setColor(colour);
    g.setStroke(new BasicStroke(3));
    g.draw(ring);
  }

  static void dot(Graphics2D g, double x, double y, double radius, Color colour) {
    g.setColor(colour);
    g.fill(new Ellipse2D.Double(x - radius, y - radius, 2 * radius, 2 * radius));
  }

  /** A sentence in the middle of what is empty so far. */
  static void message(Graphics2D g, String text, int width, int height, Color colour) {
    g.setColor(colour);
    int y = height / 2;
    for (String line : text.split("\n")) {
      g.drawString(line, (width - g.getFontMetrics().stringWidth(line)) / 2, y);
      y += g.getFontMetrics().getHeight();
    }
  }
}

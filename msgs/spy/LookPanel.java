package gazed.spy;

import bot_core.image_t;
import gazed.look_t;
import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.geom.Path2D;
import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;
import javax.swing.JComponent;

/** One look of a fixation: its picture, the target, its outline, the epipolar line that it was searched along, the followed corners. */
final class LookPanel extends JComponent {
  /** Where neither picture nor camera tells, what the camera of a NAO gives. */
  private static final int WIDTH_PX = 640, HEIGHT_PX = 480;

  private final CachedPicture picture = new CachedPicture();
  private look_t look;
  private List<double[]> line = List.of();

  /** `image` and `look` may be null; `line` is empty in the first look. */
  void show(image_t image, look_t next, List<double[]> epipolarLine) {
    look = next;
    line = epipolarLine;
    picture.set(image);
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D g = Drawing.on(Palette.NO_PICTURE, graphics, this);
    if (look == null) {
      Drawing.message(g, "no such look", getWidth(), getHeight(), Color.WHITE);
    } else {
      paint(g);
    }
    g.dispose();
  }

  private void paint(Graphics2D g) {
    BufferedImage image = picture.picture();
    int width = image != null ? image.getWidth() : WIDTH_PX, height = image != null ? image.getHeight() : HEIGHT_PX;
    PictureArea area = PictureArea.fit(width, height, getWidth(), getHeight());
    g.clip(area.edge());
    if (image != null) area.drawPicture(g, image);
    drawCorners(g, area);
    drawPath(g, area, line, false, Palette.EPIPOLAR);
    if (Double.isFinite(look.epipole[0]) && Double.isFinite(look.epipole[1])) {
      Drawing.dot(g, area.x(look.epipole[0]), area.y(look.epipole[1]), 5, Palette.EPIPOLAR);
    }
    drawPath(g, area, outline(), true, Palette.TARGET);
    if (Double.isFinite(look.pixel[0]) && Double.isFinite(look.pixel[1])) {
      Drawing.cross(g, area.x(look.pixel[0]), area.y(look.pixel[1]), 8, Palette.TARGET);
    }
    if (image == null) area.drawCaption(g, picture.fault().isEmpty() ? "no image of this look came" : picture.fault());
  }

  private void drawCorners(Graphics2D g, PictureArea area) {
    for (int i = 0; i < look.ncorners; ++i) {
      boolean used = look.corner_used[i] != 0;
      double x = area.x(look.corner_px[i][0]), y = area.y(look.corner_px[i][1]);
      if (!Double.isFinite(x) || !Double.isFinite(y)) continue;
      Drawing.dot(g, x, y, 3.5, Color.BLACK);
      Drawing.dot(g, x, y, 2.5, used ? Palette.CORNER : Palette.CORNER_REJECTED);
    }
  }

  private List<double[]> outline() {
    List<double[]> outline = new ArrayList<>();
    for (float[] point : look.outline_px) {
      if (Float.isFinite(point[0]) && Float.isFinite(point[1])) outline.add(new double[] {point[0], point[1]});
    }
    return outline;
  }

  private static void drawPath(Graphics2D g, PictureArea area, List<double[]> pixels, boolean closed, Color colour) {
    if (pixels.size() < 2) return;
    List<double[]> points = new ArrayList<>();
    for (double[] pixel : pixels) points.add(new double[] {area.x(pixel[0]), area.y(pixel[1])});
    Path2D path = Drawing.path(points, closed);
    g.setColor(Palette.faded(Color.BLACK, 120));
    g.setStroke(new BasicStroke(4, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND));
    g.draw(path);
    g.setColor(colour);
    g.setStroke(new BasicStroke(2, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND));
    g.draw(path);
  }
}

package gazed.spy;

import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Image;
import java.awt.geom.AffineTransform;
import java.awt.geom.Rectangle2D;

/**
 * Where the pixels of a picture lie within a component: as large as fits, centred. Pixel (0, 0) is the centre of the top left pixel, as in
 * the messages.
 */
record PictureArea(double scale, double left, double top, int width, int height) {
  static PictureArea fit(int width, int height, int componentWidth, int componentHeight) {
    double scale = Math.min(componentWidth / (double) width, componentHeight / (double) height);
    return new PictureArea(scale, (componentWidth - scale * width) / 2, (componentHeight - scale * height) / 2, width, height);
  }

  Rectangle2D edge() {
    return new Rectangle2D.Double(left, top, width * scale, height * scale);
  }

  AffineTransform toScreen() {
    return new AffineTransform(scale, 0, 0, scale, x(0), y(0));
  }

  void drawPicture(Graphics2D g, Image picture) {
    int right = (int) Math.round(left + width * scale), bottom = (int) Math.round(top + height * scale);
    int x = (int) Math.round(left), y = (int) Math.round(top);
    g.drawImage(picture, x, y, right - x, bottom - y, null);
  }

  /** In the lower left corner. */
  void drawCaption(Graphics2D g, String words) {
    g.setFont(Palette.SMALL);
    g.setColor(Color.WHITE);
    g.drawString(words, (float) left + 8, (float) edge().getMaxY() - 8);
  }

  double x(double pixel) {
    return left + (pixel + 0.5) * scale;
  }

  double y(double pixel) {
    return top + (pixel + 0.5) * scale;
  }
}

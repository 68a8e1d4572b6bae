package gazed.spy;

import gazed.saliency_map_t;
import java.awt.Graphics2D;
import java.awt.geom.AffineTransform;
import java.awt.image.BufferedImage;

/** The saliency map as a veil over the picture: nothing where it is 0, densest at its peak. */
final class HeatMap {
  /** saliency_map_t: cell (i, j) is centred on pixel (16 i, 16 j). */
  static final int CELL_PX = 16;
  /** A choice: of the peak's colour so much, and the rest of the picture beneath it. */
  private static final double DENSEST = 0.7;

  private final BufferedImage veil;

  private HeatMap(BufferedImage veil) {
    this.veil = veil;
  }

  /** Null for a map whose sizes do not fit each other. */
  static HeatMap of(saliency_map_t map) {
    if (map.width < 1 || map.height < 1 || map.map.length != map.width * map.height) return null;
    BufferedImage veil = new BufferedImage(map.width, map.height, BufferedImage.TYPE_INT_ARGB);
    int colour = Palette.MAP.getRGB() & 0xffffff;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        int alpha = (int) Math.round(DENSEST * (map.map[y * map.width + x] & 0xff));
        veil.setRGB(x, y, alpha << 24 | colour);
      }
    }
    return new HeatMap(veil);
  }

  int widthPx() {
    return veil.getWidth() * CELL_PX;
  }

  int heightPx() {
    return veil.getHeight() * CELL_PX;
  }

  /** `turn`: from pixels of the map's own view to those of the picture. */
  void draw(Graphics2D g, PictureArea area, AffineTransform turn) {
    Graphics2D clipped = (Graphics2D) g.create();
    clipped.clip(area.edge());
    clipped.transform(area.toScreen());
    clipped.transform(turn);
    // Cell (0, 0) is centred on pixel (0, 0), and on (0.5, 0.5) of the veil.
    clipped.scale(CELL_PX, CELL_PX);
    clipped.translate(-0.5, -0.5);
    clipped.drawImage(veil, 0, 0, null);
    clipped.dispose();
  }
}

package gazed.spy;

import gazed.head_state_t;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.geom.AffineTransform;
import java.awt.geom.Point2D;
import java.awt.image.BufferedImage;
import javax.swing.JComponent;

/** What the camera sees now, and over it what stood out in the newest view: the heat map and its winner. */
final class CameraPanel extends JComponent {
  private final CachedPicture picture = new CachedPicture();
  private Robot.Sight sight;
  private HeatMap map;
  private boolean mapShown = true;

  void show(Robot.Sight next) {
    if (sight != null && next.image() == sight.image() && next.map() == sight.map() && next.imageFault() == sight.imageFault()
        && next.headAtImage() == sight.headAtImage()) return;
    if (next.map() == null) {
      map = null;
    } else if (sight == null || next.map() != sight.map()) {
      map = HeatMap.of(next.map());
    }
    sight = next;
    picture.set(next.image());
    repaint();
  }

  void setMapShown(boolean shown) {
    mapShown = shown;
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D g = Drawing.on(Palette.NO_PICTURE, graphics, this);
    paint(g);
    g.dispose();
  }

  private void paint(Graphics2D g) {
    BufferedImage image = picture.picture();
    if (image == null && map == null) {
      Drawing.message(g, whyNothing(), getWidth(), getHeight(), Color.WHITE);
      return;
    }
    PictureArea area = image != null ? PictureArea.fit(image.getWidth(), image.getHeight(), getWidth(), getHeight())
                                     : PictureArea.fit(map.widthPx(), map.heightPx(), getWidth(), getHeight());
    g.clip(area.edge());
    if (image != null) area.drawPicture(g, image);
    drawWhatStoodOut(g, area);
    String words = image == null ? whyNothing().replace('\n', ' ') : sight.imageFault();
    if (words != null) area.drawCaption(g, words);
  }

  /** The map is of a view some moments ago: it goes with the things that stood out when the head turns away from them. */
  private void drawWhatStoodOut(Graphics2D g, PictureArea area) {
    if (sight.map() == null) return;
    double x = sight.map().peak_px[0], y = sight.map().peak_px[1];
    boolean hasWinner = Double.isFinite(x) && Double.isFinite(y);
    head_state_t now = sight.image() == null ? sight.headAtMap() : sight.headAtImage();
    AffineTransform turn = hasWinner ? Turn.between(sight.believed(), sight.headAtMap(), now, x, y) : new AffineTransform();
    if (turn == null) return;
    if (map != null && mapShown) map.draw(g, area, turn);
    if (!hasWinner) return;
    Point2D winner = turn.transform(new Point2D.Double(x, y), null);
    Drawing.ring(g, area.x(winner.getX()), area.y(winner.getY()), 12, Palette.WINNER);
  }

  private String whyNothing() {
    if (sight == null) return "";
    if (!picture.fault().isEmpty()) return picture.fault();
    if (sight.imageFault() != null) return sight.imageFault();
    return "no images come:\npublish.images = true in gazed's configuration";
  }
}

package gazed.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.FontMetrics;
import java.awt.Graphics2D;
import java.awt.Graphics;
import java.awt.geom.RoundRectangle2D;
import java.util.List;
import javax.swing.JComponent;

/** What the colours of a panel mean, in as many lines as its width needs. */
final class Legend extends JComponent {
  record Entry(Color colour, String words) {}

  private static final int SAMPLE = 12, GAP = 5, BETWEEN = 14, LINE = 18;

  private final List<Entry> entries;

  Legend(Entry... entries) {
    this.entries = List.of(entries);
    setFont(Palette.SMALL);
  }

  @Override
  public Dimension getPreferredSize() {
    int width = getParent() == null ? 400 : getParent().getWidth();
    return new Dimension(width, lines(null, Math.max(width, 100)) * LINE + 4);
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D g = Drawing.smooth(graphics);
    g.setFont(getFont());
    lines(g, getWidth());
    g.dispose();
  }

  /** Draws them where there is something to draw on; how many lines they take. */
  private int lines(Graphics2D g, int width) {
    FontMetrics font = getFontMetrics(getFont());
    int x = 8, line = 0;
    for (Entry entry : entries) {
      int wide = SAMPLE + GAP + font.stringWidth(entry.words());
      if (x > 8 && x + wide > width) {
        x = 8;
        ++line;
      }
      if (g != null) {
        g.setColor(entry.colour());
        g.fill(new RoundRectangle2D.Double(x, line * LINE + 4, SAMPLE, SAMPLE - 1, 4, 4));
        g.setColor(Palette.TEXT);
        g.drawString(entry.words(), x + SAMPLE + GAP, line * LINE + 14);
      }
      x += wide + BETWEEN;
    }
    return line + 1;
  }
}

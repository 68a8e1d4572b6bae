package gazed.spy;

import java.awt.Color;
import java.awt.Font;

/** The colours and fonts of the window. Those of what is drawn over pictures differ for the colour-blind too (Wong 2011, after Okabe, Ito). */
final class Palette {
  static final Color WINDOW = new Color(0xeef0f3);
  static final Color PANEL = Color.WHITE;
  static final Color EDGE = new Color(0xd3d8df);
  static final Color GRID = new Color(0xe6e9ee);
  static final Color TEXT = new Color(0x1f2933);
  static final Color FAINT = new Color(0x66717f);
  static final Color FAULT = new Color(0xb3261e);
  static final Color NO_PICTURE = new Color(0x2b3440);

  static final Color MAP = new Color(0xffb000);
  static final Color WINNER = new Color(0xe6399b);
  static final Color TARGET = new Color(0x00c8ff);
  static final Color EPIPOLAR = new Color(0xa78bfa);
  static final Color CORNER = new Color(0x7ee081);
  static final Color CORNER_REJECTED = new Color(0xb4bac2);

  static final Color ROBOT = new Color(0x8b95a3);
  static final Color CAMERA = new Color(0x3b6fd4);
  static final Color VIEW_CONE = new Color(0x1c3b6fd4, true);
  static final Color COMMAND = new Color(0xb87400);
  static final Color REPORT = new Color(0x9333ea);

  static final Font PLAIN = new Font(Font.SANS_SERIF, Font.PLAIN, 13);
  static final Font BOLD = PLAIN.deriveFont(Font.BOLD);
  static final Font SMALL = PLAIN.deriveFont(11.5f);

  private Palette() {}

  static Color faded(Color colour, int alpha) {
    return new Color(colour.getRed(), colour.getGreen(), colour.getBlue(), alpha);
  }
}

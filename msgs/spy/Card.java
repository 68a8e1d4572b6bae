package gazed.spy;

import java.awt.BorderLayout;
import java.awt.Dimension;
import javax.swing.BorderFactory;
import javax.swing.JComponent;
import javax.swing.JLabel;
import javax.swing.JPanel;

/** A part of the window: a title, what it shows, and what its colours mean. */
final class Card extends JPanel {
  private final JLabel title = new JLabel();

  Card(String words, JComponent content, JComponent below) {
    super(new BorderLayout(0, 4));
    // What is in it takes the room that it gets.
    setPreferredSize(new Dimension(100, 100));
    setMinimumSize(new Dimension(50, 50));
    setBackground(Palette.PANEL);
    setBorder(BorderFactory.createCompoundBorder(BorderFactory.createLineBorder(Palette.EDGE), BorderFactory.createEmptyBorder(6, 8, 4, 8)));
    title.setFont(Palette.BOLD);
    title.setForeground(Palette.TEXT);
    setTitle(words);
    add(title, BorderLayout.NORTH);
    add(content, BorderLayout.CENTER);
    if (below != null) add(below, BorderLayout.SOUTH);
  }

  void setTitle(String words) {
    // A label of no words has no height, and the rest would jump.
    title.setText(words.isEmpty() ? " " : words);
    title.setToolTipText(words);
  }
}

package gazed.spy;

import gazed.status_t;
import java.awt.BorderLayout;
import java.awt.Dimension;
import java.awt.GridLayout;
import javax.swing.JLabel;
import javax.swing.JPanel;
import javax.swing.JTextArea;

/** How the daemon is, in words: its state, what it has done, what it costs, what is wrong. */
final class StatusPanel extends JPanel {
  private final JLabel state = new JLabel(" ");
  private final JLabel[] values;
  private final JTextArea fault = new JTextArea();
  private status_t shown;

  StatusPanel() {
    super(new BorderLayout(0, 6));
    setOpaque(false);
    state.setFont(Palette.BOLD.deriveFont(16f));
    add(state, BorderLayout.NORTH);
    String[] names = {"camera", "head", "frames", "fixations", "saliency", "locating", "processor", "memory"};
    JPanel rows = new JPanel(new GridLayout(names.length, 1, 0, 1));
    rows.setOpaque(false);
    values = new JLabel[names.length];
    for (int i = 0; i < names.length; ++i) {
      JPanel row = new JPanel(new BorderLayout(8, 0));
      row.setOpaque(false);
      JLabel name = new JLabel(names[i]);
      name.setFont(Palette.PLAIN);
      name.setForeground(Palette.FAINT);
      name.setPreferredSize(new Dimension(80, 17));
      values[i] = new JLabel();
      values[i].setFont(Palette.PLAIN);
      values[i].setForeground(Palette.TEXT);
      row.add(name, BorderLayout.WEST);
      row.add(values[i], BorderLayout.CENTER);
      rows.add(row);
    }
    JPanel middle = new JPanel(new BorderLayout());
    middle.setOpaque(false);
    middle.add(rows, BorderLayout.NORTH);
    add(middle, BorderLayout.WEST);
    fault.setLineWrap(true);
    fault.setWrapStyleWord(true);
    fault.setEditable(false);
    fault.setOpaque(false);
    fault.setFont(Palette.PLAIN);
    add(fault, BorderLayout.CENTER);
  }

  /** `silence`: how long nothing has come, in words; empty while it does. */
  void show(Robot.Sight sight, String silence) {
    status_t status = sight.status();
    state.setText(!silence.isEmpty() ? silence : status == null ? "no status comes" : status.state);
    boolean bad = !silence.isEmpty() || status != null && !status.fault.isEmpty();
    state.setForeground(bad ? Palette.FAULT : Palette.TEXT);
    if (status == null || status == shown) return;
    shown = status;
    String[] texts = {status.camera, status.head, status.frames + " taken, " + status.frames_dropped + " dropped",
        status.fixations + ", " + status.located + " located", Words.amount(status.saliency_ms, "ms a frame"),
        Words.amount(status.locate_ms, "ms from the last view"), Words.amount(status.cpu_percent, "% of a core"),
        Words.amount(status.resident_mb, "MB")};
    for (int i = 0; i < values.length; ++i) values[i].setText(texts[i]);
    fault.setForeground(status.fault.isEmpty() ? Palette.FAINT : Palette.FAULT);
    fault.setText(status.fault.isEmpty() ? "no faults" : status.fault);
  }
}

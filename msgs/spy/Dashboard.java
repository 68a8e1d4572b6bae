package gazed.spy;

import java.awt.BorderLayout;
import java.awt.Dimension;
import java.awt.FlowLayout;
import java.awt.GridBagConstraints;
import java.awt.GridBagLayout;
import java.awt.Insets;
import java.util.List;
import java.util.Locale;
import javax.swing.BorderFactory;
import javax.swing.DefaultComboBoxModel;
import javax.swing.JButton;
import javax.swing.JCheckBox;
import javax.swing.JComboBox;
import javax.swing.JComponent;
import javax.swing.JLabel;
import javax.swing.JPanel;
import javax.swing.JScrollPane;
import javax.swing.JTextArea;
import javax.swing.Timer;

/** The whole window: one robot's pictures, plans, head, fixations and status, of whichever of those that are heard is chosen. */
final class Dashboard extends JPanel {
  static final Dimension SIZE = new Dimension(1320, 900);
  /** A choice: a camera's 15 to 30 frames a second look smooth, and a laptop has time for other things. */
  private static final int PERIOD_MS = 33;
  /** gazed tells its status every second. */
  private static final double SILENT_S = 3;
  /** Of the height of pictures and plans together. */
  private static final double PICTURES_SHARE = 0.57;
  private static final int STATUS_PX = 430;

  private final Robots robots;
  private final JComboBox<String> prefixes = new JComboBox<>();
  private final CameraPanel camera = new CameraPanel();
  private final LookPanel first = new LookPanel();
  private final LookPanel last = new LookPanel();
  private final PlanPanel above = new PlanPanel(Plane.ABOVE);
  private final PlanPanel side = new PlanPanel(Plane.SIDE);
  private final HeadPanel head = new HeadPanel();
  private final FixationTable fixations = new FixationTable();
  private final StatusPanel status = new StatusPanel();
  private final JTextArea why = new JTextArea();
  private final JLabel outcome = new JLabel(" ");
  private final Card cameraCard;
  private final Card firstCard;
  private final Card lastCard;
  private final Timer timer = new Timer(PERIOD_MS, event -> refresh());
  private Fixation shown;

  Dashboard(Robots robots, String prefix) {
    super(new BorderLayout(6, 6));
    this.robots = robots;
    setBackground(Palette.WINDOW);
    setBorder(BorderFactory.createEmptyBorder(6, 6, 6, 6));
    cameraCard = new Card("Camera, now", camera, cameraLegend());
    firstCard = new Card("First look", first, new Legend(new Legend.Entry(Palette.TARGET, "target and its outline"),
        new Legend.Entry(Palette.CORNER, "corner followed"), new Legend.Entry(Palette.CORNER_REJECTED, "rejected")));
    lastCard = new Card("Last look", last, new Legend(new Legend.Entry(Palette.TARGET, "target, found again"),
        new Legend.Entry(Palette.EPIPOLAR, "epipolar line"), new Legend.Entry(Palette.CORNER, "corner followed")));
    add(bar(prefix), BorderLayout.NORTH);
    add(panels(), BorderLayout.CENTER);
    add(lists(), BorderLayout.SOUTH);
    name("camera", camera);
    name("first", first);
    name("last", last);
    name("above", above);
    name("side", side);
    name("head", head);
    name("robot", prefixes);
    name("fixations", fixations);
    name("status", status);
  }

  /** Begins to follow the messages; until stop(). */
  void start() {
    refresh();
    timer.start();
  }

  void stop() {
    timer.stop();
  }

  private static void name(String name, JComponent component) {
    component.setName("gazed." + name);
  }

  private JPanel cameraLegend() {
    JPanel below = new JPanel(new BorderLayout());
    below.setOpaque(false);
    JCheckBox map = new JCheckBox("map", true);
    map.setFont(Palette.SMALL);
    map.setOpaque(false);
    map.addActionListener(event -> camera.setMapShown(map.isSelected()));
    below.add(new Legend(new Legend.Entry(Palette.MAP, "how much it stands out"), new Legend.Entry(Palette.WINNER, "winner")), BorderLayout.CENTER);
    below.add(map, BorderLayout.EAST);
    return below;
  }

  private JPanel bar(String prefix) {
    JPanel bar = new JPanel(new BorderLayout());
    bar.setOpaque(false);
    JPanel left = new JPanel(new FlowLayout(FlowLayout.LEFT, 6, 0));
    left.setOpaque(false);
    JLabel label = new JLabel("Robot");
    label.setFont(Palette.BOLD);
    prefixes.setFont(Palette.PLAIN);
    prefixes.addItem(prefix);
    outcome.setFont(Palette.BOLD.deriveFont(15f));
    left.add(label);
    left.add(prefixes);
    left.add(outcome);
    JLabel network = new JLabel(Network.url());
    network.setFont(Palette.SMALL);
    network.setForeground(Palette.FAINT);
    bar.add(left, BorderLayout.WEST);
    bar.add(network, BorderLayout.EAST);
    return bar;
  }

  private JPanel panels() {
    JPanel grid = new JPanel(new GridBagLayout());
    grid.setOpaque(false);
    Legend.Entry[] plans = {new Legend.Entry(Outcome.LOCATED.colour, "located: 68 and 95 % ellipses"),
        new Legend.Entry(Outcome.UNCERTAIN.colour, "uncertain"),
        new Legend.Entry(Palette.CAMERA, "cameras, view"), new Legend.Entry(Palette.REPORT, "report's answer")};
    JComponent[] upper = {cameraCard, firstCard, lastCard};
    JComponent[] lower = {new Card("From above, x up, y to the left", above, new Legend(plans)),
        new Card("From the side, x to the right, z up", side, new Legend(plans)),
        new Card("Head within its limits, rad", head, new Legend(new Legend.Entry(Palette.TEXT, "measured"),
            new Legend.Entry(Palette.COMMAND, "commanded"), new Legend.Entry(Palette.CAMERA, "looks")))};
    for (int i = 0; i < upper.length; ++i) {
      grid.add(upper[i], place(i, 0, PICTURES_SHARE));
      grid.add(lower[i], place(i, 1, 1 - PICTURES_SHARE));
    }
    return grid;
  }

  /** Columns are equally wide, whatever is in them. */
  private static GridBagConstraints place(int column, int row, double heightShare) {
    int gap = row == 0 ? 6 : 0;
    return new GridBagConstraints(column, row, 1, 1, 1, heightShare, GridBagConstraints.CENTER, GridBagConstraints.BOTH,
        new Insets(0, column == 0 ? 0 : 6, gap, 0), 0, 0);
  }

  private JPanel lists() {
    JPanel lists = new JPanel(new BorderLayout(6, 6));
    lists.setOpaque(false);
    lists.setPreferredSize(new Dimension(100, 215));
    JButton newest = new JButton("Follow the newest");
    newest.setFont(Palette.SMALL);
    newest.addActionListener(event -> fixations.clearSelection());
    JPanel below = new JPanel(new BorderLayout(6, 0));
    below.setOpaque(false);
    why.setFont(Palette.SMALL);
    why.setLineWrap(true);
    why.setWrapStyleWord(true);
    why.setEditable(false);
    why.setOpaque(false);
    why.setRows(2);
    below.add(why, BorderLayout.CENTER);
    below.add(newest, BorderLayout.EAST);
    JScrollPane scroll = new JScrollPane(fixations);
    scroll.setBorder(BorderFactory.createLineBorder(Palette.EDGE));
    scroll.getViewport().setBackground(Palette.PANEL);
    lists.add(new Card("The last " + Robot.FIXATIONS_MAX + " fixations", scroll, below), BorderLayout.CENTER);
    Card state = new Card("Status", status, null);
    state.setPreferredSize(new Dimension(STATUS_PX, 100));
    lists.add(state, BorderLayout.EAST);
    return lists;
  }

  private void refresh() {
    for (String prefix : robots.prefixes()) {
      if (((DefaultComboBoxModel<String>) prefixes.getModel()).getIndexOf(prefix) < 0) prefixes.addItem(prefix);
    }
    Robot.Sight sight = robots.robot((String) prefixes.getSelectedItem()).sight();
    fixations.show(sight.fixations());
    Fixation chosen = fixations.chosen();
    if (chosen == null && !sight.fixations().isEmpty()) chosen = sight.fixations().get(0);
    camera.show(sight);
    above.show(sight, chosen);
    side.show(sight, chosen);
    head.show(sight, chosen);
    status.show(sight, silence(sight));
    if (chosen != shown) showFixation(chosen);
  }

  private void showFixation(Fixation fixation) {
    shown = fixation;
    if (fixation == null) {
      first.show(null, null, List.of());
      last.show(null, null, List.of());
      outcome.setText(" ");
      why.setText("");
      return;
    }
    boolean both = fixation.firstLook() != null && fixation.lastLook() != null;
    first.show(fixation.first(), fixation.firstLook(), List.of());
    List<double[]> line = both ? EpipolarLine.of(fixation.account(), fixation.firstLook(), fixation.lastLook()) : List.of();
    last.show(fixation.last(), fixation.lastLook(), line);
    String number = "Fixation " + fixation.number();
    firstCard.setTitle(number + ", first look");
    lastCard.setTitle(number + ", last look" + (both && !fixation.lastLook().used ? ": " + fixation.lastLook().reason : ""));
    outcome.setText(number + ": " + fixation.outcome().words + (fixation.hasPosition() ? ", " + Words.range(fixation) : ""));
    outcome.setForeground(fixation.outcome().colour);
    why.setText(Words.reason(fixation));
  }

  private static String silence(Robot.Sight sight) {
    if (sight.changes() == 0) return "nothing has come yet";
    double seconds = (System.nanoTime() - sight.heardNs()) * 1e-9;
    return seconds < SILENT_S ? "" : String.format(Locale.ROOT, "nothing comes for %.0f s", seconds);
  }
}

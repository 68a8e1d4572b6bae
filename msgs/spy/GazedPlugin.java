package gazed.spy;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.located_point_t;
import gazed.saliency_map_t;
import gazed.status_t;
import java.awt.Window;
import java.awt.event.ActionEvent;
import java.awt.event.HierarchyEvent;
import java.io.IOException;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.JOptionPane;
import javax.swing.SwingUtilities;
import javax.swing.plaf.basic.BasicInternalFrameUI;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/**
 * What lcm-spy finds: it makes one of each class in its jars that implements SpyPlugin itself and has a public constructor, asks it for the
 * name of its action (with nulls), and runs the action when a channel that it can handle is double-clicked.
 */
public final class GazedPlugin implements SpyPlugin {
  private static final String NAME = "gazed: see it";

  private final Robots robots = new Robots();
  private boolean listens;

  public GazedPlugin() {}

  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == image_t.LCM_FINGERPRINT || fingerprint == saliency_map_t.LCM_FINGERPRINT
        || fingerprint == located_point_t.LCM_FINGERPRINT || fingerprint == fixation_t.LCM_FINGERPRINT
        || fingerprint == status_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction(NAME) {
      @Override
      public void actionPerformed(ActionEvent event) {
        open(desktop, Channel.of(channel.name).prefix());
      }
    };
  }

  @Override
  public String toString() {
    return NAME;
  }

  private void open(JDesktopPane desktop, String prefix) {
    if (!listens()) return;
    Dashboard dashboard = new Dashboard(robots, prefix);
    JInternalFrame frame = new JInternalFrame();
    // lcm-spy's window has a title and an edge already.
    ((BasicInternalFrameUI) frame.getUI()).setNorthPane(null);
    frame.setBorder(null);
    frame.add(dashboard);
    frame.setVisible(true);
    desktop.add(frame);
    enlarge(SwingUtilities.getWindowAncestor(desktop));
    try {
      frame.setMaximum(true);
    } catch (java.beans.PropertyVetoException nobodyVetoes) {
      throw new IllegalStateException(nobodyVetoes);
    }
    // lcm-spy hides its window when it is closed, and throws it away with all that is in it.
    desktop.addHierarchyListener(change -> {
      if ((change.getChangeFlags() & HierarchyEvent.SHOWING_CHANGED) == 0) return;
      if (desktop.isShowing()) {
        dashboard.start();
      } else {
        dashboard.stop();
      }
    });
    dashboard.start();
  }

  /** All windows share one connection, which is made for the first of them. */
  private boolean listens() {
    if (listens) return true;
    try {
      Network.join(robots);
      listens = true;
      return true;
    } catch (IOException | RuntimeException fault) {
      JOptionPane.showMessageDialog(null, "No LCM network at " + Network.url() + ": " + fault.getMessage(), NAME, JOptionPane.ERROR_MESSAGE);
      return false;
    }
  }

  /** lcm-spy makes it 500x400; as much of the screen as the panels like to have, or there is. */
  private static void enlarge(Window window) {
    java.awt.Rectangle screen = window.getGraphicsConfiguration().getBounds();
    int width = Math.min(Dashboard.SIZE.width, screen.width), height = Math.min(Dashboard.SIZE.height, screen.height);
    window.setSize(width, height);
    int left = Math.min(window.getX(), screen.x + screen.width - width), top = Math.min(window.getY(), screen.y + screen.height - height);
    window.setLocation(Math.max(screen.x, left), Math.max(screen.y, top));
    window.validate();
  }
}

package gazed.spy;

import java.awt.Component;
import java.awt.Container;
import java.awt.Frame;
import java.awt.Point;
import java.awt.Rectangle;
import java.awt.Window;
import java.awt.event.InputEvent;
import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import javax.swing.JTable;
import javax.swing.SwingUtilities;

/** The real lcm-spy of this process, operated by the mouse and looked at on the screen, as people do. */
final class SpyWindow {
  /** Enough for a machine that is busy with other tests; what is there is found at once. */
  private static final int PATIENCE_S = 120;
  private static final int LOOK_AGAIN_MS = 100;
  private static final int LOOKS_AFTER_A_CLICK = 50;
  private static final int ATTEMPTS = 20;

  private final java.awt.Robot user;
  private final JTable channels;

  SpyWindow(String... arguments) throws Exception {
    user = new java.awt.Robot();
    Start.main(arguments);
    channels = until("lcm-spy shows its table of channels", () -> {
      for (Frame frame : Frame.getFrames()) {
        List<JTable> tables = all(frame, JTable.class);
        if (frame.getTitle().equals("LCM Spy") && frame.isShowing() && !tables.isEmpty()) return tables.get(0);
      }
      return null;
    });
  }

  /** Waits for something that is not null; what is done is done in Swing's thread. */
  static <T> T until(String what, Callable<T> found) throws Exception {
    long end = System.nanoTime() + PATIENCE_S * 1_000_000_000L;
    while (System.nanoTime() < end) {
      T result = inSwing(found);
      if (result != null) return result;
      Thread.sleep(LOOK_AGAIN_MS);
    }
    throw new AssertionError("does not come: " + what);
  }

  static <T> T inSwing(Callable<T> work) throws Exception {
    if (SwingUtilities.isEventDispatchThread()) return work.call();
    List<T> result = new ArrayList<>();
    List<Exception> thrown = new ArrayList<>();
    SwingUtilities.invokeAndWait(() -> {
      try {
        result.add(work.call());
      } catch (Exception fault) {
        thrown.add(fault);
      }
    });
    if (!thrown.isEmpty()) throw thrown.get(0);
    return result.get(0);
  }

  /** Double-clicks the channel in lcm-spy's table; the window that opens. */
  Window open(String channel) throws Exception {
    int before = inSwing(() -> windows(channel).size());
    for (int attempt = 0; attempt < ATTEMPTS; ++attempt) {
      // LCM's player of logs has a window too.
      inSwing(() -> {
        SwingUtilities.getWindowAncestor(channels).toFront();
        return true;
      });
      doubleClick(until("the channel " + channel, () -> place(channel)));
      // A row that has moved meanwhile opens another channel's window; two clicks of a busy machine may count as one and one.
      for (int i = 0; i < LOOKS_AFTER_A_CLICK; ++i) {
        List<Window> windows = inSwing(() -> windows(channel));
        if (windows.size() > before) return windows.get(windows.size() - 1);
        Thread.sleep(LOOK_AGAIN_MS);
      }
    }
    throw new AssertionError("no window opens for " + channel);
  }

  /** Those that lcm-spy has opened for it, in order. */
  private static List<Window> windows(String channel) {
    List<Window> found = new ArrayList<>();
    for (Frame frame : Frame.getFrames()) {
      if (frame.getTitle().equals(channel) && frame.isShowing()) found.add(frame);
    }
    return found;
  }

  /** The middle of its row on the screen, or null while it has none. */
  private Point place(String channel) {
    for (int row = 0; row < channels.getRowCount(); ++row) {
      if (!channel.equals(channels.getValueAt(row, 0))) continue;
      Rectangle cell = channels.getCellRect(row, 0, false);
      Point corner = channels.getLocationOnScreen();
      return new Point(corner.x + cell.x + cell.width / 2, corner.y + cell.y + cell.height / 2);
    }
    return null;
  }

  private void doubleClick(Point place) {
    user.mouseMove(place.x, place.y);
    for (int i = 0; i < 2; ++i) {
      user.mousePress(InputEvent.BUTTON1_DOWN_MASK);
      user.mouseRelease(InputEvent.BUTTON1_DOWN_MASK);
    }
    user.waitForIdle();
  }

  /** The part of the plugin's window with this name. */
  static Component part(Window window, String name) throws Exception {
    return until(name + " in the window", () -> {
      for (Component component : all(window, Component.class)) {
        if (("gazed." + name).equals(component.getName()) && component.isShowing()) return component;
      }
      return null;
    });
  }

  /** What the screen shows there. */
  BufferedImage seen(Component component) throws Exception {
    Rectangle place = inSwing(() -> new Rectangle(component.getLocationOnScreen(), component.getSize()));
    return user.createScreenCapture(place);
  }

  private static <T> List<T> all(Container container, Class<T> type) {
    List<T> found = new ArrayList<>();
    for (Component component : container.getComponents()) {
      if (type.isInstance(component)) found.add(type.cast(component));
      if (component instanceof Container) found.addAll(all((Container) component, type));
    }
    return found;
  }
}

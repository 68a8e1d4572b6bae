package gazed.spy;

import java.awt.Window;
import javax.swing.JComboBox;
import javax.swing.JTable;

/** ChoiceTest PREFIX...: the real lcm-spy offers each of these robots, and shows the fixations of the one that is chosen. */
public final class ChoiceTest {
  private ChoiceTest() {}

  public static void main(String[] prefixes) throws Exception {
    int status = 1;
    try {
      run(new SpyWindow(), prefixes);
      System.out.println("passed");
      status = 0;
    } catch (Exception | AssertionError failed) {
      failed.printStackTrace();
    }
    System.exit(status);  // lcm-spy's threads would go on
  }

  private static void run(SpyWindow spy, String[] prefixes) throws Exception {
    Window window = spy.open(prefixes[0] + "_STATUS");
    JComboBox<?> robots = (JComboBox<?>) SpyWindow.part(window, "robot");
    JTable fixations = (JTable) SpyWindow.part(window, "fixations");
    Object before = null;
    for (String prefix : prefixes) {
      SpyWindow.until(prefix + " to choose", () -> {
        for (int i = 0; i < robots.getItemCount(); ++i) {
          if (prefix.equals(robots.getItemAt(i))) return true;
        }
        return null;
      });
      SpyWindow.inSwing(() -> {
        robots.setSelectedItem(prefix);
        return true;
      });
      // Their simulations have different seeds: no two measure the same.
      Object other = before;
      before = SpyWindow.until("a fixation of " + prefix, () -> {
        Object range = fixations.getRowCount() == 0 ? null : fixations.getValueAt(0, 3);
        return range == null || range.equals(other) ? null : range;
      });
    }
  }
}

package gazed.spy;

import java.awt.Color;
import java.awt.Component;
import java.awt.Window;
import java.util.List;
import javax.swing.JTable;

/** GazedTest CHANNEL: the real lcm-spy shows a gazed that runs and publishes its images. */
public final class GazedTest {
  private GazedTest() {}

  public static void main(String[] arguments) throws Exception {
    int status = 1;
    try {
      run(new SpyWindow(), arguments[0]);
      System.out.println("passed");
      status = 0;
    } catch (Exception | AssertionError failed) {
      failed.printStackTrace();
    }
    System.exit(status);  // lcm-spy's threads would go on
  }

  private static void run(SpyWindow spy, String channel) throws Exception {
    Window window = spy.open(channel);
    JTable fixations = (JTable) SpyWindow.part(window, "fixations");
    SpyWindow.until("a located fixation", () -> fixations.getRowCount() > 0 && fixations.getValueAt(0, 2) == Outcome.LOCATED ? true : null);
    seen(spy, window, "camera", List.of(Palette.WINNER));
    seen(spy, window, "first", List.of(Palette.TARGET, Palette.CORNER));
    seen(spy, window, "last", List.of(Palette.TARGET, Palette.EPIPOLAR));
    seen(spy, window, "above", List.of(Outcome.LOCATED.colour, Palette.CAMERA));
    seen(spy, window, "side", List.of(Outcome.LOCATED.colour, Palette.CAMERA));
    seen(spy, window, "head", List.of(Palette.TEXT, Palette.CAMERA));
  }

  private static void seen(SpyWindow spy, Window window, String part, List<Color> colours) throws Exception {
    Component panel = SpyWindow.part(window, part);
    for (Color colour : colours) {
      String what = String.format("colour %06x in %s", colour.getRGB() & 0xffffff, part);
      SpyWindow.until(what, () -> new Screen(spy.seen(panel)).has(colour) ? true : null);
    }
  }
}

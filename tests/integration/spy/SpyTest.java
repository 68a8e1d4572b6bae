package gazed.spy;

import java.awt.Color;
import java.awt.Component;
import java.awt.Window;
import java.io.File;
import java.util.List;
import java.util.concurrent.Callable;
import javax.imageio.ImageIO;
import javax.swing.JComboBox;
import javax.swing.JTable;

/**
 * SpyTest live|LOG: the real lcm-spy shows a robot that the test knows (KnownRobot), live or from a log that is written and played, and the
 * screen has the colours of map, winner, target, outline, epipolar line and ellipse where they belong.
 */
public final class SpyTest {
  private static final String PREFIX = "NAO_7";
  /** Longer than the window takes to open and be looked at; then the player has come to the end and shows the last of it. */
  private static final int LOG_FRAMES = 150;

  private final SpyWindow spy;
  private final Window window;

  private SpyTest(SpyWindow spy) throws Exception {
    this.spy = spy;
    window = spy.open(PREFIX + "_SALIENCY");
  }

  public static void main(String[] arguments) throws Exception {
    int status = 1;
    try {
      run(arguments[0]);
      System.out.println("passed");
      status = 0;
    } catch (Exception | AssertionError failed) {
      failed.printStackTrace();
    }
    System.exit(status);  // lcm-spy's threads would go on
  }

  private static void run(String source) throws Exception {
    boolean live = source.equals("live");
    if (!live) new KnownRobot(PREFIX).writeLog(source, LOG_FRAMES);
    SpyWindow spy = live ? new SpyWindow() : new SpyWindow(source);
    if (live) {
      new KnownRobot(PREFIX).publishForEver();
      new KnownRobot("OTHER").publishForEver();
    }
    SpyTest test = new SpyTest(spy);
    test.checkPictures();
    test.checkPlans();
    test.checkWords(live);
    SpyWindow.inSwing(() -> {
      test.window.setSize(900, 700);
      test.window.validate();
      return true;
    });
    test.checkPictures();
    test.checkPlans();
    for (String ending : List.of("IMAGE", "LOCATED_POINT", "FIXATION", "STATUS")) {
      SpyWindow.part(spy.open(PREFIX + "_" + ending), "camera");
    }
  }

  private void checkPictures() throws Exception {
    Component camera = SpyWindow.part(window, "camera"), first = SpyWindow.part(window, "first"), last = SpyWindow.part(window, "last");
    // The densest part of the veil: 0.7 of the map's colour.
    Color empty = new Color(KnownRobot.BACKGROUND * 0x010101);
    Color hot = mixed(empty, Palette.MAP, 0.7);
    eventually("the map", camera, hot, HeatMap.CELL_PX * KnownRobot.HOT_CELL_X, HeatMap.CELL_PX * KnownRobot.HOT_CELL_Y, 0, 0);
    eventually("no map five cells from it", camera, empty, HeatMap.CELL_PX * (KnownRobot.HOT_CELL_X + 5),
        HeatMap.CELL_PX * KnownRobot.HOT_CELL_Y, 0, 0);
    eventually("the winner's ring", camera, Palette.WINNER, KnownRobot.WINNER[0], KnownRobot.WINNER[1], 12, 0);
    eventually("nothing in the ring", camera, empty, KnownRobot.WINNER[0], KnownRobot.WINNER[1], 0, 0);
    eventually("the target of look 1", first, Palette.TARGET, KnownRobot.TARGET_1[0], KnownRobot.TARGET_1[1], 0, 0);
    eventually("its outline, above", first, Palette.TARGET, 85, KnownRobot.OUTLINE[0][1], 0, 0);
    eventually("its outline, left", first, Palette.TARGET, KnownRobot.OUTLINE[0][0], 170, 0, 0);
    eventually("nothing between target and outline", first, empty, 84, 134, 0, 0);
    eventually("a corner that is used", first, Palette.CORNER, KnownRobot.CORNERS[0][0], KnownRobot.CORNERS[0][1], 0, 0);
    eventually("a corner that is rejected", first, Palette.CORNER_REJECTED, KnownRobot.CORNERS[1][0], KnownRobot.CORNERS[1][1], 0, 0);
    eventually("the target of look 2", last, Palette.TARGET, KnownRobot.TARGET_2[0], KnownRobot.TARGET_2[1], 0, 0);
    // Where look 2 sees what is at infinity on the first ray: the head has turned by 0.2 rad about the camera's upright axis.
    double angle = Math.atan((KnownRobot.TARGET_1[0] - 159.5) / 304) + 0.2;
    double down = (KnownRobot.TARGET_1[1] - 119.5) / 304 * Math.cos(angle - 0.2) / Math.cos(angle);
    eventually("the epipolar line's end", last, Palette.EPIPOLAR, 159.5 + 304 * Math.tan(angle), 119.5 + 304 * down, 0, 0);
  }

  private void checkPlans() throws Exception {
    for (Plane plane : Plane.values()) {
      Component panel = SpyWindow.part(window, plane == Plane.ABOVE ? "above" : "side");
      seenOrPictured("point and ellipses from the side " + plane, () -> ellipsesAreSeen(plane, panel) ? true : null);
    }
  }

  /** At the ends of both axes, which are the frame's own here, and not half as far beyond. */
  private boolean ellipsesAreSeen(Plane plane, Component panel) throws Exception {
    Screen screen = new Screen(spy.seen(panel));
    gazed.located_point_t point = KnownRobot.point(0);
    Fixation fixation = Fixation.of(point);
    PlanScale scale = PlanScale.fit(plane, List.of(fixation), fixation, screen.width(), screen.height());
    Color located = Outcome.LOCATED.colour;
    double u = plane.u(point.position_m), v = plane.v(point.position_m);
    double du = Math.sqrt(plane.uu(point.covariance_m2)), dv = Math.sqrt(plane.vv(point.covariance_m2));
    boolean seen = screen.has(located, scale.x(u), scale.y(v));
    // 68 % and 95 % of two dimensions: chi-square with two degrees of freedom is 2.279 and 5.991 there.
    for (double reach : new double[] {Math.sqrt(2.279), Math.sqrt(5.991)}) {
      seen &= screen.has(located, scale.x(u - reach * du), scale.y(v)) && screen.has(located, scale.x(u), scale.y(v - reach * dv));
    }
    double between = (Math.sqrt(2.279) + Math.sqrt(5.991)) / 2;
    int row = (int) Math.round(scale.y(v));
    return seen && !screen.isNearly(located, (int) Math.round(scale.x(u - between * du)), row)
        && !screen.isNearly(located, (int) Math.round(scale.x(u - 4 * du)), row);
  }

  private void checkWords(boolean othersToo) throws Exception {
    JTable fixations = (JTable) SpyWindow.part(window, "fixations");
    SpyWindow.until("a fixation that is located, at 1.120 m", () -> fixations.getRowCount() > 0
        && ((Outcome) fixations.getValueAt(0, 2)).words.equals("located")
        && fixations.getValueAt(0, 3).toString().startsWith("1.120 m") ? true : null);
    Component status = SpyWindow.part(window, "status");
    SpyWindow.until("the fault in its own colour", () -> new Screen(spy.seen(status)).has(Palette.FAULT) ? true : null);
    if (!othersToo) return;
    JComboBox<?> robots = (JComboBox<?>) SpyWindow.part(window, "robot");
    SpyWindow.until("both robots to choose from", () -> robots.getItemCount() == 2 ? true : null);
  }

  /** Waits until a pixel of the frame, and so many of the screen beside it, has the colour. */
  private void eventually(String what, Component panel, Color colour, double x, double y, int right, int down) throws Exception {
    seenOrPictured(what, () -> {
      Screen screen = new Screen(spy.seen(panel));
      double[] frame = screen.frame();
      return frame != null && screen.has(colour, frame[0] + frame[1] * x + right, frame[2] + frame[3] * y + down) ? true : null;
    });
  }

  /** A picture of the screen stays in the working directory where it is not seen. */
  private void seenOrPictured(String what, Callable<Boolean> seen) throws Exception {
    try {
      SpyWindow.until(what, seen);
    } catch (AssertionError missing) {
      ImageIO.write(spy.seen(window), "png", new File("spy_test_failed.png"));
      throw missing;
    }
  }

  private static Color mixed(Color under, Color over, double share) {
    return new Color((int) (under.getRed() * (1 - share) + over.getRed() * share), (int) (under.getGreen() * (1 - share) + over.getGreen() * share),
        (int) (under.getBlue() * (1 - share) + over.getBlue() * share));
  }
}

package gazed.spy;

import java.awt.Component;
import java.awt.Window;
import java.io.File;
import javax.imageio.ImageIO;
import javax.swing.JTable;

/** SpyPicture CHANNEL FIXATIONS FILE: opens the plugin on a channel, waits for so many fixations, and writes what the screen shows. */
public final class SpyPicture {
  /** After a fixation the simulator changes its scene: until the next view has its map, the old one lies over the new picture. */
  private static final int NEXT_VIEW_MS = 700;

  private SpyPicture() {}

  public static void main(String[] arguments) throws Exception {
    int wanted = Integer.parseInt(arguments[1]);
    SpyWindow spy = new SpyWindow();
    Window window = spy.open(arguments[0]);
    Component fixations = SpyWindow.part(window, "fixations");
    SpyWindow.until(wanted + " fixations", () -> ((JTable) fixations).getRowCount() >= wanted ? true : null);
    Thread.sleep(NEXT_VIEW_MS);
    String file = arguments[2];
    ImageIO.write(spy.seen(window), file.substring(file.lastIndexOf('.') + 1), new File(file));
    System.exit(0);
  }
}

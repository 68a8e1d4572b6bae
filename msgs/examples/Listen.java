import gazed.located_point_t;
import java.io.IOException;
import lcm.lcm.LCM;

/** Prints what each gazed locates that is heard: a robot's channels begin with its own prefix. */
public final class Listen {
  private static final String[] NAMES = {
    "LOCATED", "NO_SALIENT_OBJECT", "TARGET_LOST", "DEGENERATE",
    "BEHIND_CAMERA", "UNCERTAIN", "HEAD_FAULT", "CAMERA_FAULT"
  };

  private Listen() {}

  public static void main(String[] arguments) throws IOException, InterruptedException {
    LCM.getSingleton().subscribe(".*_LOCATED_POINT", (lcm, channel, data) -> {
      try {
        located_point_t point = new located_point_t(data);
        double[] at = point.position_m;
        boolean known = point.status >= 0 && point.status < NAMES.length;
        System.out.printf("%s: %s: %.3f m away +- %.3f m, at x %.3f, y %.3f, z %.3f m; %s%n", channel,
            known ? NAMES[point.status] : "a later status", point.range_m, point.range_sigma_m, at[0], at[1], at[2],
            point.reason);
      } catch (IOException error) {
        System.err.println("not a located_point_t: " + error.getMessage());
      }
    });
    Thread.sleep(Long.MAX_VALUE); // LCM's own thread calls
  }
}

package gazed.spy;

import java.awt.AWTError;
import java.awt.GraphicsEnvironment;
import java.awt.HeadlessException;
import java.io.IOException;
import lcm.lcm.LCM;
import lcm.logging.LogPlayer;
import lcm.spy.Spy;

/** Start [LOG]: lcm-spy on the network that LCM_DEFAULT_URL names, and beside it LCM's player of a log; or in words why not. */
public final class Start {
  private Start() {}

  public static void main(String[] arguments) throws IOException {
    String missing = whatIsMissing();
    if (missing != null) {
      System.err.println(missing);
      System.exit(1);
    }
    Network.enlargeReceiveBuffer(new Spy(null));
    if (arguments.length == 1) LogPlayer.main(new String[] {"-l", Network.url(), arguments[0]});
  }

  private static String whatIsMissing() {
    try {
      GraphicsEnvironment.getLocalGraphicsEnvironment().getDefaultScreenDevice();
    } catch (HeadlessException | AWTError none) {
      return "lcm-spy opens windows, and there is no screen at DISPLAY=" + System.getenv("DISPLAY");
    }
    if (Network.url().startsWith("tcpq://")) return null;  // waits for its service, and cannot be closed before
    if (!Network.url().startsWith("udpm://")) {
      return "URL '" + Network.url() + "' found; allowed: udpm://..., tcpq://...";
    }
    try {
      new LCM().close();
    } catch (IOException | RuntimeException fault) {
      return "no LCM network at " + Network.url() + " (" + fault.getMessage()
          + "). Is there a route for multicast? On one machine: ip route add 224.0.0.0/4 dev lo";
    }
    return null;
  }
}

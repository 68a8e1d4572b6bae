package gazed.spy;

import java.io.IOException;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;
import lcm.lcm.TCPService;

/**
 * Bridge PORT CHANNELS: what is heard in the network that LCM_DEFAULT_URL names, for those who cannot be in it: LCM's own TCP service on that
 * port serves it to any LCM program with the URL tcpq://HOST:PORT. One way: nothing that they publish reaches the robots.
 */
public final class Bridge implements LCMSubscriber {
  private final Pattern channels;
  private final LCM service;

  private Bridge(Pattern channels, LCM service) {
    this.channels = channels;
    this.service = service;
  }

  public static void main(String[] arguments) {
    try {
      bridge(Integer.parseInt(arguments[0]), Pattern.compile(arguments[1]));
    } catch (PatternSyntaxException wrong) {
      System.err.println("--channels: '" + arguments[1] + "' found; allowed: a regular expression: " + wrong.getDescription());
      System.exit(2);
    } catch (IOException | RuntimeException fault) {
      // The service's thread would go on, and serve nothing.
      System.err.println("No LCM network at " + Network.url() + ": " + fault.getMessage());
      System.exit(1);
    }
  }

  private static void bridge(int port, Pattern channels) throws IOException {
    Thread thread = new Thread(() -> serve(port), "LCM's TCP service");
    thread.start();
    LCM service = new LCM("tcpq://127.0.0.1:" + port);
    Network.join(new Bridge(channels, service));
    System.err.println(Network.url() + " is served at tcpq://HOST:" + port + " with this computer's name or address for HOST");
  }

  @Override
  public void messageReceived(LCM network, String channel, LCMDataInputStream in) {
    if (!channels.matcher(channel).matches()) return;
    try {
      service.publish(channel, in.getBuffer(), in.getBufferOffset(), in.available());
    } catch (IOException gone) {
      // It is of this process: it goes when this goes.
    }
  }

  private static void serve(int port) {
    try {
      new TCPService(port);  // returns when it ends, and tells its clients and kB/s until then
    } catch (IOException fault) {
      System.err.println("port " + port + ": " + fault.getMessage());
      System.exit(1);
    }
  }
}

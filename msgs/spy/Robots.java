package gazed.spy;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.head_command_t;
import gazed.head_state_t;
import gazed.located_point_t;
import gazed.saliency_map_t;
import gazed.status_t;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;

/** All robots that are heard, by their prefixes. Takes every message of the network; what is not gazed's is left alone. */
final class Robots implements LCMSubscriber {
  /** More than any network of robots has: whoever sends under ever new names does not fill the memory. */
  private static final int MOST = 100;

  private final Map<String, Robot> robots = new TreeMap<>();

  /** Prefixes of the robots heard so far, in order. */
  synchronized List<String> prefixes() {
    return new ArrayList<>(robots.keySet());
  }

  /** Makes it when nothing has come of it yet. */
  synchronized Robot robot(String prefix) {
    if (!robots.containsKey(prefix) && robots.size() >= MOST) throw new IllegalStateException("more than " + MOST + " robots");
    return robots.computeIfAbsent(prefix, name -> new Robot());
  }

  @Override
  public void messageReceived(LCM lcm, String name, LCMDataInputStream in) {
    try {
      if (in.available() < Long.BYTES) return;
      long fingerprint = in.readLong();
      if (fingerprint == image_t.LCM_FINGERPRINT) {
        takeImage(name, in);
      } else {
        in.reset();
        take(name, fingerprint, in);
      }
    } catch (IOException | RuntimeException | OutOfMemoryError lies) {
      // A message that claims more than it has. lcm-spy counts it as undecodable; thrown further, it would end LCM's thread.
    }
  }

  private void take(String name, long fingerprint, LCMDataInputStream in) throws IOException {
    String prefix = Channel.of(name).prefix();
    if (fingerprint == located_point_t.LCM_FINGERPRINT) {
      robot(prefix).take(new located_point_t(in));
    } else if (fingerprint == fixation_t.LCM_FINGERPRINT) {
      robot(prefix).take(new fixation_t(in));
    } else if (fingerprint == saliency_map_t.LCM_FINGERPRINT) {
      robot(prefix).take(new saliency_map_t(in));
    } else if (fingerprint == status_t.LCM_FINGERPRINT) {
      robot(prefix).take(new status_t(in));
    } else if (fingerprint == head_state_t.LCM_FINGERPRINT) {
      robot(prefix).take(new head_state_t(in));
    } else if (fingerprint == head_command_t.LCM_FINGERPRINT) {
      robot(prefix).take(new head_command_t(in));
    }
  }

  private void takeImage(String name, LCMDataInputStream in) throws IOException {
    Robot robot = robotOfImages(name);
    try {
      robot.take(ImageReading.read(in));
    } catch (IOException lies) {
      robot.takeImageFault(lies.getMessage());
    }
  }

  /** A camera's channel may have any name; where there is one robot only, the camera is its own. */
  private synchronized Robot robotOfImages(String name) {
    Channel channel = Channel.of(name);
    boolean others = channel.ending().isEmpty() && robots.size() == 1;
    return others ? robots.values().iterator().next() : robot(channel.prefix());
  }
}

package gazed.spy;

import java.io.IOException;
import java.lang.reflect.Field;
import java.net.MulticastSocket;
import java.util.List;
import lcm.lcm.LCM;
import lcm.lcm.LCMSubscriber;
import lcm.spy.Spy;

/** The LCM network that LCM_DEFAULT_URL names, which is the one that lcm-spy listens to. */
final class Network {
  /** What gazed itself asks for: a raw frame is several times the kernel's usual buffer of 212992 bytes. */
  private static final int RECEIVE_BYTES = 4_000_000;

  private Network() {}

  /** Throws IOException where there is no such network. */
  static void join(LCMSubscriber everything) throws IOException {
    LCM lcm = new LCM();
    enlargeReceiveBuffer(lcm);
    lcm.subscribeAll(everything);
  }

  static String url() {
    String url = System.getenv("LCM_DEFAULT_URL");
    return url == null || url.isEmpty() ? "udpm://239.255.76.67:7667" : url;
  }


  /** Of lcm-spy's own connection. */
  static void enlargeReceiveBuffer(Spy spy) {
    try {
      enlargeReceiveBuffer((LCM) open(Spy.class, "lcm").get(spy));
    } catch (ReflectiveOperationException unknown) {
      // As said below.
    }
  }

  /**
   * LCM's Java offers no way to do this, so its fields are looked into. Where they are not (another provider, another version) raw frames
   * may be lost, and nothing else.
   */
  private static void enlargeReceiveBuffer(LCM lcm) {
    try {
      for (Object provider : (List<?>) open(LCM.class, "providers").get(lcm)) {
        Object socket = open(provider.getClass(), "sock").get(provider);
        if (socket instanceof MulticastSocket) ((MulticastSocket) socket).setReceiveBufferSize(RECEIVE_BYTES);
      }
    } catch (ReflectiveOperationException | IOException unknown) {
      // As said above.
    }
  }

  private static Field open(Class<?> type, String name) throws ReflectiveOperationException {
    Field field = type.getDeclaredField(name);
    field.setAccessible(true);
    return field;
  }
}

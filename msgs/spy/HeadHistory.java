package gazed.spy;

import gazed.head_state_t;
import java.util.ArrayDeque;

/** The last head states, to be asked where the head was when an image was taken. */
final class HeadHistory {
  /** A choice: some seconds of LoLA's 83 a second. */
  private static final int STATES_MAX = 500;
  /** A state further away in time than this says nothing of a head that moves. */
  private static final long FARTHEST_US = 100_000;

  private final ArrayDeque<head_state_t> states = new ArrayDeque<>();

  void add(head_state_t state) {
    states.addLast(state);
    if (states.size() > STATES_MAX) states.removeFirst();
  }

  /** The state nearest to this time, or null where there is none near it. */
  head_state_t at(long utime) {
    head_state_t nearest = null;
    for (head_state_t state : states) {
      if (nearest == null || Math.abs(state.utime - utime) < Math.abs(nearest.utime - utime)) nearest = state;
    }
    return nearest != null && Math.abs(nearest.utime - utime) <= FARTHEST_US ? nearest : null;
  }
}

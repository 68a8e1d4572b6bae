package gazed.spy;

import bot_core.image_t;
import java.util.ArrayDeque;

/** The newest frames, to be found by their time when a fixation says which of them it looked at. */
final class Frames {
  /** A choice: eight seconds of raw frames of 640x480 at 25 a second, which is longer than most fixations of six looks take. */
  private static final long BYTES_MAX = 120_000_000;

  private final ArrayDeque<image_t> frames = new ArrayDeque<>();
  private long bytes;

  void add(image_t frame) {
    frames.addLast(frame);
    bytes += frame.data.length;
    while (bytes > BYTES_MAX && frames.size() > 1) bytes -= frames.removeFirst().data.length;
  }

  /** The frame whose exposure began then, or null. */
  image_t at(long utime) {
    for (image_t frame : frames) {
      if (frame.utime == utime) return frame;
    }
    return null;
  }
}

package gazed.spy;

import gazed.located_point_t;
import java.awt.Color;

/** How a fixation ended, in words: located_point_t.status. */
enum Outcome {
  LOCATED(located_point_t.LOCATED, "located", new Color(0x1a7f5a)),
  NO_SALIENT_OBJECT(located_point_t.NO_SALIENT_OBJECT, "nothing stands out", new Color(0x6b7280)),
  TARGET_LOST(located_point_t.TARGET_LOST, "target lost", new Color(0x9c5a3c)),
  DEGENERATE(located_point_t.DEGENERATE, "no baseline", new Color(0x9c5a3c)),
  BEHIND_CAMERA(located_point_t.BEHIND_CAMERA, "behind the camera", new Color(0x9c5a3c)),
  UNCERTAIN(located_point_t.UNCERTAIN, "uncertain", new Color(0xb87400)),
  HEAD_FAULT(located_point_t.HEAD_FAULT, "head fault", new Color(0xb3261e)),
  CAMERA_FAULT(located_point_t.CAMERA_FAULT, "camera fault", new Color(0xb3261e)),
  /** A status that this program is too old to know. */
  UNKNOWN((byte) -1, "unknown status", new Color(0x6b7280));

  final String words;
  final Color colour;
  private final byte status;

  Outcome(byte status, String words, Color colour) {
    this.status = status;
    this.words = words;
    this.colour = colour;
  }

  static Outcome of(byte status) {
    for (Outcome outcome : values()) {
      if (outcome.status == status) return outcome;
    }
    return UNKNOWN;
  }
}

package gazed.spy;

import bot_core.image_t;
import java.awt.image.BufferedImage;
import java.io.IOException;

/** The newest image of a panel, decoded once however often it is painted. */
final class CachedPicture {
  private image_t image;
  private BufferedImage picture;
  private String fault = "";

  void set(image_t next) {
    if (next == image) return;
    image = next;
    picture = null;
    fault = "";
    if (next == null) return;
    try {
      picture = Pictures.decode(next);
    } catch (IOException | RuntimeException broken) {
      // ImageIO answers some broken JPEGs with exceptions of many kinds.
      fault = broken.getMessage() == null ? "image cannot be decoded" : broken.getMessage();
    }
  }

  /** Null while there is none, or where it cannot be decoded. */
  BufferedImage picture() {
    return picture;
  }

  /** Why there is none, in words; empty when none came. */
  String fault() {
    return fault;
  }
}

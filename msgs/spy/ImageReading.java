package gazed.spy;

import bot_core.image_t;
import java.io.IOException;
import lcm.lcm.LCMDataInputStream;

/** Reads an image_t without believing its sizes: the decoder that lcm-gen makes allocates whatever a message claims. */
final class ImageReading {
  /** More than any camera; products of two sides and a pixel's bytes stay in 32 bits. The same as in drivers/lcm/checks.cpp. */
  private static final int LONGEST_SIDE = 16384;

  /** A JPEG of a few kilobytes can claim the greatest sides, and take a gigabyte when it is decoded. */
  private static final int PIXELS_MAX = 40_000_000;

  private ImageReading() {}

  /** The stream is behind the fingerprint. Throws IOException, with a sentence for people, for a message that lies. */
  static image_t read(LCMDataInputStream in) throws IOException {
    image_t image = new image_t();
    image.utime = in.readLong();
    image.width = in.readInt();
    image.height = in.readInt();
    image.row_stride = in.readInt();
    image.pixelformat = in.readInt();
    image.size = in.readInt();
    if (image.width < 1 || image.height < 1 || image.width > LONGEST_SIDE || image.height > LONGEST_SIDE) {
      throw new IOException(String.format("image says that it is of %dx%d; 1 to %d are taken", image.width, image.height, LONGEST_SIDE));
    }
    if (image.width * image.height > PIXELS_MAX) {
      throw new IOException(String.format("image says that it is of %dx%d; up to %d million pixels are shown",
          image.width, image.height, PIXELS_MAX / 1_000_000));
    }
    if (image.size < 0 || image.size > in.available()) {
      throw new IOException(String.format("image says that it has %d bytes; %d came", image.size, in.available()));
    }
    image.data = new byte[image.size];
    in.readFully(image.data);
    return image;  // the remarks behind it are not shown
  }
}

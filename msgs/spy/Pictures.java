package gazed.spy;

import bot_core.image_t;
import java.awt.image.BufferedImage;
import java.awt.image.DataBufferInt;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import javax.imageio.IIOException;
import javax.imageio.ImageIO;
import javax.imageio.ImageReader;
import javax.imageio.stream.MemoryCacheImageInputStream;

/** From image_t, in any format that gazed takes or sends, to what can be drawn. */
final class Pictures {
  // FourCCs, least significant byte first, as V4L2 has them.
  static final int YUYV = fourCc("YUYV");
  static final int UYVY = fourCc("UYVY");
  static final int RGB3 = fourCc("RGB3");
  static final int BGR3 = fourCc("BGR3");
  static final int GREY = fourCc("GREY");
  static final int MJPG = fourCc("MJPG");

  private Pictures() {}

  static int fourCc(String name) {
    return name.charAt(0) | name.charAt(1) << 8 | name.charAt(2) << 16 | name.charAt(3) << 24;
  }

  /** Throws IOException, with a sentence for people, for an image that cannot be drawn. Sizes are checked already (ImageReading). */
  static BufferedImage decode(image_t image) throws IOException {
    if (image.pixelformat == MJPG) return decodeJpeg(image);
    int bytes = bytesPerPixel(image.pixelformat);
    long needed = (long) (image.height - 1) * image.row_stride + (long) image.width * bytes;
    if (image.row_stride < image.width * bytes || image.data.length < needed) {
      throw new IOException(String.format("image of %dx%d has rows of %d bytes and %d bytes in all", image.width, image.height,
          image.row_stride, image.data.length));
    }
    BufferedImage picture = new BufferedImage(image.width, image.height, BufferedImage.TYPE_INT_RGB);
    int[] pixels = ((DataBufferInt) picture.getRaster().getDataBuffer()).getData();
    for (int y = 0; y < image.height; ++y) {
      int row = y * image.row_stride, to = y * image.width;
      if (image.pixelformat == YUYV) {
        yuvRow(image.data, row, 0, 1, pixels, to, image.width);
      } else if (image.pixelformat == UYVY) {
        yuvRow(image.data, row, 1, 0, pixels, to, image.width);
      } else if (image.pixelformat == GREY) {
        for (int x = 0; x < image.width; ++x) pixels[to + x] = (image.data[row + x] & 0xff) * 0x010101;
      } else {
        int red = image.pixelformat == RGB3 ? 0 : 2;
        for (int x = 0, i = row; x < image.width; ++x, i += 3) {
          pixels[to + x] = (image.data[i + red] & 0xff) << 16 | (image.data[i + 1] & 0xff) << 8 | image.data[i + 2 - red] & 0xff;
        }
      }
    }
    return picture;
  }

  /** Throws IOException for a format that is not drawn. */
  private static int bytesPerPixel(int format) throws IOException {
    if (format == YUYV || format == UYVY) return 2;
    if (format == RGB3 || format == BGR3) return 3;
    if (format == GREY) return 1;
    throw new IOException("images of format " + name(format) + " are not drawn; YUYV, UYVY, RGB3, BGR3, GREY and MJPG are");
  }

  private static BufferedImage decodeJpeg(image_t image) throws IOException {
    ImageReader reader = ImageIO.getImageReadersByFormatName("jpeg").next();
    try {
      reader.setInput(new MemoryCacheImageInputStream(new ByteArrayInputStream(image.data)), true, true);
      // What is drawn over it is in pixels of the size that the message has; and a larger one is not decoded.
      if (reader.getWidth(0) != image.width || reader.getHeight(0) != image.height) {
        throw new IOException(String.format("image says that it is of %dx%d, its JPEG is of %dx%d", image.width, image.height,
            reader.getWidth(0), reader.getHeight(0)));
      }
      return reader.read(0);
    } catch (IIOException broken) {
      throw new IOException("image says that it is MJPG, and its JPEG is broken: " + broken.getMessage(), broken);
    } finally {
      reader.dispose();
    }
  }

  /** Two pixels are y0 u y1 v (luma at 0, chroma at 1), or u y0 v y1 (1, 0). BT.601, limited range. */
  private static void yuvRow(byte[] data, int row, int luma, int chroma, int[] pixels, int to, int width) {
    for (int x = 0; x < width; ++x) {
      // The last pixel of an odd width has a u and no v of its own.
      int pair = row + x / 2 * 4;
      int vAt = pair + chroma + 2;
      int u = (data[pair + chroma] & 0xff) - 128;
      int v = vAt < data.length && x / 2 * 2 + 1 < width ? (data[vAt] & 0xff) - 128 : 0;
      int y = 298 * ((data[row + 2 * x + luma] & 0xff) - 16) + 128;
      pixels[to + x] = byteOf(y + 409 * v) << 16 | byteOf(y - 100 * u - 208 * v) << 8 | byteOf(y + 516 * u);
    }
  }

  private static int byteOf(int timesTwoHundredFiftySix) {
    return Math.max(0, Math.min(255, timesTwoHundredFiftySix >> 8));
  }

  /** Four characters as they are printed, or the number when it is none of that kind. */
  static String name(int format) {
    StringBuilder name = new StringBuilder();
    for (int shift = 0; shift < 32; shift += 8) {
      char c = (char) (format >> shift & 0xff);
      if (c < ' ' || c > '~') return Integer.toString(format);
      name.append(c);
    }
    return name.toString();
  }
}

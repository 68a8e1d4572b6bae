package gazed.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import bot_core.image_t;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import javax.imageio.ImageIO;
import org.junit.Test;

public class PicturesTest {
  /** Luma and chroma are whole numbers: a step of either is up to two steps of a colour. */
  private static final int ROUNDING = 3;
  /** JPEG of quality 0.75 of one flat colour. */
  private static final int JPEG_LOSS = 6;

  private static image_t image(int format, int width, int height, int stride, int... bytes) {
    image_t image = new image_t();
    image.pixelformat = format;
    image.width = width;
    image.height = height;
    image.row_stride = stride;
    image.size = bytes.length;
    image.data = new byte[bytes.length];
    for (int i = 0; i < bytes.length; ++i) image.data[i] = (byte) bytes[i];
    return image;
  }

  private static void assertColour(int expected, BufferedImage picture, int x, int y, int tolerance) {
    int found = picture.getRGB(x, y);
    for (int shift = 0; shift <= 16; shift += 8) {
      assertEquals(String.format("%06x, found %06x", expected, found & 0xffffff), expected >> shift & 0xff, found >> shift & 0xff, tolerance);
    }
  }

  @Test
  public void everyFormatShowsItsColours() throws IOException {
    // Pure red in BT.601 of limited range is y 81, u 90, v 240 (ITU-R BT.601, table 3).
    assertColour(0xff0000, Pictures.decode(image(Pictures.YUYV, 2, 1, 4, 81, 90, 81, 240)), 1, 0, ROUNDING);
    assertColour(0xff0000, Pictures.decode(image(Pictures.UYVY, 2, 1, 4, 90, 81, 240, 81)), 0, 0, ROUNDING);
    assertColour(0x0a141e, Pictures.decode(image(Pictures.RGB3, 1, 1, 3, 10, 20, 30)), 0, 0, 0);
    assertColour(0x0a141e, Pictures.decode(image(Pictures.BGR3, 1, 1, 3, 30, 20, 10)), 0, 0, 0);
    assertColour(0xc8c8c8, Pictures.decode(image(Pictures.GREY, 1, 1, 1, 200)), 0, 0, 0);
  }

  @Test
  public void rowsBeginWhereTheStrideSays() throws IOException {
    assertColour(0x030303, Pictures.decode(image(Pictures.GREY, 2, 2, 3, 1, 2, 99, 3, 4)), 0, 1, 0);
  }

  @Test
  public void anOddWidthEndsWithHalfAPair() throws IOException {
    assertEquals(3, Pictures.decode(image(Pictures.YUYV, 3, 1, 6, 81, 90, 81, 240, 81, 90)).getWidth());
  }

  @Test
  public void jpegIsDecoded() throws IOException {
    BufferedImage flat = new BufferedImage(16, 8, BufferedImage.TYPE_INT_RGB);
    for (int i = 0; i < 16 * 8; ++i) flat.setRGB(i % 16, i / 16, 0x3070b0);
    ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    ImageIO.write(flat, "jpg", bytes);
    image_t image = image(Pictures.MJPG, 16, 8, 0);
    image.data = bytes.toByteArray();
    assertColour(0x3070b0, Pictures.decode(image), 7, 4, JPEG_LOSS);
    image.width = 32;
    assertTrue(assertThrows(IOException.class, () -> Pictures.decode(image)).getMessage().contains("16x8"));
  }

  @Test
  public void whatCannotBeDrawnIsSaidInWords() {
    assertThrows(IOException.class, () -> Pictures.decode(image(Pictures.GREY, 4, 2, 4, 1, 2, 3, 4)));
    assertThrows(IOException.class, () -> Pictures.decode(image(Pictures.YUYV, 4, 1, 4, 1, 2, 3, 4)));
    assertThrows(IOException.class, () -> Pictures.decode(image(Pictures.MJPG, 4, 1, 4, 1, 2, 3, 4)));
    IOException unknown = assertThrows(IOException.class, () -> Pictures.decode(image(Pictures.fourCc("H264"), 4, 1, 4, 1, 2, 3, 4)));
    assertTrue(unknown.getMessage().contains("H264"));
  }
}

package gazed.spy;

import java.awt.Color;
import java.awt.image.BufferedImage;

/** A part of the screen, asked which colours it has where. */
final class Screen {
  /** Edges are smoothed: a line's own colour is met within so many pixels of where it belongs, and nearly so. */
  private static final int NEAR_PX = 2;
  private static final int NEARLY = 24;

  private final BufferedImage image;

  Screen(BufferedImage image) {
    this.image = image;
  }

  boolean has(Color colour, double x, double y) {
    for (int dy = -NEAR_PX; dy <= NEAR_PX; ++dy) {
      for (int dx = -NEAR_PX; dx <= NEAR_PX; ++dx) {
        if (isNearly(colour, (int) Math.round(x) + dx, (int) Math.round(y) + dy)) return true;
      }
    }
    return false;
  }

  boolean isNearly(Color colour, int x, int y) {
    if (x < 0 || y < 0 || x >= image.getWidth() || y >= image.getHeight()) return false;
    Color found = new Color(image.getRGB(x, y));
    return Math.abs(found.getRed() - colour.getRed()) <= NEARLY && Math.abs(found.getGreen() - colour.getGreen()) <= NEARLY
        && Math.abs(found.getBlue() - colour.getBlue()) <= NEARLY;
  }

  /** Whether it is anywhere. */
  boolean has(Color colour) {
    for (int y = 0; y < image.getHeight(); ++y) {
      for (int x = 0; x < image.getWidth(); ++x) {
        if (isNearly(colour, x, y)) return true;
      }
    }
    return false;
  }

  int width() {
    return image.getWidth();
  }

  int height() {
    return image.getHeight();
  }

  /**
   * Where the pixels of KnownRobot's frame are: found by its white squares, one in each quarter. {x of pixel 0, screen pixels a pixel, y of
   * pixel 0, screen pixels a pixel}; null while they are not all seen.
   */
  double[] frame() {
    double[][] centres = new double[4][];
    for (int quarter = 0; quarter < 4; ++quarter) {
      centres[quarter] = centreOfWhite(quarter % 2 * image.getWidth() / 2, quarter / 2 * image.getHeight() / 2);
      if (centres[quarter] == null) return null;
    }
    double scaleX = (centres[1][0] - centres[0][0]) / (KnownRobot.SQUARES[1][0] - KnownRobot.SQUARES[0][0]);
    double scaleY = (centres[2][1] - centres[0][1]) / (KnownRobot.SQUARES[2][1] - KnownRobot.SQUARES[0][1]);
    return new double[] {centres[0][0] - scaleX * KnownRobot.SQUARES[0][0], scaleX, centres[0][1] - scaleY * KnownRobot.SQUARES[0][1], scaleY};
  }

  private double[] centreOfWhite(int left, int top) {
    double sumX = 0, sumY = 0;
    int count = 0;
    for (int y = top; y < top + image.getHeight() / 2; ++y) {
      for (int x = left; x < left + image.getWidth() / 2; ++x) {
        if ((image.getRGB(x, y) & 0xffffff) != 0xffffff) continue;
        sumX += x;
        sumY += y;
        ++count;
      }
    }
    return count == 0 ? null : new double[] {sumX / count, sumY / count};
  }
}

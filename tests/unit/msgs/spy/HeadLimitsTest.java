package gazed.spy;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.junit.Test;

public class HeadLimitsTest {
  private static final double NONE = 0;
  private static final Pattern ROW = Pattern.compile("\\{(-?[0-9.]+), \\{(-?[0-9.]+), (-?[0-9.]+)\\}\\}");

  /** The window draws the limits that gazed keeps. */
  @Test
  public void areThoseOfTheAgent() throws IOException {
    String source = Files.readString(Path.of(System.getProperty("gazed.project"), "agent/geometry/limits.cpp"));
    List<double[]> rows = new ArrayList<>();
    for (Matcher row = ROW.matcher(source); row.find(); ) {
      rows.add(new double[] {Double.parseDouble(row.group(1)), Double.parseDouble(row.group(2)), Double.parseDouble(row.group(3))});
    }
    assertEquals(HeadLimits.ROWS.length, rows.size());
    for (int i = 0; i < HeadLimits.ROWS.length; ++i) assertArrayEquals(rows.get(i), HeadLimits.ROWS[i], NONE);
    assertEquals(number(source, "joint_yaw_max_rad = (-?[0-9.]+);"), HeadLimits.YAW_MAX, NONE);
    assertEquals(number(source, "joint_pitch_rad\\{(-?[0-9.]+),"), HeadLimits.PITCH_MIN, NONE);
    assertEquals(number(source, "joint_pitch_rad\\{-?[0-9.]+, (-?[0-9.]+)\\}"), HeadLimits.PITCH_MAX, NONE);
  }

  @Test
  public void outlineGoesAroundOnce() {
    double[][] outline = HeadLimits.outline();
    assertArrayEquals(new double[] {-HeadLimits.YAW_MAX, -0.449073}, outline[0], NONE);
    assertArrayEquals(new double[] {-HeadLimits.YAW_MAX, 0.330041}, outline[outline.length - 1], NONE);
    double area = 0;
    for (int i = 0; i < outline.length; ++i) {
      double[] a = outline[i], b = outline[(i + 1) % outline.length];
      area += (a[0] * b[1] - b[0] * a[1]) / 2;
    }
    // By hand: twice the trapezoids between the rows; the pitch that the joint itself ends at changes the fourth digit.
    assertEquals(3.476, area, 0.001);
  }

  private static double number(String source, String pattern) {
    Matcher found = Pattern.compile(pattern).matcher(source);
    return found.find() ? Double.parseDouble(found.group(1)) : Double.NaN;
  }
}

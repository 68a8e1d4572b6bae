package gazed.spy;

import static org.junit.Assert.assertEquals;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.head_command_t;
import gazed.head_state_t;
import gazed.located_point_t;
import gazed.look_t;
import gazed.saliency_map_t;
import java.awt.Graphics2D;
import java.awt.image.BufferedImage;
import java.util.List;
import java.util.Random;
import javax.swing.JComponent;
import org.junit.Test;

/** Whatever the numbers of a message are, it is painted or left out. */
public class PaintingTest {
  private static final int MESSAGES = 300;
  private static final double[] NASTY = {Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, 1e300, -1e300, 1e-300, -1, 0, 0.5, 100, 1e9};

  private final Random random = new Random(1);
  private final CameraPanel camera = new CameraPanel();
  private final LookPanel look = new LookPanel();
  private final PlanPanel above = new PlanPanel(Plane.ABOVE);
  private final PlanPanel side = new PlanPanel(Plane.SIDE);
  private final HeadPanel head = new HeadPanel();

  @Test
  public void nastyNumbersHarmNothing() {
    for (int i = 0; i < MESSAGES; ++i) {
      Robot robot = new Robot();
      robot.take(headState());
      robot.take(command());
      if (random.nextBoolean()) robot.take(image());
      robot.take(map());
      robot.take(fixation());
      if (random.nextInt(4) > 0) robot.take(point());
      Robot.Sight sight = robot.sight();
      Fixation fixation = sight.fixations().get(0);
      camera.show(sight);
      boolean both = fixation.firstLook() != null && fixation.lastLook() != null;
      List<double[]> line = both ? EpipolarLine.of(fixation.account(), fixation.firstLook(), fixation.lastLook()) : List.of();
      look.show(sight.image(), fixation.lastLook(), line);
      above.show(sight, fixation);
      side.show(sight, fixation);
      head.show(sight, fixation);
      for (JComponent panel : new JComponent[] {camera, look, above, side, head}) paint(panel);
      Words.range(fixation);
      Words.looks(fixation);
    }
  }

  @Test
  public void aWindowOfNoSizeIsPaintedToo() {
    Robot.Sight sight = new Robot().sight();
    above.show(sight, null);
    above.setSize(0, 0);
    above.paint(new BufferedImage(1, 1, BufferedImage.TYPE_INT_RGB).createGraphics());
    assertEquals(0, above.getWidth());
  }

  private static void paint(JComponent panel) {
    panel.setSize(400, 300);
    BufferedImage picture = new BufferedImage(400, 300, BufferedImage.TYPE_INT_RGB);
    Graphics2D g = picture.createGraphics();
    panel.paint(g);
    g.dispose();
  }

  private double nasty() {
    return NASTY[random.nextInt(NASTY.length)];
  }

  private void fill(double[] values) {
    for (int i = 0; i < values.length; ++i) values[i] = nasty();
  }

  private head_state_t headState() {
    head_state_t state = new head_state_t();
    state.yaw_rad = nasty();
    state.pitch_rad = nasty();
    return state;
  }

  private head_command_t command() {
    head_command_t command = new head_command_t();
    command.yaw_rad = nasty();
    command.pitch_rad = nasty();
    return command;
  }

  private image_t image() {
    image_t image = new image_t();
    image.width = 1 + random.nextInt(4);
    image.height = 1 + random.nextInt(4);
    image.row_stride = random.nextInt(20) - 2;
    int[] formats = {Pictures.YUYV, Pictures.UYVY, Pictures.RGB3, Pictures.BGR3, Pictures.GREY, Pictures.MJPG, 7};
    image.pixelformat = formats[random.nextInt(formats.length)];
    image.data = new byte[random.nextInt(60)];
    return image;
  }

  private saliency_map_t map() {
    saliency_map_t map = new saliency_map_t();
    map.width = (short) (random.nextInt(5) - 1);
    map.height = (short) (random.nextInt(5) - 1);
    map.map = new byte[random.nextInt(4) == 0 ? 3 : Math.max(0, map.width * map.height)];
    fill(map.peak_px);
    return map;
  }

  private fixation_t fixation() {
    fixation_t fixation = new fixation_t();
    fill(fixation.report_position_m);
    if (random.nextBoolean()) fill(fixation.robot);
    if (random.nextBoolean()) fixation.robot[0] = 600;
    fixation.nlooks = (short) random.nextInt(4);
    fixation.looks = new look_t[fixation.nlooks];
    for (int i = 0; i < fixation.nlooks; ++i) fixation.looks[i] = look();
    return fixation;
  }

  private look_t look() {
    look_t look = new look_t();
    fill(look.measured_rad);
    fill(look.refined_rad);
    fill(look.torso_rad);
    fill(look.torso_m);
    fill(look.pixel);
    fill(look.epipole);
    look.used = random.nextBoolean();
    look.noutline = look.ncorners = 3;
    look.outline_px = new float[3][2];
    look.corner_px = new float[3][2];
    look.corner_used = new byte[] {0, 1, 2};
    for (int i = 0; i < 3; ++i) {
      look.outline_px[i][0] = (float) nasty();
      look.corner_px[i][1] = (float) nasty();
    }
    return look;
  }

  private located_point_t point() {
    located_point_t point = new located_point_t();
    point.reason = "";
    point.status = (byte) random.nextInt(10);
    fill(point.position_m);
    for (double[] row : point.covariance_m2) fill(row);
    point.range_m = nasty();
    point.range_sigma_m = nasty();
    point.inverse_range_per_m = nasty();
    return point;
  }
}

package gazed.spy;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.head_state_t;
import gazed.located_point_t;
import gazed.look_t;
import gazed.saliency_map_t;
import gazed.status_t;
import java.io.IOException;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;
import lcm.logging.Log;

/** The messages of a robot that sees what the test knows. Every frame shows the same. */
final class KnownRobot {
  /** Two datagrams of LCM: such a frame reaches a receiver of the smallest buffer on a busy machine. */
  static final int WIDTH = 320, HEIGHT = 240;
  static final int BACKGROUND = 0x32;
  /** White squares, for the test to find where pixels of the frame are on the screen. */
  static final int[][] SQUARES = {{20, 20}, {299, 20}, {20, 219}, {299, 219}};
  static final int SQUARE_HALF = 6;

  static final int HOT_CELL_X = 10, HOT_CELL_Y = 5;
  static final double[] WINNER = {240, 160};
  static final double[] TARGET_1 = {100, 150};
  static final float[][] OUTLINE = {{70, 120}, {130, 120}, {130, 180}, {70, 180}};
  static final double[] TARGET_2 = {165, 100};
  static final float[][] CORNERS = {{250, 50}, {260, 200}};
  static final String FAULT = "the head is limp: stiffness 0.0 found, 0.1 or more wanted";

  /** Metres, torso frame: where, and the standard deviations along the axes. */
  static final double[] POINT = {1.0, -0.5, 0.3};
  static final double[] SIGMAS = {0.15, 0.10, 0.08};

  private static final long BEGAN = 1_700_000_000_000_000L;
  private static final long PERIOD_US = 66_667;  // 15 frames a second

  private final String prefix;

  KnownRobot(String prefix) {
    this.prefix = prefix;
  }

  /** One frame's time after the other, as a thread of its own, until the process ends. */
  void publishForEver() throws IOException {
    LCM lcm = new LCM();
    Thread thread = new Thread(() -> {
      for (int frame = 0;; ++frame) {
        messages(frame).forEach(lcm::publish);
        try {
          Thread.sleep(PERIOD_US / 1000);
        } catch (InterruptedException end) {
          return;
        }
      }
    });
    thread.setDaemon(true);
    thread.start();
  }

  void writeLog(String file, int frames) throws IOException {
    Log log = new Log(file, "rw");
    for (int frame = 0; frame < frames; ++frame) {
      for (Map.Entry<String, LCMEncodable> message : messages(frame).entrySet()) {
        LCMDataOutputStream out = new LCMDataOutputStream();
        message.getValue().encode(out);
        Log.Event event = new Log.Event();
        event.utime = time(frame);
        event.eventNumber = frame;
        event.channel = message.getKey();
        event.data = Arrays.copyOf(out.getBuffer(), out.size());
        log.write(event);
      }
    }
    log.close();
  }

  private static long time(int frame) {
    return BEGAN + frame * PERIOD_US;
  }

  private Map<String, LCMEncodable> messages(int frame) {
    Map<String, LCMEncodable> messages = new LinkedHashMap<>();
    messages.put(prefix + "_HEAD_STATE", head(time(frame)));
    messages.put(prefix + "_IMAGE", image(time(frame)));
    messages.put(prefix + "_SALIENCY", map(time(frame)));
    messages.put(prefix + "_STATUS", status(time(frame)));
    if (frame % 15 == 0) {
      messages.put(prefix + "_LOCATED_POINT", point(frame));
      messages.put(prefix + "_FIXATION", fixation(frame));
    }
    return messages;
  }

  private static head_state_t head(long utime) {
    head_state_t head = new head_state_t();
    head.utime = utime;
    return head;
  }

  private static image_t image(long utime) {
    image_t image = new image_t();
    image.utime = utime;
    image.width = WIDTH;
    image.height = HEIGHT;
    image.row_stride = WIDTH;
    image.pixelformat = Pictures.GREY;
    image.size = WIDTH * HEIGHT;
    image.data = new byte[image.size];
    Arrays.fill(image.data, (byte) BACKGROUND);
    for (int[] square : SQUARES) {
      for (int dy = -SQUARE_HALF; dy <= SQUARE_HALF; ++dy) {
        for (int dx = -SQUARE_HALF; dx <= SQUARE_HALF; ++dx) image.data[(square[1] + dy) * WIDTH + square[0] + dx] = (byte) 255;
      }
    }
    image.metadata = new bot_core.image_metadata_t[0];
    return image;
  }

  private static saliency_map_t map(long utime) {
    saliency_map_t map = new saliency_map_t();
    map.utime = utime;
    map.width = WIDTH / HeatMap.CELL_PX;
    map.height = HEIGHT / HeatMap.CELL_PX;
    map.size = map.width * map.height;
    map.map = new byte[map.size];
    map.map[HOT_CELL_Y * map.width + HOT_CELL_X] = (byte) 255;
    map.peak_px = WINNER;
    return map;
  }

  private static status_t status(long utime) {
    status_t status = new status_t();
    status.utime = utime;
    status.state = "looking";
    status.camera = "v4l2 640x480";
    status.head = "lola";
    status.fault = FAULT;
    status.frames = 77;
    return status;
  }

  static located_point_t point(int frame) {
    located_point_t point = new located_point_t();
    point.utime = time(frame);
    point.fixation = frame / 15 + 1;
    point.status = located_point_t.LOCATED;
    point.reason = "relative sigma 9 % is within the gate of 15 %";
    point.views = 2;
    point.position_m = POINT;
    for (int i = 0; i < 3; ++i) point.covariance_m2[i][i] = SIGMAS[i] * SIGMAS[i];
    point.range_m = 1.12;
    point.range_sigma_m = 0.1;
    return point;
  }

  private static fixation_t fixation(int frame) {
    fixation_t fixation = new fixation_t();
    fixation.utime = time(frame);
    fixation.fixation = frame / 15 + 1;
    fixation.status_name = "LOCATED";
    fixation.method = "all_looks";
    fixation.robot_name = "nao-v6";
    fixation.nlooks = 2;
    fixation.looks = new look_t[] {look(time(frame), TARGET_1, 0), look(time(frame), TARGET_2, 0.2)};
    fixation.looks[0].noutline = OUTLINE.length;
    fixation.looks[0].outline_px = OUTLINE;
    fixation.looks[0].ncorners = CORNERS.length;
    fixation.looks[0].corner_px = CORNERS;
    fixation.looks[0].corner_used = new byte[] {1, 0};
    Arrays.fill(fixation.report_position_m, Double.NaN);
    fixation.robot = new double[] {304, 159.5, 119.5, 0, 0, 0, 0, 0, 0.05871, 0, 0.06364, 0, 0};
    return fixation;
  }

  private static look_t look(long utime, double[] pixel, double yaw) {
    look_t look = new look_t();
    look.utime = utime;
    look.measured_rad = look.refined_rad = new double[] {yaw, 0};
    look.pixel = pixel;
    look.epipole = new double[] {Double.NaN, Double.NaN};
    look.used = true;
    look.reason = "";
    look.outline_px = look.corner_px = new float[0][];
    look.corner_used = new byte[0];
    return look;
  }
}

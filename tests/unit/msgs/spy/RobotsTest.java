package gazed.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.located_point_t;
import gazed.look_t;
import gazed.saliency_map_t;
import gazed.status_t;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.List;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;
import org.junit.Test;

public class RobotsTest {
  private final Robots robots = new Robots();

  private static byte[] encoded(LCMEncodable message) throws IOException {
    LCMDataOutputStream out = new LCMDataOutputStream();
    message.encode(out);
    return Arrays.copyOf(out.getBuffer(), out.size());
  }

  private void send(String channel, byte[] bytes) {
    robots.messageReceived(null, channel, new LCMDataInputStream(bytes));
  }

  private static image_t frame(long utime) {
    image_t image = new image_t();
    image.utime = utime;
    image.width = 2;
    image.height = 1;
    image.row_stride = 2;
    image.pixelformat = Pictures.GREY;
    image.size = 2;
    image.data = new byte[2];
    return image;
  }

  private static look_t look(long utime, boolean used) {
    look_t look = new look_t();
    look.utime = utime;
    look.used = used;
    look.reason = "";
    return look;
  }

  private static fixation_t fixation(int number, look_t... looks) {
    fixation_t fixation = new fixation_t();
    fixation.utime = 1000 + number;
    fixation.fixation = number;
    fixation.status_name = fixation.method = fixation.robot_name = "";
    fixation.nlooks = (short) looks.length;
    fixation.looks = looks;
    return fixation;
  }

  private static located_point_t point(int number) {
    located_point_t point = new located_point_t();
    point.utime = 1000 + number;
    point.fixation = number;
    point.reason = "why";
    return point;
  }

  @Test
  public void prefixesKeepRobotsApart() throws IOException {
    send("NAO7_LOCATED_POINT", encoded(point(1)));
    send("FIELD_B_LOCATED_POINT", encoded(point(2)));
    assertEquals(List.of("FIELD_B", "NAO7"), robots.prefixes());
    assertEquals(1, robots.robot("NAO7").sight().fixations().get(0).number());
    assertEquals(2, robots.robot("FIELD_B").sight().fixations().get(0).number());
  }

  @Test
  public void pointAndAccountBecomeOneFixationInEitherOrder() throws IOException {
    send("A_LOCATED_POINT", encoded(point(1)));
    send("A_FIXATION", encoded(fixation(1)));
    send("A_FIXATION", encoded(fixation(2)));
    send("A_LOCATED_POINT", encoded(point(2)));
    List<Fixation> fixations = robots.robot("A").sight().fixations();
    assertEquals(2, fixations.size());
    for (Fixation fixation : fixations) {
      assertNotNull(fixation.point());
      assertNotNull(fixation.account());
    }
    assertEquals("the newest comes first", 2, fixations.get(0).number());
  }

  @Test
  public void ofALogThatIsPlayedAgainTheNewestIsFirst() throws IOException {
    for (int time = 0; time < 2; ++time) {
      for (int i = 1; i <= 3; ++i) {
        send("A_LOCATED_POINT", encoded(point(i)));
        send("A_FIXATION", encoded(fixation(i)));
        assertEquals(i, robots.robot("A").sight().fixations().get(0).number());
      }
    }
    assertEquals(3, robots.robot("A").sight().fixations().size());
  }

  @Test
  public void theLastTwentyAreKept() throws IOException {
    for (int i = 1; i <= 25; ++i) send("A_LOCATED_POINT", encoded(point(i)));
    List<Fixation> fixations = robots.robot("A").sight().fixations();
    assertEquals(20, fixations.size());
    assertEquals(6, fixations.get(19).number());
  }

  @Test
  public void aFixationFindsTheFramesOfItsFirstAndItsLastUsedLook() throws IOException {
    for (long utime : new long[] {10, 20, 30, 40}) send("A_IMAGE", encoded(frame(utime)));
    send("A_FIXATION", encoded(fixation(1, look(10, true), look(20, true), look(40, false))));
    Fixation fixation = robots.robot("A").sight().fixations().get(0);
    assertEquals(10, fixation.first().utime);
    assertEquals(20, fixation.last().utime);
  }

  @Test
  public void withoutLooksAndFramesThereAreNone() throws IOException {
    send("A_FIXATION", encoded(fixation(1)));
    send("A_FIXATION", encoded(fixation(2, look(10, false))));
    Fixation none = robots.robot("A").sight().fixations().get(1), one = robots.robot("A").sight().fixations().get(0);
    assertNull(none.firstLook());
    assertNotNull(one.firstLook());
    assertNull(one.first());
    assertNull(one.lastLook());
  }

  @Test
  public void aCameraOfAnotherNameBelongsToTheOnlyRobot() throws IOException {
    status_t status = new status_t();
    status.state = status.camera = status.head = status.fault = "";
    send("A_STATUS", encoded(status));
    send("TOP_CAMERA", encoded(frame(5)));
    assertEquals(List.of("A"), robots.prefixes());
    assertEquals(5, robots.robot("A").sight().image().utime);
  }

  @Test
  public void imageThatLiesIsAFaultInWords() throws IOException {
    send("A_IMAGE", encoded(frame(5)));
    byte[] lying = encoded(frame(6));
    ByteBuffer.wrap(lying).putInt(8 + 8 + 4 * 4, Integer.MAX_VALUE);  // size, after fingerprint, utime and four sizes
    send("A_IMAGE", lying);
    assertTrue(robots.robot("A").sight().imageFault().contains("2147483647 bytes"));
    assertEquals("the last good one stays", 5, robots.robot("A").sight().image().utime);
    send("A_IMAGE", encoded(frame(7)));
    assertNull(robots.robot("A").sight().imageFault());
  }

  @Test
  public void messagesThatLieAreLeftOut() throws IOException {
    for (LCMEncodable message : new LCMEncodable[] {fixation(1, look(1, true)), point(1), new saliency_map_t()}) {
      if (message instanceof saliency_map_t) ((saliency_map_t) message).map = new byte[0];
      byte[] whole = encoded(message);
      for (int length = 0; length < whole.length; ++length) send("A_X", Arrays.copyOf(whole, length));
      for (int i = 8; i + 4 <= whole.length; ++i) {
        byte[] broken = whole.clone();
        broken[i] = (byte) 0xff;
        send("A_X", broken);
      }
    }
  }

  @Test
  public void otherPeoplesMessagesMakeNoRobot() {
    send("SOMETHING", new byte[] {1, 2, 3});
    send("SOMETHING", new byte[64]);
    assertTrue(robots.prefixes().isEmpty());
  }

  @Test
  public void aMapWhoseSizesDoNotFitIsNotDrawn() {
    saliency_map_t map = new saliency_map_t();
    map.width = 3;
    map.height = 2;
    map.map = new byte[5];
    assertNull(HeatMap.of(map));
    map.map = new byte[6];
    assertNotNull(HeatMap.of(map));
  }

  @Test
  public void aStatusOfALaterVersionIsUnknown() {
    assertSame(Outcome.UNKNOWN, Outcome.of((byte) 42));
    assertSame(Outcome.TARGET_LOST, Outcome.of(located_point_t.TARGET_LOST));
    assertFalse(Fixation.of(point(1)).with(Fixation.of(point(1))).outcome() == Outcome.UNKNOWN);
  }
}

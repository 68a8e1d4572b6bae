package gazed.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import gazed.head_state_t;
import java.awt.geom.Point2D;
import org.junit.Test;

public class TurnTest {
  private static final double ROUNDING_PX = 1e-6;

  private static head_state_t head(double yaw, double pitch) {
    head_state_t head = new head_state_t();
    head.yaw_rad = yaw;
    head.pitch_rad = pitch;
    return head;
  }

  @Test
  public void aHeadThatTurnsLeftMovesThingsToTheRight() {
    Lens lens = BelievedRobot.UNKNOWN.lens();
    Point2D moved = Turn.between(BelievedRobot.UNKNOWN, head(0, 0), head(0.2, 0), lens.centreX(), lens.centreY())
        .transform(new Point2D.Double(lens.centreX(), lens.centreY()), null);
    assertEquals(lens.centreX() + lens.focalPx() * Math.tan(0.2), moved.getX(), ROUNDING_PX);
    assertEquals(lens.centreY(), moved.getY(), ROUNDING_PX);
  }

  @Test
  public void aHeadThatStandsStillOrIsUnknownMovesNothing() {
    assertTrue(Turn.between(BelievedRobot.UNKNOWN, null, head(1, 0), 10, 10).isIdentity());
    Point2D same = Turn.between(BelievedRobot.UNKNOWN, head(0.3, 0.1), head(0.3, 0.1), 100, 50).transform(new Point2D.Double(100, 50), null);
    assertEquals(100, same.getX(), ROUNDING_PX);
    assertEquals(50, same.getY(), ROUNDING_PX);
  }

  @Test
  public void whatIsBehindTheHeadIsNowhere() {
    assertNull(Turn.between(BelievedRobot.UNKNOWN, head(-1, 0), head(1, 0), 320, 240));
  }
}

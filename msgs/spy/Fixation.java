package gazed.spy;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.located_point_t;
import gazed.look_t;

/**
 * One fixation, of the two messages that tell of it. Either may be null: of an older recording made with gazed --record there is no point,
 * and what came before this window opened is missing. The pictures are those of the first and of the last look that is of use, or null.
 */
record Fixation(located_point_t point, fixation_t account, image_t first, image_t last) {
  static Fixation of(located_point_t point) {
    return new Fixation(point, null, null, null);
  }

  static Fixation of(fixation_t account, Frames frames) {
    return new Fixation(null, account, pictureOf(firstLook(account), frames), pictureOf(lastLook(account), frames));
  }

  private static image_t pictureOf(look_t look, Frames frames) {
    return look == null ? null : frames.at(look.utime);
  }

  /** One of both messages, when the other has come before. */
  Fixation with(Fixation other) {
    return new Fixation(point != null ? point : other.point, account != null ? account : other.account,
        first != null ? first : other.first, last != null ? last : other.last);
  }

  /** Whether this is the half that the other lacks. */
  boolean completes(Fixation other) {
    return point != null ? other.point == null : other.account == null;
  }

  boolean isOf(long utime, int number) {
    return utime() == utime && number() == number;
  }

  long utime() {
    return point != null ? point.utime : account.utime;
  }

  int number() {
    return point != null ? point.fixation : account.fixation;
  }

  Outcome outcome() {
    return Outcome.of(point != null ? point.status : account.status);
  }

  look_t firstLook() {
    return account == null ? null : firstLook(account);
  }

  look_t lastLook() {
    return account == null ? null : lastLook(account);
  }

  /** Whether there is a place to draw. */
  boolean hasPosition() {
    return point != null && Double.isFinite(point.position_m[0]) && Double.isFinite(point.position_m[1])
        && Double.isFinite(point.position_m[2]);
  }

  private static look_t firstLook(fixation_t account) {
    return account.nlooks > 0 ? account.looks[0] : null;
  }

  /** The last one that the point is made of; where none is, the last one taken. Never the first. */
  private static look_t lastLook(fixation_t account) {
    for (int i = account.nlooks - 1; i > 0; --i) {
      if (account.looks[i].used) return account.looks[i];
    }
    return account.nlooks > 1 ? account.looks[account.nlooks - 1] : null;
  }
}

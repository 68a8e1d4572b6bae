package gazed.spy;

import java.time.Instant;
import java.time.ZoneId;
import java.time.format.DateTimeFormatter;
import java.util.Locale;

/** Numbers as people read them, with their units. */
final class Words {
  private static final DateTimeFormatter CLOCK = DateTimeFormatter.ofPattern("HH:mm:ss").withZone(ZoneId.systemDefault());

  private Words() {}

  static String time(long utime) {
    return CLOCK.format(Instant.ofEpochSecond(Math.floorDiv(utime, 1_000_000L)));
  }

  /** "0.300 m \u00b1 0.007", or what is known instead. */
  static String range(Fixation fixation) {
    if (fixation.point() == null) return "no point came";
    double range = fixation.point().range_m, sigma = fixation.point().range_sigma_m;
    if (Double.isFinite(range) && Double.isFinite(sigma)) return String.format(Locale.ROOT, "%.3f m \u00b1 %.3f", range, sigma);
    double inverse = fixation.point().inverse_range_per_m, inverseSigma = fixation.point().inverse_range_sigma_per_m;
    if (Double.isFinite(inverse) && Double.isFinite(inverseSigma) && inverse + inverseSigma > 0) {
      return String.format(Locale.ROOT, "over %.2f m", 1 / (inverse + inverseSigma));
    }
    return "\u2013";
  }

  static String angle(double radians) {
    return Double.isFinite(radians) ? String.format(Locale.ROOT, "%.3f rad (%.1f\u00b0)", radians, Math.toDegrees(radians)) : "unknown";
  }

  static String amount(float value, String unit) {
    return Float.isFinite(value) ? String.format(Locale.ROOT, "%.1f %s", value, unit) : "unknown";
  }

  /** Why there is no point, or how good it is. */
  static String reason(Fixation fixation) {
    return fixation.point() == null ? "" : fixation.point().reason;
  }

  static String looks(Fixation fixation) {
    if (fixation.account() == null) return Integer.toString(fixation.point().views);
    int used = 0;
    for (gazed.look_t look : fixation.account().looks) used += look.used ? 1 : 0;
    return used + " of " + fixation.account().nlooks;
  }
}

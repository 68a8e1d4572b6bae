"""What many judged fixations come to: errors, shares, and the bands that their number allows.

A fixation is a row of gazed_accuracy's CSV, numbers as floats, NaN where there is none.
"""
import math
from collections import Counter

NORMAL_95 = 1.959964  # sigmas that hold 95 % of a normal distribution
WRONG = 0.20          # relative range error of a point that is plainly wrong


def percentile_of_absolute(values, share):
    """The least x for which at least `share` of the values lie within +-x; NaN without values."""
    sizes = sorted(abs(value) for value in values)
    if not sizes:
        return math.nan
    return sizes[max(0, math.ceil(share * len(sizes)) - 1)]


def share(flags):
    """NaN without any."""
    flags = list(flags)
    return sum(flags) / len(flags) if flags else math.nan


def two_sigmas(probability, count):
    """Twice the standard deviation of a share of `count` independent trials."""
    return 2 * math.sqrt(probability * (1 - probability) / count) if count else math.inf


def widened(low, high, count):
    """A band for a share, wider by two binomial standard deviations at each end."""
    return low - two_sigmas(low, count), high + two_sigmas(high, count)


def relative_range_error(fixation):
    return fixation["range_m"] / fixation["true_range_m"] - 1


def is_located(fixation):
    """A point that was published as located and can be judged."""
    return fixation["status"] == "LOCATED" and math.isfinite(fixation["true_range_m"])


def has_interval(fixation):
    return fixation["status"] in ("LOCATED", "UNCERTAIN") and math.isfinite(fixation["true_range_m"])


def interval_holds_truth(fixation, sigmas):
    """Of the inverse range; one that is no number holds nothing."""
    off = abs(fixation["inverse_range_per_m"] - 1 / fixation["true_range_m"])
    return off <= sigmas * fixation["inverse_range_sigma_per_m"]


class Pool:
    """The figures of some fixations."""

    def __init__(self, fixations):
        self.fixations = fixations
        self.located = [f for f in fixations if is_located(f)]
        self.judged = [f for f in fixations if has_interval(f)]
        # Before these the robot saw that something stood out.
        self.outstanding = [f for f in fixations if f["status"] != "NO_SALIENT_OBJECT"]

    def statuses(self):
        return Counter(f["status"] for f in self.fixations)

    def located_share(self):
        return share(f["status"] == "LOCATED" for f in self.outstanding)

    def placed_share(self):
        return share(f["status"] in ("LOCATED", "UNCERTAIN") for f in self.outstanding)

    def swapped(self, off_rad):
        """Of LOCATED points, those that are somewhere else than what look 1 saw."""
        return share(abs(relative_range_error(f)) > WRONG or f["bearing_error_rad"] > off_rad for f in self.located)

    def range_error(self, part=0.68):
        return percentile_of_absolute(map(relative_range_error, self.located), part)

    def range_error_band(self, part=0.68):
        """The same two binomial standard deviations of its rank lower and higher."""
        spread = two_sigmas(part, len(self.located))
        return (self.range_error(max(part - spread, 0.0)), self.range_error(min(part + spread, 1.0)))

    def range_bias(self):
        errors = sorted(map(relative_range_error, self.located))
        return errors[len(errors) // 2] if errors else math.nan

    def bearing_error_rad(self, part=0.68):
        return percentile_of_absolute((f["bearing_error_rad"] for f in self.located
                                       if math.isfinite(f["bearing_error_rad"])), part)

    def wrong(self):
        return self.wrong_by(WRONG)

    def coverage(self, sigmas):
        return share(interval_holds_truth(f, sigmas) for f in self.judged)

    def mean(self, key):
        """Of fixations in which something was looked at."""
        values = [f[key] for f in self.outstanding if math.isfinite(f[key])]
        return sum(values) / len(values) if values else math.nan

    def wrong_by(self, part):
        return share(abs(relative_range_error(f)) > part for f in self.located)

    def median(self, key):
        values = sorted(f[key] for f in self.fixations if math.isfinite(f[key]))
        return values[len(values) // 2] if values else math.nan

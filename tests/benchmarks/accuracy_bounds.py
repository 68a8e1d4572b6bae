"""The bounds of `accuracy`, and whether they are kept.

A bound is what must hold; a goal is what is aimed at.
"""
import math

from accuracy_statistics import NORMAL_95, Pool, widened

COMPARED_LOOKS = (2, 8)  # the report's rule, and several looks

# 68th percentile of the relative range error's absolute value, LOCATED points: bound and goal.
RANGE_ERRORS = {
    "textured_03": (0.020, 0.015),
    "textured_10": (0.030, 0.025),
    "pair_03": (0.040, None),
    "joint20_03": (0.025, 0.018),
    "joint20_10": (0.050, 0.040),
    "blank_03": (0.025, None),
    "blank_10": (0.040, None),
}
# Of LOCATED points, those over 20 % wrong: pooled over the calibrated 8-look rows, and in each.
MOST_WRONG_POOLED, GOAL_WRONG_POOLED = 0.01, 0.003
MOST_WRONG, GOAL_WRONG = 0.04, 0.02
# From the last view to the point, 95 % of them, ms of CPU time on this machine.
MOST_LOCATE_MS, GOAL_LOCATE_MS = 15, 5
NOT_EIGHT_LOOKS = ("pair_03", "pair_real_03", "looks_03")
# Of LOCATED and UNCERTAIN, those whose interval of inverse range holds the truth.
COVERAGES = ((1.0, 0.62, 0.74, "68 %"), (NORMAL_95, 0.92, 0.98, "95 %"))


def pooled_rows(pools):
    """All fixations of the rows with eight looks."""
    return Pool([f for name, pool in pools.items() if name not in NOT_EIGHT_LOOKS for f in pool.fixations])


def checks(pools, pooled):
    """(what, value, the bound in words, kept)"""
    for name, pool in pools.items():
        if name in RANGE_ERRORS:
            bound, goal = RANGE_ERRORS[name]
            words = f"<= {bound:.1%}" + (f" (goal {goal:.1%})" if goal else "")
            yield f"{name}: range error, 68 %", pool.range_error(), words, pool.range_error() <= bound
    if pooled.fixations:
        yield ("eight looks, pooled: over 20 % wrong", pooled.wrong(),
               f"<= {MOST_WRONG_POOLED:.1%} (goal {GOAL_WRONG_POOLED:.1%})", pooled.wrong() <= MOST_WRONG_POOLED)
    for name, pool in pools.items():
        if name not in NOT_EIGHT_LOOKS and pool.located:
            yield (f"{name}: over 20 % wrong", pool.wrong(), f"<= {MOST_WRONG:.1%} (goal {GOAL_WRONG:.1%})",
                   pool.wrong() <= MOST_WRONG)
    for name, pool in pools.items():
        for sigmas, low, high, words in COVERAGES:
            value, (least, most) = pool.coverage(sigmas), widened(low, high, len(pool.judged))
            yield (f"{name}: {words} interval holds the truth", value,
                   f"{low:.0%} to {high:.0%}, of {len(pool.judged)}: {max(least, 0):.1%} to {min(most, 1):.1%}",
                   least <= value <= most)


def is_slow(pools):
    """Prints the time from the last view to the point; whether it is over the bound."""
    times_ms = sorted(f["locate_ms"] for pool in pools.values() for f in pool.located)
    if not times_ms:
        return False
    value_ms = times_ms[int(0.95 * (len(times_ms) - 1))]
    kept = value_ms <= MOST_LOCATE_MS
    print(f"{'PASS' if kept else 'FAIL'}  {'last view to point, 95 % of all, CPU time':52}{value_ms:6.1f} ms  "
          f"<= {MOST_LOCATE_MS} ms (goal {GOAL_LOCATE_MS} ms)")
    return not kept


def judge(pools, pooled):
    """Prints every bound; the number that is missed. What is no number keeps no bound."""
    missed = 0
    print()
    for what, value, bound, kept in checks(pools, pooled):
        shown = "none" if math.isnan(value) else f"{value:.2%}"
        print(f"{'PASS' if kept else 'FAIL'}  {what:52}{shown:>9}  {bound}")
        missed += not kept
    missed += is_slow(pools)
    print(f"{missed} missed" if missed else "all kept")
    return missed

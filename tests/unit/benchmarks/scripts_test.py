"""The parts of the measuring scripts that decide: run by ctest, or by python3 -m unittest."""
import contextlib
import io
import math
import sys
import unittest
from pathlib import Path
from statistics import NormalDist

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))

from accuracy_bounds import COVERAGES, judge, pooled_rows  # noqa: E402
from accuracy_plots import distance_bins, groups  # noqa: E402
from accuracy_statistics import NORMAL_95, Pool, percentile_of_absolute, two_sigmas, widened  # noqa: E402
from blocks import blocks_of  # noqa: E402
from counting import parse  # noqa: E402
from releases import COLUMNS, FILE, lines, with_line  # noqa: E402


class Releases(unittest.TestCase):
    LINE = dict.fromkeys(COLUMNS, "1.5") | {"version": "0.10.0", "date": "2026-01-01"}

    def test_the_file_is_in_order(self):
        self.assertTrue(lines(FILE.read_text()))

    def test_a_line_is_put_in_its_place(self):
        text = with_line(",".join(COLUMNS) + "\n", self.LINE)
        text = with_line(text, self.LINE | {"version": "0.9.0"})
        self.assertEqual([line["version"] for line in lines(text)], ["0.9.0", "0.10.0"])
        text = with_line(text, self.LINE | {"version": "0.9.0", "bundle_v4_kB": ""})
        self.assertEqual([line["bundle_v4_kB"] for line in lines(text)], ["", "1.5"])

    def test_what_is_no_release_is_refused(self):
        good = with_line(",".join(COLUMNS) + "\n", self.LINE)
        for wrong in ("", good.replace("version", "release"), good.replace("1.5", "-1.5"), good.replace("1.5", "nan"), good.replace(",1.5", "", 1),
                      good + good.split("\n")[1]):
            with self.assertRaises(ValueError):
                lines(wrong)


class Callgrind(unittest.TestCase):
    def test_own_cost_counts_and_that_of_callees_does_not(self):
        profile = """positions: instr line
events: Ir
fn=outer
0x10 0 3
cfn=inner
calls=3 0x40 0
0x12 0 999
0x12 0 3
fn=inner
0x40 7 6
fn=inner'2
0x40 7 1
totals: 13""".splitlines()
        self.assertEqual(parse(profile), {0x10: 3, 0x12: 3, 0x40: 7})


def blocks(code, counts):
    return [(block.instructions, block.executions) for block in
            blocks_of([(address, text, "f") for address, text in code], counts)]


class Blocks(unittest.TestCase):
    def test_a_loop_is_a_block_of_its_own(self):
        code = [(1, "movl a"), (2, "addl b"), (3, "jne    2 <f+0x1>"), (4, "movl c"), (5, "retl")]
        self.assertEqual(blocks(code, {1: 1, 2: 8, 3: 8, 4: 1, 5: 1}),
                         [(["movl a"], 1), (["addl b", "jne    2 <f+0x1>"], 8),
                          (["movl c", "retl"], 1)])

    def test_two_loops_of_equal_counts_stay_two(self):
        code = [(1, "addl a"), (2, "jne    1 <f>"), (3, "addl b"), (4, "jne    3 <f+0x2>")]
        self.assertEqual([len(b) for b, _ in blocks(code, dict.fromkeys(range(1, 5), 8))], [2, 2])

    def test_a_jump_forward_that_is_never_taken_does_not_cut(self):
        code = [(1, "addl a"), (2, "je     9 <f+0x8>"), (3, "addl b")]
        self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 5})], [3])

    def test_a_jump_forward_that_is_sometimes_taken_does(self):
        code = [(1, "addl a"), (2, "je     9 <f+0x8>"), (3, "addl b")]
        self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 4})], [2, 1])

    def test_what_never_falls_through_cuts(self):
        for last in ("jmp    9 <f+0x8>", "calll  40 <g>", "retl", "notrack jmp *%eax"):
            code = [(1, "addl a"), (2, last), (3, "addl b")]
            self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 5})], [2, 1], last)

    def test_code_that_is_not_executed_is_in_no_block(self):
        code = [(1, "addl a"), (2, "nop"), (3, "addl b")]
        self.assertEqual(blocks(code, {1: 5, 3: 5}), [(["addl a"], 5), (["addl b"], 5)])


class Percentiles(unittest.TestCase):
    def test_the_sign_does_not_count(self):
        self.assertEqual(percentile_of_absolute([-4, 3, -2, 1], 0.5), 2)
        self.assertEqual(percentile_of_absolute([-4, 3, -2, 1], 0.75), 3)

    def test_at_least_the_share_lies_within(self):
        self.assertEqual(percentile_of_absolute(range(1, 101), 0.68), 68)
        self.assertEqual(percentile_of_absolute(range(1, 101), 0.681), 69)
        self.assertEqual(percentile_of_absolute([7], 0.68), 7)
        self.assertEqual(percentile_of_absolute([7, 9], 0.0), 7)
        self.assertEqual(percentile_of_absolute([7, 9], 1.0), 9)

    def test_nothing_has_none(self):
        self.assertTrue(math.isnan(percentile_of_absolute([], 0.68)))


class Bands(unittest.TestCase):
    def test_two_binomial_standard_deviations(self):
        self.assertAlmostEqual(two_sigmas(0.5, 100), 0.1)
        self.assertEqual(two_sigmas(0.5, 0), math.inf)
        low, high = widened(0.62, 0.74, 600)
        # sqrt(0.62 0.38 / 600) = 0.019816, sqrt(0.74 0.26 / 600) = 0.017907
        self.assertAlmostEqual(low, 0.62 - 0.039632, places=5)
        self.assertAlmostEqual(high, 0.74 + 0.035814, places=5)


def fixation(status="LOCATED", estimate_m=1.0, truth_m=1.0, sigma_per_m=0.1, **more):
    return {"status": status, "range_m": estimate_m, "true_range_m": truth_m,
            "inverse_range_per_m": 1 / estimate_m, "inverse_range_sigma_per_m": sigma_per_m,
            "bearing_error_rad": 0.001, "locate_ms": 5.0, **more}


class Pools(unittest.TestCase):
    def test_errors_are_of_located_points_alone(self):
        pool = Pool([fixation(estimate_m=1.1), fixation(estimate_m=0.7),
                     fixation("UNCERTAIN", estimate_m=5.0), fixation("TARGET_LOST", math.nan)])
        self.assertAlmostEqual(pool.range_error(), 0.3)
        self.assertEqual(pool.wrong(), 0.5)

    def test_the_error_is_relative_to_the_true_range(self):
        self.assertAlmostEqual(Pool([fixation(estimate_m=0.33, truth_m=0.3)]).range_error(), 0.1)

    def test_intervals_are_of_located_and_uncertain_and_of_the_inverse_range(self):
        # 1/1.25 = 0.8 and 1/0.8 = 1.25 against 1: off by 0.2 and 0.25.
        pool = Pool([fixation(estimate_m=1.25, sigma_per_m=0.21),
                     fixation("UNCERTAIN", estimate_m=0.8, sigma_per_m=0.21),
                     fixation("NO_SALIENT_OBJECT", math.nan)])
        self.assertEqual(pool.coverage(1), 0.5)
        self.assertEqual(pool.coverage(NORMAL_95), 1.0)

    def test_an_interval_that_is_no_number_holds_nothing(self):
        self.assertEqual(Pool([fixation("UNCERTAIN", math.nan)]).coverage(1), 0.0)

    def test_what_has_no_truth_is_not_judged(self):
        pool = Pool([fixation(truth_m=math.nan)])
        self.assertTrue(math.isnan(pool.range_error()))
        self.assertTrue(math.isnan(pool.coverage(1)))

    def test_the_band_of_a_percentile_holds_it(self):
        pool = Pool([fixation(estimate_m=1 + i / 1000) for i in range(100)])
        low, high = pool.range_error_band()
        self.assertLess(low, pool.range_error())
        self.assertGreater(high, pool.range_error())

    def test_no_fixation_at_all(self):
        pool = Pool([])
        self.assertTrue(math.isnan(pool.wrong()))
        self.assertTrue(math.isnan(pool.median("range_m")))

    def test_groups_and_bins_hold_every_fixation_once(self):
        pool = Pool([fixation(looks_wanted=i % 3, target_range_m=0.2 + 0.1 * i) for i in range(20)])
        for parts in (groups(pool, "looks_wanted"), distance_bins(pool)):
            self.assertEqual(sum(len(part.fixations) for part in parts.values()), 20)
        bins = list(distance_bins(pool))
        self.assertEqual(bins, sorted(bins))


class Bounds(unittest.TestCase):
    def verdicts(self, pools):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            missed = judge(pools, pooled_rows(pools))
        return missed, printed.getvalue()

    def good(self):
        """Normal errors of 1 % with an honest sigma, one at each quantile."""
        normal = [NormalDist().inv_cdf((i + 0.5) / 600) for i in range(600)]
        return Pool([fixation(estimate_m=1 / (1 + 0.01 * z), sigma_per_m=0.01) for z in normal])

    def test_good_figures_keep_all_bounds(self):
        missed, printed = self.verdicts({"textured_03": self.good()})
        self.assertEqual(missed, 0, printed)

    def test_a_row_without_points_keeps_no_bound_of_errors(self):
        missed, printed = self.verdicts({"textured_03": Pool([fixation("TARGET_LOST", math.nan)] * 9)})
        self.assertIn("FAIL  textured_03: range error", printed)
        self.assertGreaterEqual(missed, 1 + len(COVERAGES))

    def test_too_sure_is_missed(self):
        pool = self.good()
        for judged in pool.fixations:
            judged["inverse_range_sigma_per_m"] *= 0.5
        missed, printed = self.verdicts({"textured_03": pool})
        self.assertIn("FAIL  textured_03: 68 % interval", printed)

    def test_too_slow_is_missed(self):
        pool = self.good()
        for judged in pool.fixations[:40]:
            judged["locate_ms"] = 20.0
        missed, printed = self.verdicts({"textured_03": pool})
        self.assertEqual(missed, 1)
        self.assertIn("FAIL  last view to point", printed)

    def test_what_does_not_stand_out_need_not_be_located(self):
        pool = Pool(self.good().fixations + [fixation("NO_SALIENT_OBJECT", math.nan)] * 300)
        _, printed = self.verdicts({"real_03": pool})
        self.assertIn("PASS  real_03: LOCATED", printed)
        lost = Pool(self.good().fixations + [fixation("TARGET_LOST", math.nan)] * 300)
        _, printed = self.verdicts({"real_03": lost})
        self.assertIn("FAIL  real_03: LOCATED", printed)

    def test_a_sweep_may_cost_half_as_much_again(self):
        def scaled(factor):
            return Pool([fixation(estimate_m=1 + factor * (f["range_m"] - 1)) for f in self.good().fixations])
        _, printed = self.verdicts({"sweep_03": scaled(1.4), "no_sweep_03": self.good()})
        self.assertIn("PASS  sweep_03: range error", printed)
        _, printed = self.verdicts({"sweep_03": scaled(1.6), "no_sweep_03": self.good()})
        self.assertIn("FAIL  sweep_03: range error", printed)

    def test_one_swapped_twin_is_one_too_many(self):
        pool = self.good()
        pool.fixations[0]["bearing_error_rad"] = 0.2
        _, printed = self.verdicts({"twins": pool})
        self.assertIn("FAIL  twins: looks of one and of the other", printed)

    def test_pairs_do_not_count_among_the_rows_of_eight_looks(self):
        wrong = Pool([fixation(estimate_m=2.0)] * 50)
        self.assertEqual(pooled_rows({"pair_03": wrong, "looks_03": wrong, "default_03": wrong}).fixations, [])

    def test_more_looks_or_time_than_are_needed_are_missed(self):
        def taking(looks, duration_s):
            return Pool([fixation(estimate_m=f["range_m"], sigma_per_m=0.01, looks=looks, duration_s=duration_s)
                         for f in self.good().fixations])
        _, printed = self.verdicts({"default_03": taking(4, 2.4)})
        self.assertIn("PASS  default_03: mean looks", printed)
        self.assertIn("PASS  default_03: mean time", printed)
        _, printed = self.verdicts({"default_03": taking(5, 2.6)})
        self.assertIn("FAIL  default_03: mean looks", printed)
        self.assertIn("FAIL  default_03: mean time", printed)

    def test_few_drifting_objects_may_be_located_wrong(self):
        def drifting(wrong):
            return Pool([fixation(estimate_m=1.15)] * wrong + [fixation(estimate_m=1.05)] * (600 - wrong))
        _, printed = self.verdicts({"default_drift_03": drifting(12)})
        self.assertIn("PASS  default_drift_03: over 10% wrong", printed)
        _, printed = self.verdicts({"default_drift_03": drifting(30)})
        self.assertIn("FAIL  default_drift_03: over 10%", printed)


if __name__ == "__main__":
    unittest.main()

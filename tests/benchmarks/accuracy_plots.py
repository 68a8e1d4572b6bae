"""The plots of `accuracy`, drawn by gnuplot."""
import math
import shutil
import subprocess

from accuracy_bounds import COVERAGES, RANGE_ERRORS
from accuracy_statistics import Pool

BINS = 6          # of a distance that was drawn at random
LEAST_LOCATED = 10  # points in a group whose percentile is shown
WITHOUT_BAND = 30   # with fewer its band is too wide to be drawn


def groups(pool, key):
    """The pool's fixations by a value that was drawn from a few."""
    return {value: Pool([f for f in pool.fixations if f[key] == value])
            for value in sorted({f[key] for f in pool.fixations})}


def distance_bins(pool):
    """By the target's distance, as many in each bin; under its geometric mean."""
    ordered = sorted(pool.fixations, key=lambda f: f["target_range_m"])
    size = max(1, math.ceil(len(ordered) / BINS))
    found = {}
    for start in range(0, len(ordered), size):
        part = ordered[start:start + size]
        mean = math.exp(sum(math.log(f["target_range_m"]) for f in part) / len(part))
        found[mean] = Pool(part)
    return found


def points(by_value):
    """x, error, low and high in per cent, one line a group."""
    lines = []
    for value, pool in by_value.items():
        if len(pool.located) >= LEAST_LOCATED:
            low, high = pool.range_error_band()
            if len(pool.located) < WITHOUT_BAND:
                low = high = pool.range_error()
            lines.append(f"{value} {100 * pool.range_error()} {100 * low} {100 * high}")
    return lines


def error_panels(pools):
    """(title, x label, settings, [(curve, lines)])"""
    fixed = {pool.median("target_range_m"): pool for name, pool in pools.items()
             if name in ("textured_03", "textured_10", "textured_20")}
    distance = [("textured", points(fixed))]
    if "cluttered" in pools:
        distance.append(("cluttered", points(distance_bins(pools["cluttered"]))))
    if "above" in pools:
        distance.append(("above the level", points(distance_bins(pools["above"]))))
    yield "range error against distance", "distance (m)", "set logscale x 2", distance
    if "looks_03" in pools:
        by_looks = groups(pools["looks_03"], "looks_wanted")
        yield "against looks, 0.3 m", "looks", "set logscale x 2", [("textured", points(by_looks))]
    if "joints_10" in pools:
        by_sigma = {1e3 * sigma: pool for sigma, pool in groups(pools["joints_10"], "encoder_sigma_rad").items()}
        yield ("against joint error, 1.0 m", "encoder sigma (mrad)", "set logscale x",
               [("textured, 8 looks", points(by_sigma))])


def error_script(pools):
    script = []
    for number, (title, label, settings, curves) in enumerate(error_panels(pools)):
        drawn = []
        for index, (curve, lines) in enumerate(curves):
            if lines:
                block = f"$e{number}_{index}"
                script += [f"{block} << EOD", *lines, "EOD"]
                drawn.append(f"{block} using 1:2:3:4 with yerrorlines lw 2 pt 7 ps 0.5 title '{curve}'")
        script += ["unset logscale", settings, "set autoscale", "set offsets graph 0.05, graph 0.05", "set yrange [0:*]", f"set title '{title}'",
                   f"set xlabel '{label}'", "set ylabel '68 % of points within (%)'",
                   f"plot {', '.join(drawn)}" if drawn else "set multiplot next"]
    return script


def row_script(pools):
    """Panels with one place on the x axis for each row."""
    def percent(value):
        return "NaN" if math.isnan(value) else f"{100 * value}"
    lines = []
    for index, (name, pool) in enumerate(pools.items()):
        statuses, count = pool.statuses(), len(pool.fixations)
        bound = RANGE_ERRORS.get(name, (math.nan, None))[0]
        lines.append(" ".join([
            str(index), name, percent(pool.range_error()), percent(bound),
            percent(10 * pool.bearing_error_rad()), *(percent(pool.coverage(c[0])) for c in COVERAGES),
            *(percent(statuses[s] / count) for s in ("LOCATED", "UNCERTAIN", "TARGET_LOST")),
            str(pool.median("duration_s")), percent(pool.wrong())]))
    script = ["$rows << EOD", *lines, "EOD", "unset logscale", "unset xlabel", "set xtics rotate by -40",
              f"set xrange [-0.6:{len(pools) - 0.4}]", "set style fill solid 1.0", "set boxwidth 0.7"]

    def panel(title, label, top, plots):
        script.extend([f"set title '{title}'", f"set ylabel '{label}'", f"set yrange [0:{top}]",
                       f"plot {', '.join(plots)}"])
    panel("range error and its bound", "68 % within (%)", "*",
          ["$rows using 1:3:xtic(2) with boxes notitle", "$rows using 1:4 with points pt 2 lw 2 title 'bound'"])
    panel("bearing error", "68 % within (mrad)", "*", ["$rows using 1:5:xtic(2) with boxes notitle"])
    script.append("set key bottom right")
    bands = [f"{100 * edge} with lines dt 2 lc rgb 'grey40' notitle" for c in COVERAGES for edge in c[1:3]]
    panel("intervals that hold the truth", "%", 100,
          ["$rows using 1:6:xtic(2) with points pt 7 title '68 %'", "$rows using 1:7 with points pt 5 title '95 %'",
           *bands])
    script.append("set key bottom right opaque")
    panel("statuses", "%", 100,
          ["$rows using 1:(100):xtic(2) with boxes title 'other'",
           "$rows using 1:($8+$9+$10) with boxes title 'TARGET_LOST'",
           "$rows using 1:($8+$9) with boxes title 'UNCERTAIN'", "$rows using 1:8 with boxes title 'LOCATED'"])
    script.append("unset key")
    panel("located, but over 20 % wrong", "%", 5, ["$rows using 1:12:xtic(2) with boxes notitle"])
    panel("time of a fixation, the robot turning", "s", "*", ["$rows using 1:11:xtic(2) with boxes notitle"])
    return script


def draw(pools, svg):
    if shutil.which("gnuplot") is None:
        print("no plots: gnuplot is missing (Debian: gnuplot-nox)")
        return
    script = ["set terminal svg size 1200,1100 background 'white' font 'sans,11' noenhanced", f"set output '{svg}'",
              "set multiplot layout 3,3", "set grid", *error_script(pools), *row_script(pools),
              "unset multiplot", ""]
    run = subprocess.run(["gnuplot"], input="\n".join(script), text=True, capture_output=True)
    # It warns of panels that show a single point, and draws them.
    print(f"plots: {svg}" if run.returncode == 0 else f"no plots: gnuplot failed:\n{run.stderr}")

"""The headline figures of each release, one line each in releases.csv: what they are, and that the file is in order."""
import csv
from pathlib import Path

FILE = Path(__file__).with_name("releases.csv")
# Instructions: of a look at 640x480, x86-64, millions (`instructions`). Errors: 68th percentile of the relative range error, percent, of
# LOCATED points in the real rows with 8 looks (real_03, real_10, real_20) and of the robot that nobody calibrated as gazed comes
# (`accuracy`). located: of real_03 and real_10, percent of those that stand out. Sizes: of the bundles, kB.
COLUMNS = ("version", "date", "surround_rgb_million", "report_rgb_million", "robust_rgb_million", "later_view_million",
           "real_03_error_percent", "real_10_error_percent", "real_20_error_percent", "located_03_percent", "located_10_percent",
           "default_03_error_percent", "default_10_error_percent", "bundle_v4_kB", "bundle_v6_kB")


def lines(text):
    """The lines of the file as dictionaries; ValueError where it is not in order. A figure that was not measured is empty."""
    rows = list(csv.reader(text.splitlines()))
    if not rows or tuple(rows[0]) != COLUMNS:
        raise ValueError(f"the first line is not {','.join(COLUMNS)}")
    found = [dict(zip(COLUMNS, row, strict=True)) for row in rows[1:]]
    versions = [tuple(map(int, line["version"].split("."))) for line in found]
    if versions != sorted(set(versions)):
        raise ValueError("a release a line, the oldest first")
    for line in found:
        for column in COLUMNS[2:]:
            if line[column] and not float(line[column]) > 0:
                raise ValueError(f"{line['version']}: {column}: {line[column]} found; allowed: a number above 0, or nothing")
    return found


def with_line(text, line):
    """The text with this line, in place of an older one of the same version."""
    kept = [old for old in lines(text) if old["version"] != line["version"]] + [line]
    kept.sort(key=lambda one: tuple(map(int, one["version"].split("."))))
    return "\n".join([",".join(COLUMNS), *(",".join(one[column] for column in COLUMNS) for one in kept)]) + "\n"

#!/usr/bin/env python3
"""symbols.py BUILD: one name, one thing, as the linker sees it.

Reads the objects of a build that joins and optimises nothing (the preset debug): a function of this project that two
objects define, or an inline one, constructors that nobody wrote among them, that is longer in one object than in another. A
linker takes either for both. Prints each with its objects; exit code 1 when there are some.
"""
import collections
import json
import subprocess
import sys
from pathlib import Path

OURS = ("_ZN5gazed", "_ZNK5gazed")


def objects(build):
    """Of the libraries and programs; each program of the tests is linked with those of its own."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        arguments = entry["command"].split()
        file = arguments[arguments.index("-o") + 1]
        if file.startswith(("agent/", "drivers/")) and file.endswith(".o"):
            yield Path(entry["directory"]) / file


def definitions(files):
    """Yields (object, symbol, is it inline, size)."""
    listed = subprocess.run(["nm", "-P", "-A", "--defined-only", *files], check=True, capture_output=True, text=True).stdout
    for line in listed.splitlines():
        where, symbol, kind, *numbers = line.rsplit(": ", 1)[0:1] + line.rsplit(": ", 1)[1].split()
        if symbol.startswith(OURS) and kind in "TWV" and len(numbers) == 2:
            yield Path(where).name, symbol, kind != "T", int(numbers[1], 16)


def main():
    files = [file for file in objects(Path(sys.argv[1]).resolve()) if file.exists()]
    found = collections.defaultdict(list)
    for where, symbol, is_inline, size in definitions(files):
        found[symbol].append((where, is_inline, size))
    twins = {symbol: places for symbol, places in found.items()
             if len({size for _, _, size in places}) > 1 or sum(not is_inline for _, is_inline, _ in places) > 1}
    names = subprocess.run(["c++filt", *twins], capture_output=True, text=True).stdout.splitlines() if twins else []
    for name, places in zip(names, twins.values()):
        print(f"{name}: " + ", ".join(f"{size} bytes in {where}" for where, _, size in {p[2]: p for p in places}.values()))
    print(f"{len(files)} objects, {len(found)} functions, {len(twins)} of two minds", file=sys.stderr)
    return 1 if twins or not files else 0


sys.exit(main())

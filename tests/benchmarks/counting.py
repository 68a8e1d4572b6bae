"""Instructions of one look, counted by valgrind, for this machine and for the robots' CPUs."""
import csv
import os
import re
import subprocess
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from machine import PROJECT, give_up, program, tool

LOOKS = (("report", "rgb"), ("robust", "rgb"), ("robust", "yuyv"), ("surround", "rgb"))


@dataclass(frozen=True)
class Cpu:
    """One of the robots' CPUs: what builds its code, and how fast it runs."""
    name: str  # of its toolchain file, which has the compiler's options
    compiler: str
    package: str
    llvm: tuple  # options of llvm-mca
    hertz: float


# Atom Z530 in V3 to V5, 32 bit; Atom E3845 in V6 (toolchain/README.md has the sources).
BONNELL = Cpu("bonnell", "i686-linux-gnu-g++", "g++-i686-linux-gnu",
              ("-mtriple=i686-linux-gnu", "-mcpu=bonnell"), 1.6e9)
SILVERMONT = Cpu("silvermont", "x86_64-linux-gnu-g++", "g++",
                 ("-mtriple=x86_64-linux-gnu", "-mcpu=slm"), 1.91e9)


def stage_for(cpu):
    """Builds the saliency stage for `cpu`, into build/stage; the program's path."""
    tool(cpu.compiler, cpu.package)
    toolchain = PROJECT / "toolchain" / "cmake" / f"{cpu.name}.cmake"
    build = PROJECT / "build" / "stage" / cpu.name
    for command in (["cmake", "--fresh", "-G", "Ninja", "-S", PROJECT / "tests/benchmarks/stage", "-B", build,
                     "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_TOOLCHAIN_FILE={toolchain}"],
                    ["cmake", "--build", build]):
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            give_up(f"cannot build for {cpu.name}:\n{run.stdout}{run.stderr}")
    return build / "bin" / "saliency_frames"


def native_stage():
    return program("saliency_frames")


def printed(stage, look):
    """What the stage says of its third look: the winner, and a hash of all bits."""
    run = subprocess.run([stage, *look, "3"], capture_output=True, text=True)
    if run.returncode != 0:
        give_up(f"{stage} failed:\n{run.stderr}")
    return run.stdout.strip()


def executions(stage, look, frames, size):
    """How often each instruction is executed in a run of so many frames, by address."""
    descriptor, name = tempfile.mkstemp(prefix="callgrind.")
    os.close(descriptor)
    profile = Path(name)
    command = [tool("valgrind", "valgrind"), "--tool=callgrind", "--dump-instr=yes",
               "--compress-pos=no", "--compress-strings=no", f"--callgrind-out-file={profile}",
               stage, *look, str(frames), *map(str, size)]
    run = subprocess.run(command, capture_output=True, text=True)
    lines = profile.read_text().splitlines()
    profile.unlink()
    if run.returncode != 0:
        give_up(f"valgrind failed on {stage}:\n{run.stderr}")
    return parse(lines)


def parse(lines):
    """The own cost of each address in a callgrind profile with uncompressed positions.

    A line `0xADDRESS LINE COUNT` holds it; the one after `calls=` is the callee's cost instead.
    """
    counts = Counter()
    callee = False
    for line in lines:
        if line.startswith("0x") and not callee:
            address, _, count = line.split()
            counts[int(address, 16)] += int(count)
        callee = line.startswith("calls=")
    return counts


def instructions_within(function, command):
    """Of all calls of a function, and what the command printed."""
    run = subprocess.run([tool("valgrind", "valgrind"), "--tool=callgrind", f"--toggle-collect={function}",
                          "--callgrind-out-file=/dev/null", *map(str, command)], capture_output=True, text=True)
    collected = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not collected:
        give_up(f"valgrind failed on {command[0]}:\n{run.stderr}")
    return int(collected[1]), run.stdout


def executions_a_frame(stage, look, size=(640, 480)):
    """The same of one frame, width by height, without what it takes to start: the difference of two runs."""
    few, many = 1, 3
    start, end = executions(stage, look, few, size), executions(stage, look, many, size)
    return {address: (count - start[address]) / (many - few)
            for address, count in end.items() if count > start[address]}


def later_view_millions():
    """Of a view after the first: the mean of four robots' eight looks at both tests of the hard scene. A single robot differs from it by a tenth."""
    robots, looks = 4, 8
    count, printed_csv = instructions_within(
        "*Cycle::relook*", [program("gazed_accuracy"), PROJECT / "tests/data/scenes/hard.toml", 0, robots, looks])
    later_views = sum(int(fixation["looks"]) - 1 for fixation in csv.DictReader(printed_csv.splitlines()))
    return count / 1e6 / later_views

"""What the measuring scripts of this folder share."""
import os
import shutil
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]


def give_up(message):
    sys.exit(f"{Path(sys.argv[0]).name}: {message}")


def program(name, preset="native"):
    """The path of a built program."""
    path = PROJECT / "build" / preset / "bin" / name
    if not path.exists():
        give_up(f"{path} is missing: run toolchain/build {preset}")
    return path


def tool(name, debian_package):
    """The path of an installed tool."""
    path = shutil.which(name)
    if path is None:
        give_up(f"{name} is missing: apt-get install {debian_package}")
    return path


def one_core():
    """The last core that this process may use: the first ones serve most interrupts."""
    return str(max(os.sched_getaffinity(0)))


def cpu_model():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown CPU"


def verdict(value, budget):
    return "ok" if value <= budget else "OVER"

"""What the tests in Python here have in common. They end with 0 passed, 1 failed, 77 cannot be run here."""

import os
import pathlib
import subprocess
import sys

SKIPPED = 77


def require(holds, what):
    if not holds:
        print("FAILED: " + what)
        sys.exit(1)


def skip(reason):
    print("skipped: " + reason)
    sys.exit(SKIPPED)


def run(*command, timeout_s):
    """A program to its end: what it prints."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=timeout_s)
    require(done.returncode == 0, f"{command} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def own_url(options=""):
    """LCM's, with a port of this process's own, so that tests do not hear each other."""
    return f"udpm://239.255.76.67:{20000 + os.getpid() % 20000}?ttl=0{options}"


def make_types(lcm_gen, msgs, folder):
    """Makes Python's message types, from then on to be imported."""
    subprocess.run([lcm_gen, "--python", "--ppath", folder, *sorted(pathlib.Path(msgs).glob("*.lcm"))], check=True)
    sys.path.insert(0, str(folder))

#!/usr/bin/env python3
"""gazed against the official library's own server: what it does with a robot's NAOqi, and with one that fails.

naoqi_test.py GAZED [NAME...]: all checks, or those named. Each has a peer and a gazed of its own; four run at a time, since they
mostly wait, but one by one on a machine that is busy with other work: both keep to a robot's pace. Exit: 0 passed, 1 failed, 77 cannot be run here.
"""
import concurrent.futures
import sys
import tempfile
import time
import traceback

try:
    import lcm  # noqa: F401
    import qi  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}; toolchain/test installs it")
    sys.exit(77)

import camera_checks
import fault_checks
import session_checks
from check import Check

CHECKS = camera_checks.CHECKS + session_checks.CHECKS + fault_checks.CHECKS


def at_a_time():
    """By the share of a CPU that this process gets."""
    started, used = time.monotonic(), time.process_time()
    while time.monotonic() - started < 0.5:
        pass
    share = (time.process_time() - used) / (time.monotonic() - started)
    return 4 if share > 0.55 else 1


def run(check, program):
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        try:
            check(Check(program, folder))
            failure = None
        except Exception:  # any failure of one check is told, and the others go on
            failure = traceback.format_exc()
    return check.__name__, failure, time.monotonic() - started


def main():
    program, names = sys.argv[1], sys.argv[2:]
    chosen = [check for check in CHECKS if not names or check.__name__ in names]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(at_a_time()) as pool:
        for done in concurrent.futures.as_completed([pool.submit(run, check, program) for check in chosen]):
            name, failure, seconds = done.result()
            print(f"{'FAILED' if failure else 'passed'}  {name}  {seconds:.1f} s", flush=True)
            if failure:
                failed += 1
                print(failure, flush=True)
    print(f"{len(chosen) - failed} of {len(chosen)} checks passed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Runs gazed on an emulated robot, and watches it from outside: on the serial console, and over LCM as a workstation in its network.

robot_test.py KERNEL IMAGE LCM_GEN MSGS_FOLDER TAP ROBOT_ADDRESS
robot_test.py KERNEL IMAGE                                          without a network: what the console tells

Exit: 0 passed, 1 failed."""

import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

import camera_errors
import checks
from machine import GAZED_ENDED, Failed, Machine
from report import require, say

URL = "udpm://239.255.76.67:7667?ttl=1"
# One thing that stands out: vivid's square on a white ground.
PICTURE = ["Test Pattern=6", "OSD Text Mode=2", "Show Square=1"]
BOOT_S = 300.0  # 7 s on an idle machine of 2020
ANSWER_S = 120.0


def boot(machine):
    started = time.monotonic()
    booted = machine.hear("booted:", BOOT_S)
    require("N270" in booted, f"another CPU: {booted}")
    say(f"booted in {time.monotonic() - started:.1f} s", booted)
    say("bundle", machine.wait_for_line("installed:", BOOT_S))
    machine.hear("ready", ANSWER_S)
    # The head's clock and the camera's are one on a robot. date sets full seconds only.
    time.sleep(1.0 - time.time() % 1.0)
    machine.order(f"clock {time.time():.0f}", ANSWER_S)


def start(machine):
    machine.tell("start")
    say("unit", machine.hear("starting:", ANSWER_S))
    machine.wait_for_line("gazed: nao-v4", ANSWER_S)
    machine.tell("user")
    user = machine.hear("gazed runs as", ANSWER_S)
    require(user == "nao", "gazed runs as " + user)
    say("user", user)


def stop(machine, damaged_min=0):
    machine.tell("stop")
    notes = machine.wait_for_line("gazed: /dev/video0: opened again", ANSWER_S)
    found = re.search(r"(\d+) frames? damaged", notes)
    require(found and int(found[1]) >= damaged_min, f"of the damaged frames gazed says: {notes}")
    say("what was lost", notes)
    code = machine.hear(GAZED_ENDED, ANSWER_S)
    require(code == "0", "after SIGTERM gazed ended with exit code " + code)
    say("SIGTERM", "gazed ended with exit code " + code)
    machine.tell("poweroff")
    machine.wait_until_off(ANSWER_S)
    say("powered off")


def run_without_network(kernel, image):
    """Nobody plays the head: that is what gazed misses as long as its camera gives frames."""
    with Machine(kernel, image, "network=none") as machine:
        boot(machine)
        start(machine)
        fault = machine.wait_for_line(("no head state", "no usable frame"), ANSWER_S)
        require("no usable frame" not in fault, fault)
        say("camera", "gives frames; gazed misses its head alone: " + fault)
        machine.order("unplug", ANSWER_S)
        say("unplugged", machine.wait_for_line("no usable frame", ANSWER_S))
        machine.order("plug", ANSWER_S)
        fault = machine.wait_for_line("no head state", ANSWER_S)
        require("no usable frame" not in fault, fault)
        say("plugged in", fault)
        stop(machine)


def run_with_network(kernel, image, lcm_gen, msgs, tap, robot_address):
    with tempfile.TemporaryDirectory() as folder:
        definitions = sorted(str(path) for path in pathlib.Path(msgs).glob("*.lcm"))
        subprocess.run([lcm_gen, "--python", "--ppath", folder, *definitions], check=True)
        sys.path.insert(0, folder)
        import lcm
        import gazed
        from workstation import Workstation
        workstation = Workstation(lcm, gazed, URL)
    with Machine(kernel, image, f"network={robot_address}", tap, workstation) as machine:
        boot(machine)
        workstation.forget()
        start(machine)
        checks.camera(machine, workstation)
        for setting in PICTURE:
            machine.order("control " + setting, ANSWER_S)
        checks.gaze(machine, workstation)
        camera_errors.survived(machine, workstation)
        checks.resident(workstation)
        stop(machine, damaged_min=1)
        last = workstation.statuses[-1]
        require(last.state == "stopping", f"the last status says {last.state}")
        say("last status", f"stopping, {last.frames} frames, {last.frames_dropped} dropped, {last.fixations} fixations")


def main():
    started = time.monotonic()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that QEMU is ended, too
    try:
        if len(sys.argv) == 3:
            run_without_network(*sys.argv[1:])
        else:
            run_with_network(*sys.argv[1:])
    except Failed as failure:
        say("FAILED", str(failure))
        sys.exit(1)
    say(f"passed in {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()

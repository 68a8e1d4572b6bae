"""What a camera does to gazed: vivid's error injection, a control each, and the node that goes and comes back."""

import time

from checks import MESSAGE_S, NAMES, frames_flow, rates, status_after
from report import require, say

ORDER_S = 120.0
DROPPED_PERCENT = 80
REPEATED_S = 0.2  # a camera that is well again at once is reopened in 0.1 s, and a status comes every second
UNPLUGGED_S = 120.0  # CAMERA_FAULT comes after 2 s without frames


def dropped_buffers(machine, workstation):
    machine.order(f"control Percentage of Dropped Buffers={DROPPED_PERCENT}", ORDER_S)
    taken_hz, dropped_hz, _ = rates(machine, workstation, seconds=3)
    machine.order("control Percentage of Dropped Buffers=0", ORDER_S)
    say(f"{DROPPED_PERCENT} % dropped by the camera", f"{taken_hz:.1f} taken, {dropped_hz:.1f} dropped a second, no fault")
    require(dropped_hz > taken_hz, "what the camera drops is not counted")


def damaged_buffers(machine, workstation, count=5):
    """Two that are asked for within one frame are one; how many they were gazed says at its end."""
    for _ in range(count):
        machine.order("control Inject V4L2_BUF_FLAG_ERROR", ORDER_S)
    frames_flow(machine, workstation)
    faults = [status.fault for status in workstation.statuses[-2:] if status.fault]
    require(not faults, "a fault: " + ", then ".join(faults))
    say("damaged buffers", f"{count} times, no fault")


def broken(machine, workstation, errors, named):
    """The errors again and again until a status tells of it; then frames must come again."""
    seen = len(workstation.statuses)

    def told():
        return next((status.fault for status in workstation.statuses[seen:] if named in status.fault), None)
    end = time.monotonic() + MESSAGE_S
    while not (fault := machine.watch(told, REPEATED_S)):
        require(time.monotonic() < end, f"no status whose fault names {named} in {MESSAGE_S:.0f} s")
        for error in errors:
            machine.order("control " + error, ORDER_S)
    recovered(machine, workstation, errors[0], fault)


def recovered(machine, workstation, error, fault):
    since = time.monotonic()
    frames_flow(machine, workstation)
    say(error, f"'{fault}'; frames again after {time.monotonic() - since:.1f} s")


def disconnected(machine, workstation):
    """The node stays, and is dead, until it is released."""
    machine.order("disconnect", ORDER_S)
    fault = status_after(machine, workstation, "whose fault says that the camera is gone", lambda found: "gone" in found.fault).fault
    machine.order("reconnect", ORDER_S)
    recovered(machine, workstation, "disconnected", fault)


def unplugged(machine, workstation):
    """The node goes away, for longer than gazed is silent about it, and comes back."""
    points = len(workstation.points)
    machine.order("unplug", ORDER_S)
    point = machine.wait("a point with CAMERA_FAULT", lambda: next(
        (point for point in workstation.points[points:] if NAMES[point.status] == "CAMERA_FAULT"), None), UNPLUGGED_S)
    say("unplugged", f"CAMERA_FAULT, '{point.reason}'")
    status = status_after(machine, workstation, "with a fault", lambda found: found.fault)
    require(status.state == "fault" and "no such device" in status.fault, f"another status: {status.state}, {status.fault}")
    machine.order("plug", ORDER_S)
    recovered(machine, workstation, "plugged in", status.fault)


def survived(machine, workstation):
    dropped_buffers(machine, workstation)
    damaged_buffers(machine, workstation)
    unplugged(machine, workstation)
    broken(machine, workstation, ["Inject Fatal Streaming Error"], "VIDIOC_DQBUF")
    for call in ("REQBUFS", "QBUF", "STREAMON"):
        broken(machine, workstation, [f"Inject VIDIOC_{call} Error", "Inject Fatal Streaming Error"], "VIDIOC_" + call)
    disconnected(machine, workstation)

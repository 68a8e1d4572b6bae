#!/usr/bin/env python3
"""Reads what a C++ program publishes with another language's LCM: Python's, from PyPI.

read_with_python.py known|gazed LCM_GEN LCM_LOGGER MSGS_FOLDER -- PROGRAM [ARGUMENTS]

known: PROGRAM is message_publisher, whose values are written down below.
gazed: PROGRAM is gazed; its printed JSON says what the messages must hold.
In both cases lcm-logger must have recorded what was read: nothing else, and all of it in one of three runs, since on a busy machine it loses
some. Exit: 0 passed, 1 failed, 77 cannot be run here.
"""

import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

from checks import make_types, own_url, require, skip

PATIENCE_S = 60.0
RECORDER_PATIENCE_S = 10.0  # what lcm-logger lost never comes
RUNS = 3
PREFIX = "GAZED"
UTIME = 1_700_000_000_123_456

NAMES = ["LOCATED", "NO_SALIENT_OBJECT", "TARGET_LOST", "DEGENERATE", "BEHIND_CAMERA", "UNCERTAIN", "HEAD_FAULT",
         "CAMERA_FAULT"]

KNOWN = {
    "GAZED_LOCATED_POINT": {
        "utime": UTIME, "fixation": 7, "status": 5, "reason": "relative range sigma 0.31 over the gate 0.15",
        "views": 2, "position_m": [0.5, 1.5, 2.5],
        "covariance_m2": [[0.0, 1.0, 2.0], [10.0, 11.0, 12.0], [20.0, 21.0, 22.0]],
        "camera_position_m": [0.25, 1.25, 2.25], "range_m": math.nan, "range_sigma_m": 0.02,
        "inverse_range_per_m": 3.3, "inverse_range_sigma_per_m": 0.4, "parallax_rad": 0.02, "residual_px": 0.25,
        "pixel_1": [331.5, 332.5], "pixel_2": [253.25, 254.25], "head_1_rad": [-0.5, 0.5],
        "head_2_rad": [-0.25, 0.75], "saliency": 0.5, "distinctness": 6.25},
    "GAZED_FIXATION": {
        "utime": UTIME, "fixation": 7, "status": 5, "status_name": "UNCERTAIN", "method": "all_looks", "nlooks": 1,
        "looks": [{
            "utime": UTIME, "measured_rad": [0.5, 0.0], "refined_rad": [0.25, 0.0], "torso_rad": [0.0] * 3, "torso_m": [0.0] * 3,
            "pixel": [0.0, 0.0], "pixel_covariance_px2": [[0.0, 0.0], [0.0, 0.0]], "epipole": [math.nan, math.nan], "chi2": 1.5,
            "used": True, "reason": "", "noutline": 1, "outline_px": [[1.5, 2.5]], "ncorners": 2,
            "corner_px": [[3.5, 4.5], [5.5, 6.5]], "corner_used": bytes([1, 0])}],
        "report_position_m": [0.0, 0.0, -0.25], "robot_name": "nao-v6", "robot": [0.5 * i for i in range(13)],
        "robot_sigma": [math.nan] * 13, "features_used": 44, "features_rejected": 3},
    "GAZED_SALIENCY": {
        "utime": UTIME, "width": 3, "height": 2, "size": 6, "map": bytes([0, 1, 2, 3, 128, 255]),
        "peak_px": [32.0, 16.0], "saliency": 0.75, "distinctness": 3.5},
    "GAZED_STATUS": {
        "utime": UTIME, "state": "looking", "frames": 100, "frames_dropped": 3, "fixations": 8, "located": 5,
        "saliency_ms": 1.5, "locate_ms": 12.0, "cpu_percent": 7.5, "resident_mb": 12.25, "camera": "sim 640x480",
        "head": "sim", "fault": ""},
    "GAZED_IMAGE": {
        "utime": UTIME, "width": 320, "height": 240, "row_stride": 960, "pixelformat": 859981650,
        "size": 320 * 240 * 3, "data": bytes(i % 251 for i in range(320 * 240 * 3)), "nmetadata": 0, "metadata": []},
}


def same(a, b):
    """Equal, a NaN being equal to a NaN, tuples to lists, a message to its fields."""
    if isinstance(b, dict):
        return set(a.__slots__) == set(b) and all(same(getattr(a, field), value) for field, value in b.items())
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, float) and isinstance(b, float) and math.isnan(a):
        return math.isnan(b)
    return a == b


def check_fields(channel, message, expected):
    require(set(message.__slots__) == set(expected), f"{channel} has the fields {sorted(message.__slots__)}")
    for field, value in expected.items():
        found = getattr(message, field)
        require(same(found, value), f"{channel}.{field} is {found!r}, not {value!r}"[:400])


class Recorder:
    """lcm-logger; `ready` once it has recorded a probe of ours."""

    def __init__(self, program, url, path):
        self.path = path
        self.process = subprocess.Popen([program, "--lcm-url=" + url, "--flush-interval=10", path],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def wait_until_ready(self, connection):
        end = time.monotonic() + PATIENCE_S
        while not (os.path.exists(self.path) and os.path.getsize(self.path) > 0):
            require(time.monotonic() < end and self.process.poll() is None, "lcm-logger records nothing")
            connection.publish("PROBE", b"probe")
            time.sleep(0.02)

    def messages(self, lcm):
        """Those recorded so far, by channel."""
        messages = {}
        for event in lcm.EventLog(self.path, "r"):
            messages.setdefault(event.channel, []).append(event.data)
        return messages

    def finish(self, lcm, connection, expected):
        """The messages recorded, once they are as many as expected or it is too late."""
        end = time.monotonic() + RECORDER_PATIENCE_S
        while time.monotonic() < end:
            connection.publish("PROBE", b"probe")  # only a message makes it write down the one before
            recorded = self.messages(lcm)
            if all(len(recorded.get(channel, [])) >= len(messages) for channel, messages in expected.items()):
                break
            time.sleep(0.1)
        self.process.send_signal(signal.SIGTERM)
        self.process.wait()
        return self.messages(lcm)


def is_part_of(some, all_of_them):
    """Whether these are some of those, in their order."""
    rest = iter(all_of_them)
    return all(any(one == other for other in rest) for one in some)


def run_and_read(lcm, logger, command, types, url, folder, complete):
    """Runs the program: its output, and the messages' bytes by channel as read here, until they are complete, and as recorded."""
    connection = lcm.LCM(url)
    received = {channel: [] for channel in types}
    for channel in types:
        subscription = connection.subscribe(channel, lambda name, data: received[name].append(data))
        subscription.set_queue_capacity(1000)
    recorder = Recorder(logger, url, os.path.join(folder, "recorded.lcm"))
    try:
        recorder.wait_until_ready(connection)
        end = time.monotonic() + PATIENCE_S
        with open(os.path.join(folder, "out"), "w+") as out:
            program = subprocess.Popen(command, stdout=out)
            while program.poll() is None:
                if time.monotonic() > end:
                    program.kill()
                    program.wait()
                    require(False, f"{command[0]} did not end in {PATIENCE_S} s")
                connection.handle_timeout(50)
            while not complete(received) and time.monotonic() < end:
                connection.handle_timeout(50)
            require(program.returncode == 0, f"{command} ended with {program.returncode}")
            out.seek(0)
            return out.read(), received, recorder.finish(lcm, connection, received)
    finally:
        if recorder.process.poll() is None:
            recorder.process.kill()
            recorder.process.wait()


def check_known(types, received):
    for channel, expected in KNOWN.items():
        require(received[channel], f"nothing came on {channel}")
        for data in received[channel]:
            check_fields(channel, types[channel].decode(data), expected)


def expected_point(printed):
    """The message that belongs to a line of gazed --print json: null is NaN, status is a name."""
    def number(value):
        return [number(item) for item in value] if isinstance(value, list) else math.nan if value is None else value
    expected = {field: number(value) for field, value in printed.items()}
    expected["status"] = NAMES.index(printed["status"])
    return expected


def check_gazed(types, received, out):
    printed = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    points = [types["GAZED_LOCATED_POINT"].decode(data) for data in received["GAZED_LOCATED_POINT"]]
    require(len(points) == len(printed) > 0, f"{len(points)} points came, {len(printed)} were printed")
    for point, line in zip(points, printed):
        check_fields("GAZED_LOCATED_POINT", point, expected_point(line))
    fixations = [types["GAZED_FIXATION"].decode(data) for data in received["GAZED_FIXATION"]]
    require(len(fixations) == len(points), f"{len(fixations)} fixations came, {len(points)} points")
    for fixation, point in zip(fixations, points):
        require(fixation.utime == point.utime and fixation.status_name == NAMES[point.status], "a fixation of another point")
        require(len(fixation.looks) >= point.views, f"{len(fixation.looks)} looks of {point.views} views")
    require(received["GAZED_STATUS"] and received["GAZED_SALIENCY"], "no status or no saliency map came")
    for data in received["GAZED_SALIENCY"]:
        saliency = types["GAZED_SALIENCY"].decode(data)
        require(len(saliency.map) == saliency.size == saliency.width * saliency.height, "a map of another size")
        require(max(saliency.map) in (0, 255), "a map whose maximum is not 255")
    last = types["GAZED_STATUS"].decode(received["GAZED_STATUS"][-1])
    require(last.fixations == len(points) and last.state == "stopping", f"the last status: {last.state}")
    located = sum(point.status == 0 for point in points)
    require(last.located == located, f"{last.located} located in the status, {located} in the points")
    require(last.fault == "", f"a fault: {last.fault}")


def main():
    separator = sys.argv.index("--")
    mode, lcm_gen, logger, msgs = sys.argv[1:separator]
    command = sys.argv[separator + 1:]
    try:
        import lcm
    except ImportError:
        skip("this Python has no lcm; toolchain/test installs it into build/python")
    if not os.path.exists(logger):
        skip("lcm-logger is not installed (Debian: liblcm-bin)")

    url = own_url("&recv_buf_size=1000000")
    try:
        lcm.LCM(url)
    except RuntimeError:
        skip("no route for multicast; as root: ip link set lo up && ip route add 224.0.0.0/4 dev lo")

    with tempfile.TemporaryDirectory() as folder:
        make_types(lcm_gen, msgs, folder)
        import bot_core
        import gazed
        types = {PREFIX + "_LOCATED_POINT": gazed.located_point_t, PREFIX + "_FIXATION": gazed.fixation_t,
                 PREFIX + "_SALIENCY": gazed.saliency_map_t,
                 PREFIX + "_STATUS": gazed.status_t, PREFIX + "_IMAGE": bot_core.image_t}
        if mode == "known":
            command += [url]
        else:
            # At a robot's pace: a busy machine's lcm-logger loses some of what comes twenty times as fast.
            command += ["--fixations", "2", "--print", "json", "--set", "sim.pace=real", "--lcm-url", url]

        def complete(received):
            if mode == "known":
                return all(received[channel] for channel in KNOWN)
            statuses = received["GAZED_STATUS"]
            return statuses and types["GAZED_STATUS"].decode(statuses[-1]).state == "stopping"
        for number in range(RUNS):
            run_folder = os.path.join(folder, str(number))
            os.mkdir(run_folder)
            out, received, recorded = run_and_read(lcm, logger, command, types, url, run_folder, complete)
            if mode == "known":
                check_known(types, received)
            else:
                check_gazed(types, received, out)
            # known repeats its messages: each must have been recorded once at least.
            part = (lambda some, whole: set(some) <= set(whole)) if mode == "known" else is_part_of
            for channel, messages in received.items():
                logged = recorded.get(channel, [])  # a busy machine's Python may have lost some, too
                require(part(logged, messages) or part(messages, logged), f"lcm-logger recorded {channel} otherwise")
            if all(part(messages, recorded.get(channel, [])) for channel, messages in received.items()):
                break
        else:
            require(False, f"lcm-logger lost messages in each of {RUNS} runs")
    print("passed")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""examples_test.py WHAT LCM_GEN MSGS_FOLDER GAZED MESSAGE_PUBLISHER -- COMMAND...: a program of msgs/examples as a user runs it.

listen       prints the point that message_publisher sends
play         gazed turns its head and locates the disc on its wall
mcap, rerun  what they write, read by these programs' own libraries
COMMAND is the example, a script of Python's or a program. Exit: 0 passed, 1 failed, 77 cannot be run here.
"""

import base64
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import checks
from checks import make_types, own_url, require, skip

PATIENCE_S = 120.0
# message_publisher's: tests/integration/message_publisher.cpp. Python, Java and C write NaN otherwise.
SENT = "uncertain: nan m away +- 0.020 m, at x 0.500, y 1.500, z 2.500 m; relative range sigma 0.31 over the gate 0.15"
WALL_X_M = 0.6  # msgs/examples
MJPG = 1196444237  # FourCC
LEAST_STEP_RAD = 0.09  # the step rule's 0.1, less what a head may miss of it
TRIALS = 10  # the example plays in real time: on a busy machine its pictures may come too late
SETTLED_WITHIN_S = 30  # its head moves between its pictures, and these take long to paint where it is instrumented


class Example:
    """The example, while a test goes on; its output goes to a file."""

    def __init__(self, command, folder):
        self.out = folder / "out"
        with open(self.out, "w") as out:
            self.process = subprocess.Popen([str(part) for part in command], stdout=out, stderr=subprocess.STDOUT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def until(self, holds, what, meanwhile=lambda: time.sleep(0.2)):
        end = time.monotonic() + PATIENCE_S
        while not holds():
            require(self.process.poll() is None, f"the example ended before: {what}\n{self.out.read_text()}")
            require(time.monotonic() < end, f"not within {PATIENCE_S} s: {what}\n{self.out.read_text()}")
            meanwhile()


def run(*command):
    return checks.run(*command, timeout_s=2 * PATIENCE_S)


def publish(publisher):
    run(publisher, os.environ["LCM_DEFAULT_URL"])


def test_listen(command, folder, publisher, **_):
    with Example(command, folder) as example:
        example.until(lambda: SENT in example.out.read_text().lower(), "it prints the point", lambda: publish(publisher))


def test_play(command, folder, gazed, **_):
    seen = []
    for _ in range(TRIALS):
        with Example(command, folder) as example:
            printed = run(gazed, "--camera", "lcm", "--head", "lcm", "--robot", "nao-v3", "--print", "json", "--fixations", "1",
                          "--set", f"head.settle_timeout_s={SETTLED_WITHIN_S}")
            require(example.process.poll() is None, f"the example has ended: {example.out.read_text()}")
        points = [json.loads(line) for line in printed.splitlines()]
        seen += [(point["status"], point["reason"]) for point in points]
        if points[-1]["status"] == "LOCATED":
            break
    require(points[-1]["status"] == "LOCATED", f"gazed located nothing in {TRIALS} runs: {seen}")
    point = points[-1]
    sigma_m = math.sqrt(point["covariance_m2"][0][0])
    sigmas = abs(point["position_m"][0] - WALL_X_M) / sigma_m
    require(sigmas < 3.0, f"the disc is at x {point['position_m'][0]} m, not {WALL_X_M}: {sigmas} sigmas of {sigma_m} m")
    turn_rad = max(abs(a - b) for a, b in zip(point["head_1_rad"], point["head_2_rad"]))
    require(turn_rad > LEAST_STEP_RAD, f"the head turned by {turn_rad} rad")


def recording(gazed, folder):
    log = folder / "walk.lcm"
    run(gazed, "--fixations", "1", "--record", log, "--print", "none", "--lcm-url", "memq://")
    return log


def test_mcap(command, folder, gazed, **_):
    import lcm
    from mcap.reader import make_reader
    import bot_core
    import gazed as types
    log, target = recording(gazed, folder), folder / "walk.mcap"
    run(*command, log, target)
    sent = [event for event in lcm.EventLog(str(log), "r") if event.channel != "GAZED_CONFIGURATION"]
    with open(target, "rb") as file:
        read = list(make_reader(file).iter_messages())
    require(len(read) == len(sent) > 50, f"{len(read)} messages in MCAP, {len(sent)} in the log")
    sent.sort(key=lambda event: event.timestamp)
    require({channel.topic for _, channel, _ in read} == {event.channel for event in sent}, "the channels differ")
    pictures = 0
    for schema, channel, message in read:
        require(schema.encoding == "jsonschema" and channel.message_encoding == "json", f"{channel.topic} is {schema.encoding}")
        json.loads(schema.data)
        content = json.loads(message.data)
        event = next(event for event in sent if event.timestamp * 1000 == message.log_time and event.channel == channel.topic)
        if channel.topic == "GAZED_IMAGE":
            image = bot_core.image_t.decode(event.data)
            require(schema.name == "foxglove.RawImage" and base64.b64decode(content["data"]) == image.data, "an image differs")
            require((content["encoding"], content["step"]) == ("rgb8", image.row_stride), f"an image is {content['encoding']}")
            pictures += 1
        elif channel.topic == "GAZED_FIXATION":
            fixation = types.fixation_t.decode(event.data)
            require((content["status_name"], content["nlooks"], len(content["looks"])) == (fixation.status_name, fixation.nlooks, fixation.nlooks), "a fixation differs")
            require(content["looks"][0]["epipole"] == [None, None], "NaN is no null")
    require(pictures > 0, "no picture")
    test_mcap_jpeg(command, folder)


def jpeg_message(bot_core):
    from PIL import Image
    encoded = io.BytesIO()
    Image.new("RGB", (320, 240), (200, 30, 30)).save(encoded, "JPEG")
    image = bot_core.image_t()
    image.utime, image.width, image.height, image.pixelformat, image.data = 1_700_000_000_123_456, 320, 240, MJPG, encoded.getvalue()
    image.size = len(image.data)
    return image


def test_mcap_jpeg(command, folder):
    import lcm
    from mcap.reader import make_reader
    import bot_core
    image, log, target = jpeg_message(bot_core), folder / "jpeg.lcm", folder / "jpeg.mcap"
    lcm.EventLog(str(log), "w", overwrite=True).write_event(image.utime, "GAZED_IMAGE", image.encode())
    run(*command, log, target)
    with open(target, "rb") as file:
        (schema, _, message), = make_reader(file).iter_messages()
    content = json.loads(message.data)
    require(schema.name == "foxglove.CompressedImage" and content["format"] == "jpeg", f"a JPEG became {schema.name}")
    require(base64.b64decode(content["data"]) == image.data, "a JPEG differs")
    require(content["timestamp"] == {"sec": 1_700_000_000, "nsec": 123_456_000}, f"its time became {content['timestamp']}")


def test_rerun_image(examples):
    """Each format, with padded rows where it may have them; one that nobody knows."""
    sys.path.insert(0, str(examples))
    from bot_core import image_t
    from rerun_image import rerun_image
    formats = [(image_t.PIXEL_FORMAT_RGB3, 3, 8, True), (image_t.PIXEL_FORMAT_GREY, 1, 0, True), (image_t.PIXEL_FORMAT_YUYV, 2, 0, True), (7, 1, 0, False)]
    for four_cc, pixel_bytes, padding, is_known in formats:
        image = image_t()
        image.width, image.height, image.row_stride, image.pixelformat = 32, 24, 32 * pixel_bytes + padding, four_cc
        image.data = bytes(image.height * image.row_stride)
        require((rerun_image(image) is not None) == is_known, f"format {four_cc}: {rerun_image(image)}")


def test_rerun(command, folder, gazed, publisher, **_):
    test_rerun_image(pathlib.Path(command[-1]).parent)
    target = folder / "gazed.rrd"
    with Example([*command, target], folder) as example:
        # Until it hears: a recording grows with what comes.
        example.until(lambda: target.exists() and target.stat().st_size > 100_000, "it writes the picture of message_publisher", lambda: publish(publisher))
        import bot_core
        import lcm
        lcm.LCM().publish("GAZED_IMAGE", jpeg_message(bot_core).encode())
        run(gazed, "--fixations", "2", "--print", "none", "--set", "publish.images=true")
        size = target.stat().st_size
        example.until(lambda: target.stat().st_size == size, "it is at rest")
        example.process.terminate()
        example.process.wait()
    listed = run(pathlib.Path(sys.executable).parent / "rerun", "rrd", "print", "-vvv", target)
    for what in ("/image", "/saliency", "/torso/point", "/answer", "Ellipsoids3D:half_sizes", "EncodedImage:blob", "TextLog:text"):
        require(what in listed, f"{what} is not in the recording:\n{listed[:3000]}")


def main():
    what, lcm_gen, msgs, gazed, publisher, separator, *command = sys.argv[1:]
    require(separator == "--", "no command")
    needs = {"mcap": "mcap", "rerun": "rerun"}.get(what, "numpy")
    try:
        __import__("lcm")
        __import__(needs)
    except ImportError as error:
        skip(f"{error}; toolchain/test installs it into build/python")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        make_types(lcm_gen, msgs, folder / "types")
        os.environ["PYTHONPATH"] = str(folder / "types")
        os.environ["LCM_DEFAULT_URL"] = own_url()
        if command[0].endswith(".py"):
            command.insert(0, sys.executable)
        globals()["test_" + what](command, folder, gazed=gazed, publisher=publisher)
    print("passed")


if __name__ == "__main__":
    main()

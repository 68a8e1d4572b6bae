#!/usr/bin/env python3
"""log_to_mcap.py WALK.lcm WALK.mcap: an LCM log of gazed's messages as MCAP with JSON, which Foxglove opens, images too."""
import base64
import json
import math
import sys

import bot_core
import gazed
import lcm
from mcap.writer import Writer

KINDS = {kind._get_packed_fingerprint(): kind for package in (gazed, bot_core) for kind in vars(package).values() if isinstance(kind, type)}
ENCODINGS = {bot_core.image_t.PIXEL_FORMAT_RGB3: "rgb8", bot_core.image_t.PIXEL_FORMAT_GREY: "mono8", bot_core.image_t.PIXEL_FORMAT_YUYV: "yuyv"}


def plain(value):  # as JSON has it: null for NaN, base64 for bytes
    if isinstance(value, bot_core.image_t):
        known = {"timestamp": dict(zip(("sec", "nsec"), divmod(1000 * value.utime, 10**9))), "frame_id": "camera", "data": plain(value.data)}
        raw = {"width": value.width, "height": value.height, "encoding": ENCODINGS.get(value.pixelformat), "step": value.row_stride}
        return known | (raw if raw["encoding"] else {"format": "jpeg"})
    if hasattr(value, "__slots__"):
        return {field: plain(getattr(value, field)) for field in value.__slots__}
    if isinstance(value, (bytes, list, tuple)):
        return base64.b64encode(value).decode() if isinstance(value, bytes) else [plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


with open(sys.argv[2], "wb") as file:
    writer, channels = Writer(file), {}
    writer.start()
    for event in filter(lambda event: event.data[:8] in KINDS, lcm.EventLog(sys.argv[1], "r")):
        message, time_ns = plain((kind := KINDS[event.data[:8]]).decode(event.data)), 1000 * event.timestamp
        if event.channel not in channels:
            name = "foxglove.RawImage" if "step" in message else "foxglove.CompressedImage" if "format" in message else kind.__name__
            schema = writer.register_schema(name, "jsonschema", json.dumps({"type": "object", "properties": dict.fromkeys(message, {})}).encode())
            channels[event.channel] = writer.register_channel(event.channel, "json", schema)
        writer.add_message(channels[event.channel], time_ns, json.dumps(message).encode(), time_ns)
    writer.finish()

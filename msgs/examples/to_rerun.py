#!/usr/bin/env python3
"""to_rerun.py [FILE.rrd]: what gazed publishes, live in the Rerun viewer, or into a file that the viewer opens."""
import sys

import lcm
import numpy as np
import rerun
from bot_core import image_t
from gazed import located_point_t, saliency_map_t
from rerun_image import rerun_image


def show_image(image):
    if shown := rerun_image(image):
        rerun.log("image", shown)


def show_map(saliency):
    rerun.log("saliency", rerun.Image(np.ndarray((saliency.height, saliency.width), np.uint8, saliency.map)))


def show_point(point):
    rerun.log("answer", rerun.TextLog(point.reason or f"located, {point.range_m:.3f} m away"))
    if np.isfinite(point.position_m).all():
        squares, axes = np.linalg.eigh(np.multiply(3.53, point.covariance_m2))  # 68 %: chi-square of three degrees of freedom
        rerun.log("torso/point", rerun.Transform3D(translation=point.position_m, mat3x3=axes), rerun.Ellipsoids3D(half_sizes=[squares.clip(0.0) ** 0.5]))


def at(message):
    return rerun.set_time("utime", timestamp=1e-6 * message.utime) or message


rerun.init("gazed")
rerun.save(sys.argv[1]) if sys.argv[1:] else rerun.spawn()
link = lcm.LCM()
for name, kind, show in ("IMAGE", image_t, show_image), ("SALIENCY", saliency_map_t, show_map), ("LOCATED_POINT", located_point_t, show_point):
    link.subscribe("GAZED_" + name, lambda _, data, kind=kind, show=show: show(at(kind.decode(data))))
while True:
    link.handle()

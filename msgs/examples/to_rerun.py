#!/usr/bin/env python3
"""to_rerun.py [FILE.rrd]: what gazed publishes, live in the Rerun viewer, or into a file that the viewer opens."""
import sys

import lcm
import numpy as np
import rerun
from bot_core import image_t
from gazed import located_point_t, saliency_map_t


def show_image(image):
    if image.pixelformat == image_t.PIXEL_FORMAT_RGB3:
        rerun.log("image", rerun.Image(np.ndarray((image.height, image.width, 3), np.uint8, image.data, strides=(image.row_stride, 3, 1))))


def show_map(saliency):
    rerun.log("saliency", rerun.Image(np.frombuffer(saliency.map, np.uint8).reshape(saliency.height, saliency.width)))


def show_point(point):
    rerun.log("answer", rerun.TextLog(point.reason or f"located, {point.range_m:.3f} m away"))
    if np.isfinite(point.position_m).all():
        squares, axes = np.linalg.eigh(np.multiply(3.53, point.covariance_m2))  # 68 %: chi-square of three degrees of freedom
        rerun.log("torso/point", rerun.Transform3D(translation=point.position_m, mat3x3=axes), rerun.Ellipsoids3D(half_sizes=[squares.clip(0.0) ** 0.5]))


def shown(kind, how):
    return lambda _, data: (rerun.set_time("utime", timestamp=1e-6 * kind.decode(data).utime), how(kind.decode(data)))


rerun.init("gazed")
rerun.save(sys.argv[1]) if sys.argv[1:] else rerun.spawn()
link = lcm.LCM()
link.subscribe("GAZED_IMAGE", shown(image_t, show_image))
link.subscribe("GAZED_SALIENCY", shown(saliency_map_t, show_map))
link.subscribe("GAZED_LOCATED_POINT", shown(located_point_t, show_point))
while True:
    link.handle()

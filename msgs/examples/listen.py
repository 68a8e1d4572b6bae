#!/usr/bin/env python3
"""Prints what each gazed locates that is heard: a robot's channels begin with its own prefix."""
import lcm
from gazed import located_point_t

NAMES = {value: name for name, value in vars(located_point_t).items() if name.isupper()}  # the constants of the type


def show(channel, data):
    point = located_point_t.decode(data)
    x, y, z = point.position_m
    print(f"{channel}: {NAMES.get(point.status, 'a later status')}: {point.range_m:.3f} m away +- {point.range_sigma_m:.3f} m, at x {x:.3f}, y {y:.3f}, z {z:.3f} m; "
          f"{point.reason}", flush=True)


link = lcm.LCM()
link.subscribe(".*_LOCATED_POINT", show)
while True:
    link.handle()

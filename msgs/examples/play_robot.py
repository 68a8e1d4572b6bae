#!/usr/bin/env python3
"""Plays the camera and the head of a nao-v3 that stands 0.6 m before a wall with a red disc on it."""
import time

import lcm
import numpy as np
from bot_core import image_t
from gazed import head_command_t, head_state_t

v, u = np.mgrid[0:480, 0:640].astype(np.float32)
RAYS = np.stack([np.ones_like(u), (331.0 - u) / 752.0, (253.0 - v) / 752.0])  # of the camera's pixels: forward, left, up


def picture(yaw, pitch):
    cy, sy, cp, sp = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    turn = np.array([[cy * cp, -sy, cy * sp], [sy * cp, cy, sy * sp], [-sp, 0.0, cp]])  # Rz(yaw) Ry(pitch)
    eye, (x, y, z) = [0.0, 0.0, 0.1265] + turn @ [0.0539, 0.0, 0.0679], np.tensordot(turn.astype(np.float32), RAYS, 1)
    y, z = eye[1] + (0.6 - eye[0]) / x * y, eye[2] + (0.6 - eye[0]) / x * z  # where each ray meets the wall, metres
    disc, wall = np.clip(0.5 + (0.03 - np.hypot(y, z - 0.2)) / 8e-4, 0.0, 1.0), 150 + 20 * np.sin(70 * y) * np.sin(70 * z)
    return np.stack([wall + disc * (colour - wall) for colour in (200, 30, 30)], -1).astype(np.uint8).tobytes()


def obey(_channel, data):
    goal[:] = (command := head_command_t.decode(data)).yaw_rad, command.pitch_rad


link, head, image, goal, at = lcm.LCM(), head_state_t(), image_t(), np.zeros(2), np.zeros(2)  # yaw, pitch
head.yaw_velocity_rad_s = head.pitch_velocity_rad_s = head.temperature_c = np.nan  # not measured
image.width, image.height, image.row_stride, image.size, image.pixelformat = 640, 480, 1920, 1920 * 480, image_t.PIXEL_FORMAT_RGB3
link.subscribe("GAZED_HEAD_COMMAND", obey)
while True:
    link.handle_timeout(10)
    now = int(time.time() * 1e6)
    at += np.clip(goal - at, 2e-6 * (head.utime - now), 2e-6 * (now - head.utime))  # at 2 rad/s
    head.utime, head.yaw_rad, head.pitch_rad = now, *at
    link.publish("GAZED_HEAD_STATE", head.encode())
    if now >= image.utime + 200_000:  # five frames a second
        image.utime, image.data = now, picture(*at)
        link.publish("GAZED_IMAGE", image.encode())

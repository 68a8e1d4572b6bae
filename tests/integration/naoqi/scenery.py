"""What the peer's camera sees: a red square before a far, patchy background, as 640x480 pixels of YUYV."""
import random

WIDTH, HEIGHT = 640, 480
FOCAL_PX = 608.0  # profile nao-v6
ARM_M = 0.0587  # from the joint axes forward to the top camera (agent/geometry/README.md)
RANGE_M = 0.3  # of the square from the camera that looks straight ahead
SIDE_PX, PATCH_PX = 64, 16
AROUND_PX = 480  # as far as the head turns in a test


class Scenery:
    def __init__(self):
        chance = random.Random(7)
        self.columns, rows = WIDTH + 2 * AROUND_PX, HEIGHT + 2 * AROUND_PX
        grey = [bytes([level, 128, level, 128]) * (PATCH_PX // 2) for level in range(90, 130)]
        patchy = [b"".join(chance.choices(grey, k=self.columns // PATCH_PX)) for _ in range(rows // PATCH_PX)]
        self.background = [patchy[row // PATCH_PX] for row in range(rows)]
        # Its rows differ, so that a patch of it can be registered.
        levels = [chance.choice([60, 80, 100]) for _ in range(SIDE_PX // 8)]
        self.square = [bytes([level, 90, level + 20, 230]) * (SIDE_PX // 2) for level in levels for _ in range(8)]

    def image(self, yaw_rad, pitch_rad):
        """Angles are small: tangents are angles. What is near moves more, since the camera goes with the head."""
        left = AROUND_PX - 2 * round(FOCAL_PX * yaw_rad / 2)
        top = AROUND_PX + round(FOCAL_PX * pitch_rad)
        pixels = bytearray().join(row[2 * left:2 * (left + WIDTH)] for row in self.background[top:top + HEIGHT])
        nearer = FOCAL_PX * (1.0 + ARM_M / RANGE_M)
        x = (WIDTH - SIDE_PX) // 2 + 2 * round(nearer * yaw_rad / 2)
        y = (HEIGHT - SIDE_PX) // 2 - round(nearer * pitch_rad)
        for row, colours in enumerate(self.square, start=y):
            if 0 <= row < HEIGHT and 0 <= x <= WIDTH - SIDE_PX:
                pixels[2 * (row * WIDTH + x):2 * (row * WIDTH + x) + len(colours)] = colours
        return bytes(pixels)

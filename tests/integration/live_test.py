#!/usr/bin/env python3
"""live_test.py GAZELAB: gazelab saliency --video in its window, on an X server of this test's own: the heat is where the disc is.

Exit: 0 passed, 1 failed, 77 cannot be run here.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from checks import require, skip

PATIENCE_S = 120.0
WIDTH, HEIGHT, FRAMES = 640, 480, 100
DISC_PX, RADIUS_PX = (480, 200), 40


def write_video(path, numpy):
    """A red disc on grey, as YUV4MPEG2, which ffmpeg reads."""
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    inside = numpy.hypot(x - DISC_PX[0], y - DISC_PX[1]) < RADIUS_PX
    planes = [numpy.where(inside, disc, ground).astype(numpy.uint8).tobytes() for disc, ground in ((76, 150), (90, 128), (230, 128))]
    with open(path, "wb") as file:
        file.write(b"YUV4MPEG2 W%d H%d F20:1 Ip A1:1 C444\n" % (WIDTH, HEIGHT))
        for _ in range(FRAMES):
            file.write(b"FRAME\n" + b"".join(planes))


def hot_place(screen, numpy):
    """The middle of what is painted hot (inferno's orange and yellow), and how many pixels are."""
    pixels = numpy.asarray(screen.convert("RGB")).astype(int)
    hot = (pixels[..., 0] > 180) & (pixels[..., 1] > 90) & (pixels[..., 2] < pixels[..., 1] - 40)
    rows, columns = numpy.nonzero(hot)
    return (columns.mean(), rows.mean(), len(rows)) if len(rows) else (0.0, 0.0, 0)


def main():
    try:
        import numpy
        from PIL import ImageGrab
    except ImportError as error:
        skip(f"{error}; toolchain/test installs it into build/python")
    if shutil.which("Xvfb") is None:
        skip("the Debian package xvfb is not installed")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        write_video(folder / "disc.y4m", numpy)
        # A number of this process's own: servers that look for a free one by -displayfd take each other's socket away.
        number = 1000 + os.getpid() % 50000
        display, socket = f":{number}", pathlib.Path(f"/tmp/.X11-unix/X{number}")
        server = subprocess.Popen(["Xvfb", display, "-noreset", "-screen", "0", "1024x768x24"], stderr=subprocess.DEVNULL)
        try:
            end = time.monotonic() + PATIENCE_S
            while not socket.exists():
                require(server.poll() is None and time.monotonic() < end, "Xvfb does not start")
                time.sleep(0.1)
            watcher = subprocess.Popen([sys.argv[1], "saliency", "--video", folder / "disc.y4m"], env={**os.environ, "DISPLAY": display},
                                       stderr=subprocess.PIPE, text=True)
            most, place, end = 0, None, time.monotonic() + PATIENCE_S
            while watcher.poll() is None and time.monotonic() < end:
                x, y, count = hot_place(ImageGrab.grab(xdisplay=display), numpy)
                if count > most:
                    most, place = count, (x, y)
                time.sleep(0.1)
            said = watcher.communicate(timeout=PATIENCE_S)[1]
            require(watcher.returncode == 0, f"it ended with {watcher.returncode}: {said}")
            require(f"{FRAMES} frames, " in said, f"it says {said}")
            require(most > 500, f"{most} pixels were hot")
            # The window is at the screen's corner, without a window manager's frame.
            require(abs(place[0] - DISC_PX[0]) < RADIUS_PX and abs(place[1] - DISC_PX[1]) < RADIUS_PX, f"the heat is at {place}, the disc at {DISC_PX}")
        finally:
            server.terminate()
            server.wait()
    print("passed")


if __name__ == "__main__":
    main()

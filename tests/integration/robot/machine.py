"""The emulated robot as a process: QEMU, with the robot's serial console as its input and output."""

import collections
import os
import selectors
import subprocess
import time

from report import Failed, require, say

SHOWN_LINES = 40
# As toolchain/emulated/init begins its lines, and one of them.
OWN = "robot: "
GAZED_ENDED = "gazed ended with exit code"


class Machine:
    """A NAO V4's CPU, an Atom of the Bonnell family with one core of two threads, its 1 GB, and on request a network card.

    Whatever else happens at the same time (LCM, the head) is an `attendant`: an object with fileno(), serve() when that is readable,
    and tick() at least every `tick_s`."""

    def __init__(self, kernel, image, options, tap=None, attendant=None, tick_s=0.01):
        command = ["qemu-system-i386", "-accel", "tcg,thread=multi", "-cpu", "n270", "-smp", "cores=1,threads=2", "-m", "1024",
                   "-display", "none", "-monitor", "none", "-serial", "stdio", "-no-reboot", "-rtc", "base=utc", "-net", "none",
                   "-kernel", kernel, "-initrd", image, "-append", "console=ttyS0 quiet loglevel=1 panic=-1 " + options]
        if tap:
            command += ["-netdev", f"tap,id=net,ifname={tap},script=no,downscript=no", "-device", "rtl8139,netdev=net"]
        self.console = collections.deque(maxlen=SHOWN_LINES)
        self._unread = collections.deque()
        self._unfinished = b""
        self._gazed_ended = False
        self._attendant, self._tick_s = attendant, tick_s
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        os.set_blocking(self._process.stdout.fileno(), False)
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._process.stdout, selectors.EVENT_READ, self._read)
        if attendant:
            self._selector.register(attendant, selectors.EVENT_READ, attendant.serve)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind:
            say(f"the last {len(self.console)} lines of the console")
            print("\n".join("  | " + line for line in self.console))
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()

    def tell(self, line):
        try:
            self._process.stdin.write(line.encode() + b"\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise Failed(f"the emulated robot is off, it cannot be told to '{line}'") from None

    def order(self, line, limit_s):
        """Writes a word of toolchain/emulated/init to the console and waits until it is done."""
        self.tell(line)
        outcome = self.wait_for_line((f"{OWN}done: {line}", f"{OWN}failed: {line}"), limit_s)
        require(outcome.startswith(OWN + "done"), f"the robot could not do '{line}'")

    def hear(self, start, limit_s):
        """What follows `start` on the next line of toolchain/emulated/init that begins so."""
        return self.wait_for_line(OWN + start, limit_s)[len(OWN + start):].strip()

    def watch(self, condition, limit_s, what="something to happen"):
        """Lets everything go on until condition() holds, which is returned, or for limit_s."""
        end = time.monotonic() + limit_s
        while not (result := condition()) and time.monotonic() < end:
            if self._gazed_ended:
                raise Failed(f"gazed has ended, while waiting for {what}")
            if self._process.poll() is not None:
                raise Failed(f"the emulated robot is off (QEMU ended with {self._process.returncode}), while waiting for {what}")
            for key, _ in self._selector.select(self._tick_s):
                key.data()
            if self._attendant:
                self._attendant.tick()
        return result

    def wait(self, what, condition, limit_s):
        """As watch, but Failed when it does not happen."""
        result = self.watch(condition, limit_s, what)
        require(result, f"waited {limit_s:.0f} s for {what}")
        return result

    def wait_for_line(self, start, limit_s):
        """The next line on the console that begins so (or with one of several starts), of those that were not waited for yet."""
        def found():
            while self._unread:
                line = self._unread.popleft()
                if line.startswith(start):
                    return line
            return None
        return self.wait(f"'{start}' on the console", found, limit_s)

    def wait_until_off(self, limit_s):
        try:
            return self._process.wait(limit_s)
        except subprocess.TimeoutExpired:
            raise Failed(f"waited {limit_s:.0f} s for the robot to switch itself off") from None

    def _read(self):
        data = self._process.stdout.read() or b""
        *finished, self._unfinished = (self._unfinished + data).split(b"\n")
        for line in finished:
            text = line.decode(errors="replace").strip()
            self.console.append(text)
            self._unread.append(text)
            if text.startswith(OWN + GAZED_ENDED):
                self._gazed_ended = True

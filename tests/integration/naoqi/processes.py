"""The two programs of a test: gazed, and the peer that is the robot. What they print is kept, with its time."""
import contextlib
import json
import os
import pathlib
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import threading
import time

import lcm

PATIENCE_S = 120.0  # for what must come, on a machine that is busy with other work, from a gazed that is instrumented


class Process:
    """`lines` are what it has printed so far, as (time.monotonic(), text)."""

    def __init__(self, command, **arguments):
        self.lines = []
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1,
                                        **arguments)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.lines.append((time.monotonic(), line.rstrip("\n")))

    def wait_for(self, found, what, patience_s=PATIENCE_S, after=0):
        """The first line from `after` on for which found(text) is not None: its time, and what was found."""
        end = time.monotonic() + patience_s
        seen = after
        while True:
            for moment, text in self.lines[seen:]:
                seen += 1
                result = found(text)
                if result is not None:
                    return moment, result
            if time.monotonic() > end or (not self.reader.is_alive() and seen == len(self.lines)):
                raise AssertionError(f"waited for {what}; it printed:\n" + "\n".join(text for _, text in self.lines[-30:]))
            time.sleep(0.005)

    def wait_until(self, holds, what):
        """For what does not come as one line."""
        end = time.monotonic() + PATIENCE_S
        while not holds():
            if time.monotonic() > end:
                raise AssertionError(f"waited until {what}; it printed:\n" + "\n".join(text for _, text in self.lines[-30:]))
            time.sleep(0.005)

    def send(self, number):
        self.process.send_signal(number)

    def end(self, number=signal.SIGTERM):
        """The exit code."""
        if self.process.poll() is None:
            self.send(number)
        code = self.process.wait(PATIENCE_S)
        self.reader.join(PATIENCE_S)
        return code


def free_port():
    """Not one of those that are given to whoever connects to somewhere, and so perhaps to the next one who does."""
    for port in random.sample(range(10_000, 30_000), 100):
        with socket.socket() as listener, contextlib.suppress(OSError):
            listener.bind(("127.0.0.1", port))
            return port
    raise AssertionError("no free port")


def without_cpu_s(pids):
    """How long the threads of these processes have waited for a CPU so far, each by itself; 0 where the kernel does not count it."""
    waited_ns = 0
    for pid in pids:
        for counts in pathlib.Path(f"/proc/{pid}/task").glob("*/schedstat"):
            with contextlib.suppress(OSError):  # the thread has ended
                waited_ns += int(counts.read_text().split()[1])
    return 1e-9 * waited_ns


class Peer(Process):
    def __init__(self, port, **options):
        self.port = port
        script = pathlib.Path(__file__).with_name("peer.py")
        super().__init__([sys.executable, script, str(port), json.dumps(options)], stdin=subprocess.PIPE)
        self.ready_at, _ = self.wait_for(lambda text: text == '["ready"]' or None, "the peer to be ready")

    def change(self, **what):
        after = len(self.lines)
        self.process.stdin.write(json.dumps(what) + "\n")
        self.process.stdin.flush()
        self.wait_for(lambda text: text == '["changed"]' or None, "the peer to change", after=after)

    def calls(self, name=None):
        """Arguments of the calls of one method, or all calls with their names."""
        told = [json.loads(text) for _, text in self.lines if text.startswith("[\"")]
        return told if name is None else [call[1:] for call in told if call[0] == name]

    def wait_for_call(self, name, after=0):
        """When it was called, and with what."""
        return self.wait_for(lambda text: json.loads(text)[1:] if text.startswith(f'["{name}"') else None, name, after=after)

    def end(self, number=signal.SIGKILL):
        return super().end(number)


class Gazed(Process):
    def __init__(self, program, peer, folder, *options, camera="sim", head="naoqi"):
        place = f"naoqi:127.0.0.1:{peer.port}"
        self.log = os.path.join(folder, f"{time.monotonic_ns()}.lcm")
        super().__init__([program, "--camera", place if camera == "naoqi" else camera, "--head",
                          place if head == "naoqi" else head, "--print", "json", "--lcm-url", f"file://{self.log}?mode=w",
                          *options])

    def wait_for_point(self, *statuses, after=0):
        """When a point with one of the statuses was published, and the point."""
        def point(text):
            found = json.loads(text) if text.startswith("{") else None
            return found if found and found["status"] in statuses else None
        return self.wait_for(point, " or ".join(statuses), after=after)

    def wait_for_fault(self, status, says, after=0):
        """A point with this status whose reason is this one: a busy machine may give another reason first."""
        def point(text):
            found = json.loads(text) if text.startswith("{") else None
            return found if found and found["status"] == status and re.search(says, found["reason"]) else None
        return self.wait_for(point, f"{status} that says '{says}'", after=after)

    def wait_for_note(self, part, after=0, patience_s=PATIENCE_S):
        return self.wait_for(lambda text: text if part in text and not text.startswith("{") else None, f"a note of '{part}'",
                             patience_s, after)

    def points(self):
        return [json.loads(text) for _, text in self.lines if text.startswith("{")]

    def commands(self):
        """(yaw, pitch, speed) of all published, as the wire's 32 bits hold them."""
        events = lcm.EventLog(self.log, "r")
        found = [struct.unpack(">3d", event.data[16:40]) for event in events if event.channel == "GAZED_HEAD_COMMAND"]
        return [struct.unpack("3f", struct.pack("3f", *command)) for command in found]

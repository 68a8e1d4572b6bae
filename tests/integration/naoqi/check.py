"""What every check of naoqi_test.py has: the program, a peer's port, a folder; and what a failure is."""
import contextlib
import os
import signal
import time

from processes import Gazed, Peer, free_port, without_cpu_s

RECOVERY_S = 2.0  # from the peer's return; what is promised


def require(holds, what):
    if not holds:
        raise AssertionError(what)


class Promise:
    """What is promised within `seconds` from `since` on, of a machine that gives these processes the CPU when they need it."""

    def __init__(self, seconds, *processes, since=None):
        self.seconds, self.since = seconds, time.monotonic() if since is None else since
        self.pids = [os.getpid()] + [process.process.pid for process in processes]
        self.waited_before = without_cpu_s(self.pids)

    def require_kept(self, moment):
        took, waited = moment - self.since, without_cpu_s(self.pids) - self.waited_before
        require(took - waited < self.seconds, f"took {took:.2f} s, of which {waited:.2f} s without a CPU")


@contextlib.contextmanager
def running(process):
    try:
        yield process
    finally:
        process.end(signal.SIGKILL)


class Check:
    """What every check has: the program, a port, a folder."""

    def __init__(self, program, folder):
        self.program, self.folder, self.port = program, folder, free_port()

    def peer(self, **options):
        return running(Peer(self.port, **options))

    def gazed(self, peer, *options, **sources):
        return running(Gazed(self.program, peer, self.folder, *options, **sources))

    def blind(self, peer):
        """A gazed for which nothing stands out: it leaves the head where it is."""
        config = os.path.join(self.folder, "blind.toml")
        with open(config, "w", encoding="utf-8") as file:
            file.write("[saliency]\ndistinctness_min = 1.0\n")
        return self.gazed(peer, "--config", config)

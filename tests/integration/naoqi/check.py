"""What every check of naoqi_test.py has: the program, a peer's port, a folder; and what a failure is."""
import contextlib
import os
import signal

from processes import Gazed, Peer, free_port

RECOVERY_S = 2.0  # from the peer's return; what is promised


def require(holds, what):
    if not holds:
        raise AssertionError(what)


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

#!/usr/bin/env python3
"""gazed against the official library's own server: what it does with a robot's NAOqi, and with one that fails.

naoqi_test.py GAZED [NAME...]: all checks, or those named. Each has a peer and a gazed of its own; four run at a time, since they
mostly wait. Exit: 0 passed, 1 failed, 77 cannot be run here.
"""
import concurrent.futures
import contextlib
import math
import os
import signal
import sys
import tempfile
import time
import traceback

try:
    import lcm  # noqa: F401
    import qi  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}; toolchain/test installs it")
    sys.exit(77)

from processes import Gazed, Peer, free_port

RECOVERY_S = 2.0  # from the peer's return; what issue and README promise
TRUE_RANGE_M = 0.30  # of the wall in the report's tests, along the optical axis of the camera
SIGMAS_MAX = 4.0  # of a true value; beyond is no accident in two fixations
HOLD_TOLERANCE_RAD = 0.02  # the head moved on while it was asked where it is


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


def require_given_back(peer):
    enabled = [call[1] for name in ("setBreathEnabled", "setIdlePostureEnabled") for call in peer.calls(name)]
    require(enabled == [False, True, False, True], f"breathing and idle posture were set to {enabled}")
    require(peer.calls("setStiffnesses")[-1][1] == [0.0, 0.0], "the stiffness is not as it was found")


def report_tests(check):
    """The report's tests 1 and 2, as well located as with the simulated head."""
    with check.peer() as peer, check.gazed(peer, "--fixations", "2") as gazed:
        require(gazed.process.wait(30) == 0, "gazed failed")
        gazed.reader.join()
        points = gazed.points()
        require([point["status"] for point in points] == ["LOCATED", "LOCATED"], f"{points}")
        for point in points:
            x, y = ((pixel - centre) / 608.0 for pixel, centre in zip(point["pixel_1"], (319.5, 239.5)))
            if point["fixation"] == 1:  # there the wall is straight ahead
                true = 1.0 / (TRUE_RANGE_M * math.sqrt(1.0 + x * x + y * y))
                off = abs(point["inverse_range_per_m"] - true) / point["inverse_range_sigma_per_m"]
                require(off < SIGMAS_MAX, f"{off} sigmas off: {point}")
        require_given_back(peer)


def commands_once(check):
    """Every command that was published has come once, as it was, and in order; at the end one to stay."""
    with check.peer() as peer, check.gazed(peer, "--fixations", "6") as gazed:
        require(gazed.process.wait(30) == 0, "gazed failed")
        sent = [(*angles, speed) for _, angles, speed in peer.calls("setAngles")]
        published = gazed.commands()
        require(len(published) >= 6, f"only {len(published)} commands")
        require(len(sent) == len(published) + 1, f"published {published}, came {sent}")
        for came, told in zip(sent, published):
            require(all(abs(a - b) < 1e-6 for a, b in zip(came, told)), f"published {told}, came {came}")
        require(math.dist(sent[-1][:2], sent[-2][:2]) < HOLD_TOLERANCE_RAD, f"held at {sent[-1]} after {sent[-2]}")


def left_as_found(check):
    """What is as it should be is left alone, at the start and at the end."""
    with check.peer(faults={"stiffness": {"HeadYaw": 1.0, "HeadPitch": 0.8}, "own motions": False}) as peer:
        with check.gazed(peer) as gazed:
            gazed.wait_for_point("LOCATED")
            require(gazed.end() == 0, "SIGTERM is a good end")
        require(not any(peer.calls(name) for name in ("setStiffnesses", "setBreathEnabled", "setIdlePostureEnabled")),
                f"it was changed: {peer.calls()}")


def dies_and_returns(check):
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        peer.end()
        gazed.wait_for_point("HEAD_FAULT", after=len(gazed.lines))
        gazed.wait_for_note("Connection refused")
        before = len(gazed.lines)
        with check.peer() as back:
            taken_over, _ = back.wait_for_call("setStiffnesses")
            require(taken_over - back.ready_at < RECOVERY_S, f"took {taken_over - back.ready_at} s")
            gazed.wait_for_point("LOCATED", after=before)
            require(gazed.end() == 0, "SIGTERM is a good end")
            require_given_back(back)


def hangs_and_goes_on(check):
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        peer.send(signal.SIGSTOP)
        before = len(gazed.lines)
        gazed.wait_for_point("HEAD_FAULT", after=before)
        gazed.wait_for_note("no answer for 1.0 s")
        calls_before = len(peer.lines)
        peer.send(signal.SIGCONT)
        returned = time.monotonic()
        back, _ = peer.wait_for_call("setAngles", after=calls_before + 1)
        require(back - returned < RECOVERY_S + 1.0, f"took {back - returned} s")  # and a second look at the scene
        gazed.wait_for_point("LOCATED", after=before)
        published = len(gazed.commands())
        require(len(peer.calls("setAngles")) <= published + 2, "a command was repeated")
        require(gazed.end() == 0, "SIGTERM is a good end")


def hung_at_the_end(check):
    """A robot that does not answer does not keep gazed from ending."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        peer.send(signal.SIGSTOP)
        require(gazed.end() == 0, "SIGTERM is a good end")


def faults_and_mends(check, fault, mended, says, told=()):
    """A fault of the angles: HEAD_FAULT that says why, and a located point once it is over."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        before = len(gazed.lines)
        peer.change(**fault)
        _, point = gazed.wait_for_point("HEAD_FAULT", after=before)
        require(says in point["reason"], f"{says} is not in {point['reason']}")
        for note in told:
            gazed.wait_for_note(note, after=before)
        before = len(gazed.lines)
        peer.change(**mended)
        gazed.wait_for_point("LOCATED", after=before)
        require(gazed.end() == 0, "SIGTERM is a good end")


def angles_are_refused(check):
    faults_and_mends(check, {"error": "getAngles"}, {"error": None}, "no angles today")


def angles_are_nan(check):
    faults_and_mends(check, {"nan": True}, {"nan": False}, "nan")


def one_angle_only(check):
    faults_and_mends(check, {"one angle": True}, {"one angle": False}, "another form")


def angles_come_slowly(check):
    faults_and_mends(check, {"slow": 0.3}, {"slow": 0.0}, "took 0.3")


def commands_are_refused(check):
    faults_and_mends(check, {"error": "setAngles"}, {"error": None}, "has not settled", ["does not feel like it"])


def joints_are_stuck(check):
    faults_and_mends(check, {"stuck": True}, {"stuck": False}, "has not settled", ["is stuck: at"])


def methods_are_missing(check):
    with check.peer(missing=["setAngles"]) as peer, check.gazed(peer) as gazed:
        gazed.wait_for_note("no method setAngles(mmf)")
        gazed.wait_for_point("HEAD_FAULT")
    optional = ["getLimits", "getBreathEnabled", "setBreathEnabled", "getIdlePostureEnabled", "setIdlePostureEnabled"]
    check.port = free_port()
    with check.peer(missing=optional) as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")


def somebody_else_moves_the_head(check):
    with check.peer() as peer, check.blind(peer) as gazed:
        gazed.wait_for_point("NO_SALIENT_OBJECT")
        time.sleep(0.6)  # HeadGuard: so long after a new set point it may still be on its way back
        peer.change(angles={"HeadYaw": 0.6, "HeadPitch": 0.0})
        gazed.wait_for_note("somebody else moves the head: HeadYaw at 0.6")
        require(not peer.calls("setAngles"), "it was fought")


def stiffness_is_taken_away(check):
    with check.peer() as peer, check.blind(peer) as gazed:
        gazed.wait_for_point("NO_SALIENT_OBJECT")
        peer.change(stiffness={"HeadYaw": 0.0, "HeadPitch": 0.0})
        gazed.wait_for_note("HeadYaw has lost its stiffness")
        require(len(peer.calls("setStiffnesses")) == 1, "it was given back by force")


def head_is_hot(check):
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        before = len(gazed.lines)
        peer.change(temperature={"HeadPitch": 82.0})
        gazed.wait_for_note("HeadPitch is too hot: 82 C", after=before)
        gazed.wait_for_point("HEAD_FAULT", after=before)  # it is not moved any more
        before = len(gazed.lines)
        peer.change(temperature={"HeadPitch": 50.0})
        gazed.wait_for_point("LOCATED", after=before)


def limits_are_narrower(check):
    """A robot that may turn its head less far than a NAO is not told to go farther."""
    with check.peer(faults={"narrower": 0.5}) as peer, check.gazed(peer) as gazed:
        gazed.wait_for_note("the robot's own limits are narrower")
        for _, (yaw, pitch), _ in peer.calls("setAngles"):
            require(abs(yaw) <= 1.5857 and -0.172 <= pitch <= 0.0149, f"told to go to ({yaw}, {pitch})")


def camera_and_head(check):
    """Both of the same robot; nothing is left subscribed after SIGTERM, and what SIGKILL left is cleared."""
    with check.peer() as peer:
        with check.gazed(peer, camera="naoqi") as gazed:
            _, point = gazed.wait_for_point("LOCATED", "UNCERTAIN")
            require(point["views"] == 2, f"{point}")
            require(gazed.end() == 0, "SIGTERM is a good end")
        require(peer.calls("subscribers")[-1] == [0], "it is still subscribed")
        for _ in range(7):  # once more than a name serves
            with check.gazed(peer, camera="naoqi") as gazed:
                before = len(peer.lines)
                peer.wait_for_call("subscribeCamera", after=before)
                gazed.end(signal.SIGKILL)
        with check.gazed(peer, camera="naoqi") as gazed:
            gazed.wait_for_point("LOCATED", "UNCERTAIN")
            require(gazed.end() == 0, "SIGTERM is a good end")
        require(peer.calls("subscribers")[-1] == [0], "it is still subscribed")


def camera_fails(check):
    with check.peer() as peer, check.gazed(peer, camera="naoqi") as gazed:
        gazed.wait_for_point("LOCATED", "UNCERTAIN")
        for fault, says in (({"no image": True}, "it has no image"), ({"small": True}, "an image of 320x240")):
            before = len(gazed.lines)
            peer.change(**fault)
            _, point = gazed.wait_for_point("CAMERA_FAULT", after=before)
            require(says in point["reason"], f"{says} is not in {point['reason']}")
            before = len(gazed.lines)
            peer.change(**dict.fromkeys(fault, False))
            gazed.wait_for_point("LOCATED", "UNCERTAIN", after=before)
        peer.end()
        gazed.wait_for_point("CAMERA_FAULT", after=len(gazed.lines))
        before = len(gazed.lines)
        with check.peer() as back:
            subscribed, _ = back.wait_for_call("subscribeCamera")
            require(subscribed - back.ready_at < RECOVERY_S, f"took {subscribed - back.ready_at} s")
            gazed.wait_for_point("LOCATED", "UNCERTAIN", after=before)
            require(gazed.end() == 0, "SIGTERM is a good end")
            require(back.calls("subscribers")[-1] == [0], "it is still subscribed")


def second_is_refused(check):
    """Two would fight for the head."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        with check.gazed(peer) as second:
            second.wait_for_note(f"is used by process {gazed.process.pid}, another gazed")
            require(second.process.wait(30) == 1, "it should have ended")


CHECKS = [camera_and_head, camera_fails, hangs_and_goes_on, dies_and_returns, report_tests, commands_once, left_as_found,
          hung_at_the_end, angles_are_refused, angles_are_nan, one_angle_only, angles_come_slowly, commands_are_refused,
          joints_are_stuck, methods_are_missing, somebody_else_moves_the_head, stiffness_is_taken_away, head_is_hot,
          limits_are_narrower, second_is_refused]


def run(check, program):
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        try:
            check(Check(program, folder))
            failure = None
        except Exception:  # any failure of one check is told, and the others go on
            failure = traceback.format_exc()
    return check.__name__, failure, time.monotonic() - started


def main():
    program, names = sys.argv[1], sys.argv[2:]
    chosen = [check for check in CHECKS if not names or check.__name__ in names]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for done in concurrent.futures.as_completed([pool.submit(run, check, program) for check in chosen]):
            name, failure, seconds = done.result()
            print(f"{'FAILED' if failure else 'passed'}  {name}  {seconds:.1f} s", flush=True)
            if failure:
                failed += 1
                print(failure, flush=True)
    print(f"{len(chosen) - failed} of {len(chosen)} checks passed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

"""The head from the first command to the last: what is done, given back, and found again."""
import math
import os
import signal

from check import RECOVERY_S, Promise, require
from processes import PATIENCE_S

TRUE_RANGE_M = 0.30  # of the wall in the report's tests, along the optical axis of the camera
SIGMAS_MAX = 4.0  # of a true value; beyond is no accident in two fixations
HOLD_TOLERANCE_RAD = 0.02  # the head moved on while it was asked where it is


def require_given_back(peer):
    def enabled():
        return [call[1] for name in ("setBreathEnabled", "setIdlePostureEnabled") for call in peer.calls(name)]
    peer.wait_until(lambda: len(enabled()) == 4, "breathing and idle posture are set twice")
    require(enabled() == [False, True, False, True], f"breathing and idle posture were set to {enabled()}")
    peer.wait_until(lambda: peer.calls("setStiffnesses")[-1][1] == [0.0, 0.0], "the stiffness is as it was found")


def is_same(came, published):
    return all(abs(a - b) < 1e-6 for a, b in zip(came, published))


def require_none_repeated(peer, gazed):
    """What came are some of the commands that were published, each once and in order, and then one to stay."""
    published = iter(gazed.commands())
    for _, angles, speed in peer.calls("setAngles")[:-1]:
        came = (*angles, speed)
        require(any(is_same(came, told) for told in published), f"{came} came again, or was never published")


def two_located(check):
    """The points of two fixations. A busy machine may be late with head or camera, which gazed says: then once more."""
    for _ in range(5):
        with check.peer() as peer, check.gazed(peer, "--fixations", "2") as gazed:
            require(gazed.process.wait(PATIENCE_S) == 0, "gazed failed")
            gazed.reader.join()
            points = gazed.points()
            statuses = [point["status"] for point in points]
            if statuses == ["LOCATED", "LOCATED"]:
                require_given_back(peer)
                return points
            require(set(statuses) <= {"LOCATED", "HEAD_FAULT", "CAMERA_FAULT"}, f"{points}")
    raise AssertionError(f"five times something else than two located: {points}")


def report_tests(check):
    """The report's tests 1 and 2, as well located as with the simulated head."""
    for point in two_located(check):
        x, y = ((pixel - centre) / 608.0 for pixel, centre in zip(point["pixel_1"], (319.5, 239.5)))
        if point["fixation"] == 1:  # there the wall is straight ahead
            true = 1.0 / (TRUE_RANGE_M * math.sqrt(1.0 + x * x + y * y))
            off = abs(point["inverse_range_per_m"] - true) / point["inverse_range_sigma_per_m"]
            require(off < SIGMAS_MAX, f"{off} sigmas off: {point}")


def commands_once(check):
    """Every command that was published has come once, as it was, and in order; at the end one to stay."""
    with check.peer() as peer, check.gazed(peer, "--fixations", "6") as gazed:
        require(gazed.process.wait(PATIENCE_S) == 0, "gazed failed")
        published = gazed.commands()
        require(len(published) >= 6, f"only {len(published)} commands")
        peer.wait_until(lambda: len(peer.calls("setAngles")) > len(published), "all commands have come, and one to stay")
        sent = [(*angles, speed) for _, angles, speed in peer.calls("setAngles")]
        require(len(sent) == len(published) + 1, f"published {published}, came {sent}")
        for came, told in zip(sent, published):
            require(is_same(came, told), f"published {told}, came {came}")
        # The last point is out while the head is still on its way back to its first look.
        for from_rad, to_rad, held_rad in zip(sent[-3][:2], sent[-2][:2], sent[-1][:2]):
            require(min(from_rad, to_rad) - HOLD_TOLERANCE_RAD < held_rad < max(from_rad, to_rad) + HOLD_TOLERANCE_RAD,
                    f"held at {sent[-1]} after {sent[-3]} and {sent[-2]}")


def token_is_not_recorded(check):
    """Recordings are handed on."""
    config, log = (os.path.join(check.folder, name) for name in ("secret.toml", "record.lcm"))
    with open(config, "w", encoding="utf-8") as file:
        file.write('[naoqi]\nuser = "somebody"\ntoken = "open sesame"\n')
    with check.peer() as peer, check.gazed(peer, "--config", config, "--record", log) as gazed:
        gazed.wait_for_point("LOCATED")
        require(gazed.end() == 0, "SIGTERM is a good end")
    with open(log, "rb") as file:
        recorded = file.read()
    require(b"settle_timeout_s" in recorded, "the configuration is not in the log")
    require(b"open sesame" not in recorded and b"somebody" not in recorded, "the token is in the log")


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
        before = len(gazed.lines)
        peer.end()
        gazed.wait_for_point("HEAD_FAULT", after=before)
        gazed.wait_for_note("Connection refused", after=before)
        before = len(gazed.lines)
        with check.peer() as back:
            recovery = Promise(RECOVERY_S, gazed, back, since=back.ready_at)
            taken_over, _ = back.wait_for_call("setStiffnesses")
            recovery.require_kept(taken_over)
            gazed.wait_for_point("LOCATED", after=before)
            require(gazed.end() == 0, "SIGTERM is a good end")
            require_given_back(back)


def hangs_and_goes_on(check):
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        before = len(gazed.lines)
        peer.send(signal.SIGSTOP)
        gazed.wait_for_point("HEAD_FAULT", after=before)
        # To one question, or to several: "no answer in time", "no answer for 1.0 s".
        gazed.wait_for_note("no answer", after=before)
        before, calls_before = len(gazed.lines), len(peer.lines)
        recovery = Promise(RECOVERY_S + 1.0, gazed, peer)  # and a second look at the scene
        peer.send(signal.SIGCONT)
        back, _ = peer.wait_for_call("setAngles", after=calls_before + 1)
        recovery.require_kept(back)
        gazed.wait_for_point("LOCATED", after=before)
        require(gazed.end() == 0, "SIGTERM is a good end")
        require_none_repeated(peer, gazed)


def hung_at_the_end(check):
    """A robot that does not answer does not keep gazed from ending."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        peer.send(signal.SIGSTOP)
        require(gazed.end() == 0, "SIGTERM is a good end")


def second_is_refused(check):
    """Two would fight for the head."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        with check.gazed(peer) as second:
            second.wait_for_note(f"is used by process {gazed.process.pid}, another gazed")
            require(second.process.wait(PATIENCE_S) == 1, "it should have ended")


def killed_and_released(check):
    """NAOqi keeps the head of a gazed that was killed as stiff as it was; --release-head makes it limp."""
    with check.peer() as peer:
        with check.gazed(peer) as gazed:
            gazed.wait_for_point("LOCATED")
            gazed.end(signal.SIGKILL)
        require(peer.calls("setStiffnesses")[-1][1] != [0.0, 0.0], "the head is limp already")
        with check.gazed(peer, "--release-head") as released:
            require(released.process.wait(PATIENCE_S) == 0, f"{released.lines}")
        require(peer.calls("setStiffnesses")[-1][1] == [0.0, 0.0], f"still stiff: {peer.calls('setStiffnesses')}")


CHECKS = [hangs_and_goes_on, dies_and_returns, report_tests, commands_once, token_is_not_recorded, left_as_found,
          hung_at_the_end, second_is_refused, killed_and_released]

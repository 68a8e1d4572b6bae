"""A head that says what cannot be, does not do what it is told, or is not what a NAO's is."""
import contextlib
import itertools

from check import require
from processes import free_port


def faults_and_mends(check, fault, mended, says, told=()):
    """A fault of the angles: HEAD_FAULT that says why, and a located point once it is over."""
    with check.peer() as peer, check.gazed(peer) as gazed:
        gazed.wait_for_point("LOCATED")
        before = len(gazed.lines)
        peer.change(**fault)
        gazed.wait_for_fault("HEAD_FAULT", says, after=before)
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
    faults_and_mends(check, {"slow": 0.3}, {"slow": 0.0}, r"took (0\.[3-9]|[1-9])")


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
        # HeadGuard: for a while after a new set point it may still be on its way back. Then it is moved again.
        angles, noted = itertools.cycle((0.6, -0.6)), []

        def moves_on():
            peer.change(angles={"HeadYaw": next(angles), "HeadPitch": 0.0})
            with contextlib.suppress(AssertionError):
                noted.append(gazed.wait_for_note("somebody else moves the head: HeadYaw at", patience_s=5.0))
            return noted

        peer.wait_until(moves_on, "somebody else is noticed")
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
        peer.wait_for_call("setAngles")
        for _, (yaw, pitch), _ in peer.calls("setAngles"):
            require(abs(yaw) <= 1.5857 and -0.172 <= pitch <= 0.0149, f"told to go to ({yaw}, {pitch})")


CHECKS = [angles_are_refused, angles_are_nan, one_angle_only, angles_come_slowly, commands_are_refused, joints_are_stuck,
          methods_are_missing, somebody_else_moves_the_head, stiffness_is_taken_away, head_is_hot, limits_are_narrower]

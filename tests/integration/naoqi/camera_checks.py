"""ALVideoDevice: the images, the subscription, and their faults."""
import signal

from check import RECOVERY_S, Promise, require


def require_unsubscribed(peer):
    peer.wait_until(lambda: peer.calls("subscribers")[-1:] == [[0]], "nobody is subscribed")


def camera_and_head(check):
    """Both of the same robot; nothing is left subscribed after SIGTERM, and what SIGKILL left is cleared."""
    with check.peer() as peer:
        with check.gazed(peer, camera="naoqi") as gazed:
            _, point = gazed.wait_for_point("LOCATED", "UNCERTAIN")
            require(point["views"] >= 3, f"{point}")
            require(gazed.end() == 0, "SIGTERM is a good end")
        require_unsubscribed(peer)
        for _ in range(7):  # once more than a name serves
            before = len(peer.lines)
            with check.gazed(peer, camera="naoqi") as gazed:
                peer.wait_for_call("subscribeCamera", after=before)
                gazed.end(signal.SIGKILL)
        with check.gazed(peer, camera="naoqi") as gazed:
            gazed.wait_for_point("LOCATED", "UNCERTAIN")
            require(gazed.end() == 0, "SIGTERM is a good end")
        require_unsubscribed(peer)


def camera_fails(check):
    with check.peer() as peer, check.gazed(peer, camera="naoqi") as gazed:
        gazed.wait_for_point("LOCATED", "UNCERTAIN")
        for fault, says in (({"no image": True}, "it has no image"), ({"small": True}, "an image of 320x240")):
            before = len(gazed.lines)
            peer.change(**fault)
            gazed.wait_for_fault("CAMERA_FAULT", says, after=before)
            before = len(gazed.lines)
            peer.change(**dict.fromkeys(fault, False))
            gazed.wait_for_point("LOCATED", "UNCERTAIN", after=before)
        before = len(gazed.lines)
        peer.end()
        gazed.wait_for_point("CAMERA_FAULT", after=before)
        before = len(gazed.lines)
        with check.peer() as back:
            recovery = Promise(RECOVERY_S, gazed, back, since=back.ready_at)
            subscribed, _ = back.wait_for_call("subscribeCamera")
            recovery.require_kept(subscribed)
            gazed.wait_for_point("LOCATED", "UNCERTAIN", after=before)
            require(gazed.end() == 0, "SIGTERM is a good end")
            require_unsubscribed(back)


CHECKS = [camera_and_head, camera_fails]

"""A robot's NAOqi: the official library's own server, with the services that gazed talks to.

peer.py PORT: serves until standard input ends. A line there is a JSON object that changes the robot ({"nan": true}); a line on
standard output is a JSON list: what was called, with which arguments.
"""
import json
import math
import sys
import threading
import time

import qi

import scenery

JOINTS = ("HeadYaw", "HeadPitch")
# Limits, greatest speed and torque of the NAO's URDFs: rad, rad/s, Nm.
LIMITS = {"HeadYaw": [-2.08567, 2.08567, 8.26797, 1.547], "HeadPitch": [-0.671952, 0.514872, 7.19407, 1.532]}
MEMORY = {f"Device/SubDeviceList/{joint}/Temperature/Sensor/Value": joint for joint in JOINTS}


class Robot:
    """What the services share. Faults are entries of `faults`."""

    def __init__(self):
        self.lock = threading.RLock()
        self.faults = {}
        self.angles = dict.fromkeys(JOINTS, 0.0)
        self.targets = dict.fromkeys(JOINTS, 0.0)
        self.speeds = dict.fromkeys(JOINTS, 0.0)
        self.stiffness = dict.fromkeys(JOINTS, 0.0)
        self.temperature = dict.fromkeys(JOINTS, 38.0)
        self.breathing = self.idle = True
        self.moved = time.monotonic()
        self.subscribers = []
        self.scenery = scenery.Scenery()

    def tell(self, *what):
        with self.lock:
            print(json.dumps(what), flush=True)

    def change(self, what):
        with self.lock:
            self.move()
            for name, value in what.items():
                if name in ("stiffness", "temperature", "angles"):
                    getattr(self, name).update(value)
                elif name == "own motions":
                    self.breathing = self.idle = value
                else:
                    self.faults[name] = value
                if name == "angles":
                    self.targets.update(value)

    def move(self):
        """Each joint goes to its target at its speed, and no further; without stiffness not at all."""
        with self.lock:
            now = time.monotonic()
            passed, self.moved = now - self.moved, now
            for joint in JOINTS:
                way = self.targets[joint] - self.angles[joint]
                if self.stiffness[joint] <= 0.0 or self.faults.get("stuck"):
                    continue
                self.angles[joint] += math.copysign(min(abs(way), self.speeds[joint] * passed), way)

    def leave(self, leaves):
        with self.lock:
            before = len(self.subscribers)
            self.subscribers = [name for name in self.subscribers if not leaves(name)]
            self.tell("subscribers", len(self.subscribers))
            return len(self.subscribers) < before

    def called(self, name, *arguments):
        self.tell(name, *arguments)
        if self.faults.get("error") == name:
            raise RuntimeError("the robot does not feel like it")


def joints(names):
    names = [names] if isinstance(names, str) else list(names)
    return list(JOINTS) if names == ["Head"] else names


def service(robot, missing=()):
    """ALMotion as its class, without the methods in `missing`."""

    class ALMotion:
        pass

    def method(returns, *takes):
        def bind(function):
            if function.__name__ not in missing:
                setattr(ALMotion, function.__name__, qi.bind(returns, list(takes))(function))
        return bind

    @method(qi.Void, qi.Dynamic, qi.Dynamic, qi.Float)
    def setAngles(self, names, angles, fraction):
        robot.called("setAngles", joints(names), list(angles), fraction)
        with robot.lock:
            robot.move()
            for joint, angle in zip(joints(names), angles):
                low, high, speed, _ = LIMITS[joint]
                robot.targets[joint] = min(max(angle, low), high)
                robot.speeds[joint] = fraction * speed

    @method(qi.List(qi.Float), qi.Dynamic, qi.Bool)
    def getAngles(self, names, use_sensors):
        if robot.faults.get("error") == "getAngles":
            raise RuntimeError("no angles today")
        if robot.faults.get("slow"):
            time.sleep(robot.faults["slow"])
        with robot.lock:
            robot.move()
            angles = [robot.angles[joint] for joint in joints(names)]
        if robot.faults.get("nan"):
            angles[0] = math.nan
        return angles[1:] if robot.faults.get("one angle") else angles

    @method(qi.Void, qi.Dynamic, qi.Dynamic)
    def setStiffnesses(self, names, stiffnesses):
        robot.called("setStiffnesses", names, stiffnesses)
        with robot.lock:
            robot.stiffness.update(zip(joints(names), stiffnesses))

    @method(qi.List(qi.Float), qi.Dynamic)
    def getStiffnesses(self, names):
        return [robot.stiffness[joint] for joint in joints(names)]

    @method(qi.Dynamic, qi.String)
    def getLimits(self, name):
        narrower = robot.faults.get("narrower", 0.0)
        return [[low + narrower, high - narrower, speed, effort]
                for low, high, speed, effort in (LIMITS[joint] for joint in joints(name))]

    @method(qi.Void, qi.String, qi.Bool)
    def setBreathEnabled(self, chain, on):
        robot.called("setBreathEnabled", chain, on)
        robot.breathing = on

    @method(qi.Bool, qi.String)
    def getBreathEnabled(self, chain):
        return robot.breathing

    @method(qi.Void, qi.String, qi.Bool)
    def setIdlePostureEnabled(self, chain, on):
        robot.called("setIdlePostureEnabled", chain, on)
        robot.idle = on

    @method(qi.Bool, qi.String)
    def getIdlePostureEnabled(self, chain):
        return robot.idle

    return ALMotion()


def memory(robot):
    class ALMemory:
        @qi.bind(qi.Dynamic, [qi.Dynamic])
        def getListData(self, keys):
            return [robot.temperature[MEMORY[key]] for key in keys]

    return ALMemory()


def video(robot):
    class ALVideoDevice:
        """As the robot's, a name serves six times."""

        @qi.bind(qi.String, [qi.String, qi.Int32, qi.Int32, qi.Int32, qi.Int32])
        def subscribeCamera(self, name, camera, resolution, colours, fps):
            robot.called("subscribeCamera", name, camera, resolution, colours, fps)
            with robot.lock:
                for number in range(6):
                    handle = f"{name}_{number}"
                    if handle not in robot.subscribers:
                        robot.subscribers.append(handle)
                        return handle
            return ""

        @qi.bind(qi.Bool, [qi.String])
        def unsubscribe(self, handle):
            robot.called("unsubscribe", handle)
            return robot.leave(lambda subscriber: subscriber == handle)

        @qi.bind(qi.Bool, [qi.String])
        def unsubscribeAllInstances(self, name):
            robot.called("unsubscribeAllInstances", name)
            return robot.leave(lambda subscriber: subscriber.rpartition("_")[0] == name)

        @qi.bind(qi.Dynamic, [qi.String])
        def getImageRemote(self, handle):
            if handle not in robot.subscribers or robot.faults.get("no image"):
                return None
            with robot.lock:
                robot.move()
                angles = dict(robot.angles)
            stamp_us = time.time_ns() // 1000
            width, height = (320, 240) if robot.faults.get("small") else (scenery.WIDTH, scenery.HEIGHT)
            return [width, height, 2, 9, stamp_us // 1_000_000, stamp_us % 1_000_000,
                    robot.scenery.image(angles["HeadYaw"], angles["HeadPitch"]), 0, 0.5, 0.4, -0.5, -0.4]

        @qi.bind(qi.Bool, [qi.String])
        def releaseImage(self, handle):
            return handle in robot.subscribers

    return ALVideoDevice()


def main():
    robot = Robot()
    options = json.loads(sys.argv[2]) if len(sys.argv) > 2 else {}
    robot.change(options.get("faults", {}))
    session = qi.Session()
    session.listenStandalone(f"tcp://127.0.0.1:{sys.argv[1]}")
    session.registerService("ALMotion", service(robot, options.get("missing", ())))
    session.registerService("ALMemory", memory(robot))
    session.registerService("ALVideoDevice", video(robot))
    robot.tell("ready")
    for line in sys.stdin:
        robot.change(json.loads(line))
        robot.tell("changed")


if __name__ == "__main__":
    main()

"""What the robot's network has besides the robot: a listener to gazed's messages, and the head, for want of joints in an emulated robot."""

import math
import time

PREFIX = "GAZED"
STATE_PERIOD_S = 0.02
# HeadPitch, the slower joint, without load (velocity limit of the NAO URDFs); both arrive together.
SPEED_RAD_S = 7.19


class Head:
    """Turns to the newest command at the joints' speed, and says where it is."""

    def __init__(self):
        self.angles = [0.0, 0.0]
        self.commands = 0
        self._goal, self._speed = [0.0, 0.0], 0.0

    def command(self, message):
        self.commands += 1
        self._goal, self._speed = [message.yaw_rad, message.pitch_rad], message.speed_fraction * SPEED_RAD_S

    def move(self, elapsed_s):
        """The velocities of yaw and pitch meanwhile."""
        to_go = [goal - angle for goal, angle in zip(self._goal, self.angles)]
        longest = max(abs(angle) for angle in to_go)
        part = min(1.0, self._speed * elapsed_s / longest) if longest > 0.0 else 0.0
        self.angles = [angle + part * rest for angle, rest in zip(self.angles, to_go)]
        return [part * rest / elapsed_s for rest in to_go]


class Workstation:
    def __init__(self, lcm, gazed, url):
        self.head = Head()
        self.statuses, self.points = [], []
        self.maps = []  # each with its age on arrival, in seconds
        self._state_type = gazed.head_state_t
        self._lcm = lcm.LCM(url)
        self._moved_s = self._due_s = time.monotonic()
        self._subscribe("STATUS", gazed.status_t, self.statuses.append)
        self._subscribe("SALIENCY", gazed.saliency_map_t, self._take_map)
        self._subscribe("LOCATED_POINT", gazed.located_point_t, self.points.append)
        self._subscribe("HEAD_COMMAND", gazed.head_command_t, self.head.command)

    def forget(self):
        """What came so far was another gazed's."""
        for messages in (self.statuses, self.points, self.maps):
            messages.clear()
        self.head.commands = 0

    def _take_map(self, message):
        self.maps.append((message, time.time() - 1e-6 * message.utime))

    def _subscribe(self, name, kind, take):
        subscription = self._lcm.subscribe(f"{PREFIX}_{name}", lambda channel, data: take(kind.decode(data)))
        subscription.set_queue_capacity(1000)

    def fileno(self):
        return self._lcm.fileno()

    def serve(self):
        self._lcm.handle_timeout(0)

    def tick(self):
        now_s = time.monotonic()
        if now_s < self._due_s:
            return
        state = self._state_type()
        state.utime = time.time_ns() // 1000
        state.yaw_velocity_rad_s, state.pitch_velocity_rad_s = self.head.move(max(now_s - self._moved_s, 1e-6))
        state.yaw_rad, state.pitch_rad = self.head.angles
        state.stiffness, state.temperature_c = 1.0, math.nan
        self._lcm.publish(f"{PREFIX}_HEAD_STATE", state.encode())
        self._moved_s = now_s
        self._due_s = max(self._due_s + STATE_PERIOD_S, now_s)

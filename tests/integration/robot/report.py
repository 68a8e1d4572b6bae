"""What the test prints: a line a check, with the measured figure."""


class Failed(Exception):
    """A check that did not hold, in words."""


def say(what, figures=""):
    print(f"robot_test: {what}{': ' if figures else ''}{figures}", flush=True)


def require(holds, what):
    if not holds:
        raise Failed(what)

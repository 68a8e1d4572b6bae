"""gazed from Python: which place of a picture stands out, where a point is that a head saw twice, and
the LCM types that the daemon publishes (located_point_t and others).

    import gazed
    result = gazed.saliency(picture)                # uint8, height x width x 3 (r, g, b), or grey
    rig = gazed.Rig("nao-v6")                       # a camera in a head; its numbers can be set
    point = rig.triangulate((0.0, 0.0), (319.8, 239.5), (0.341, -0.198), (575.3, 383.7))
    message = gazed.located_point_t.decode(data)    # of the channel GAZED_LOCATED_POINT

Metres, radians, pixels; (0, 0) is the centre of the top left pixel. Head angles are (yaw, pitch), yaw
positive to the left, pitch positive down.
"""

from ._native import (
    Point,
    Rig,
    SaliencyResult,
    __version__,
    methods,
    profiles,
    robots,
    saliency,
)
from ._types import *  # noqa: F401,F403  what lcm-gen makes of msgs/

__all__ = [name for name in dir() if not name.startswith("_")] + ["__version__"]

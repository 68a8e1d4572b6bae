"""A bot_core.image_t as Rerun shows it."""
import numpy as np
import rerun
from bot_core import image_t

MODELS = {image_t.PIXEL_FORMAT_RGB3: ("RGB", 3), image_t.PIXEL_FORMAT_GREY: ("L", 1)}


def rerun_image(image):
    """None for a format that Rerun does not know."""
    if image.data.startswith(b"\xff\xd8"):
        return rerun.EncodedImage(contents=image.data, media_type="image/jpeg")
    if image.pixelformat == image_t.PIXEL_FORMAT_YUYV and image.row_stride == 2 * image.width:
        return rerun.Image(bytes=image.data, width=image.width, height=image.height, pixel_format=rerun.PixelFormat.YUY2)
    if image.pixelformat not in MODELS:
        return None
    model, channels = MODELS[image.pixelformat]
    shape, strides = (image.height, image.width, channels), (image.row_stride, channels, 1)  # rows may be padded
    return rerun.Image(np.ndarray(shape, np.uint8, image.data, 0, strides), color_model=model)

"""python_module_test.py: the installed Python module gazed: saliency of a picture, the chain, two looks, the LCM types."""

import math
import unittest

import numpy as np

import bot_core
import gazed

# A sample of the saliency map: it says which object, not where in it.
PEAK_TOLERANCE_PX = 16
# Of a point half a metre away, seen without noise: rounding.
POINT_TOLERANCE_M = 1e-9


def picture_of_a_red_square():
    picture = np.full((240, 320, 3), 128, np.uint8)
    picture[96:128, 200:232] = (200, 30, 30)
    return picture


class Saliency(unittest.TestCase):
    def test_finds_the_square(self):
        for profile in gazed.profiles:
            result = gazed.saliency(picture_of_a_red_square(), profile)
            self.assertTrue(result.distinct, profile)
            self.assertEqual(result.map.shape, (15, 20))
            np.testing.assert_allclose(result.peak_px, (215.5, 111.5), atol=PEAK_TOLERANCE_PX)

    def test_a_slice_is_a_picture(self):
        wide = np.zeros((240, 640, 3), np.uint8)
        wide[:, ::2] = picture_of_a_red_square()
        a, b = gazed.saliency(wide[:, ::2]), gazed.saliency(picture_of_a_red_square())
        np.testing.assert_array_equal(a.map, b.map)

    def test_grey_walls_have_nothing(self):
        self.assertFalse(gazed.saliency(np.full((120, 160), 90, np.uint8)).distinct)

    def test_what_is_no_picture_is_refused(self):
        good = picture_of_a_red_square()
        for wrong in (good.astype(float), good[:, :, :2], good[0], np.zeros((0, 0, 3), np.uint8), good[:50], np.zeros((240, 320, 3), np.int8)):
            with self.assertRaises(ValueError):
                gazed.saliency(wrong)
        with self.assertRaisesRegex(ValueError, "'best' found; allowed: report, robust, surround"):
            gazed.saliency(good, "best")


class Rig(unittest.TestCase):
    def test_chain_at_zero_looks_ahead(self):
        rig = gazed.Rig("nao-v6")
        rig.mount_rotation_rad = np.zeros(3)
        pose = rig.cam_from_torso((0.0, 0.0))
        origin = -pose[:3, :3].T @ pose[:3, 3]
        np.testing.assert_allclose(origin, rig.neck_offset_m + rig.mount_offset_m, atol=POINT_TOLERANCE_M)
        np.testing.assert_allclose(pose[2, :3], (1, 0, 0), atol=POINT_TOLERANCE_M)  # the optical axis is the torso's x

    def test_two_looks_give_the_point_back(self):
        rig = gazed.Rig("nao-v6")
        for sigma in ("encoder_sigma_rad", "zero_sigma_rad", "focal_sigma_px", "centre_sigma_px", "mount_offset_sigma_m", "mount_rotation_sigma_rad"):
            setattr(rig, sigma, 0.0)
        rig.distortion_sigma = (0.0, 0.0)
        truth, looks = np.array((0.5, 0.05, 0.2)), ((0.0, 0.0), (0.3, -0.2))
        pixels = [rig.project(truth, look) for look in looks]
        for method in ("optimal", "lindstrom", "rectification"):
            point = rig.triangulate(looks[0], pixels[0], looks[1], pixels[1], method=method)
            self.assertEqual(point.status, "LOCATED", point)
            np.testing.assert_allclose(point.position_m, truth, atol=POINT_TOLERANCE_M)
            self.assertGreater(np.linalg.eigvalsh(point.covariance_m2).min(), 0)

    def test_what_is_unknown_says_so(self):
        rig = gazed.Rig()
        same = rig.triangulate((0.1, 0.1), (300, 200), (0.1, 0.1), (300, 200))
        self.assertEqual(same.status, "DEGENERATE")
        self.assertTrue(math.isnan(same.range_m) and same.reason)
        self.assertEqual(rig.triangulate((0, 0), (math.nan, 0), (0.3, 0), (1, 1)).status, "INVALID_INPUT")
        self.assertIsNone(rig.project((-1.0, 0.0, 0.0), (0.0, 0.0)))

    def test_misuse_is_refused(self):
        with self.assertRaisesRegex(ValueError, "'nao-v7' found; allowed: nao-v3"):
            gazed.Rig("nao-v7")
        with self.assertRaisesRegex(ValueError, "'left' found; allowed: top, bottom"):
            gazed.Rig("nao-v6", "left")
        with self.assertRaises(ValueError):
            gazed.Rig().cam_from_torso((math.nan, 0.0))
        with self.assertRaises(TypeError):
            gazed.Rig().cam_from_torso((0.0, 0.0, 0.0))
        with self.assertRaisesRegex(ValueError, "'guess' found; allowed: optimal"):
            gazed.Rig().triangulate((0, 0), (1, 1), (0.1, 0), (2, 2), method="guess")


class Types(unittest.TestCase):
    def test_messages_go_there_and_back(self):
        sent = gazed.fixation_t()
        look = gazed.look_t()
        look.corner_used = b""  # lcm-gen's own default, "", cannot be sent
        sent.status_name, sent.nlooks, sent.looks = "LOCATED", 1, [look]
        got = gazed.fixation_t.decode(sent.encode())
        self.assertEqual((got.status_name, len(got.looks)), ("LOCATED", 1))
        self.assertEqual(gazed.located_point_t.decode(gazed.located_point_t().encode()).reason, "")
        image = bot_core.image_t()
        image.data = b""
        self.assertEqual(bot_core.image_t.decode(image.encode()).width, 0)

    def test_all_is_named(self):
        for name in ("located_point_t", "status_t", "saliency", "Rig", "robots"):
            self.assertIn(name, gazed.__all__)


unittest.main()

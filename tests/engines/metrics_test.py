#!/usr/bin/env python3
"""Tests of metrics.py against published numbers and closed forms."""
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: python3-numpy is not installed")
    raise SystemExit(77)

import metrics

# Sharma, Wu and Dalal, 2005, table 1: L*, a*, b* of two colours and their CIEDE2000 difference.
SHARMA = """
50.0000 2.6772 -79.7751 50.0000 0.0000 -82.7485 2.0425
50.0000 3.1571 -77.2803 50.0000 0.0000 -82.7485 2.8615
50.0000 2.8361 -74.0200 50.0000 0.0000 -82.7485 3.4412
50.0000 -1.3802 -84.2814 50.0000 0.0000 -82.7485 1.0000
50.0000 -1.1848 -84.8006 50.0000 0.0000 -82.7485 1.0000
50.0000 -0.9009 -85.5211 50.0000 0.0000 -82.7485 1.0000
50.0000 0.0000 0.0000 50.0000 -1.0000 2.0000 2.3669
50.0000 -1.0000 2.0000 50.0000 0.0000 0.0000 2.3669
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0009 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0010 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0011 7.2195
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0012 7.2195
50.0000 -0.0010 2.4900 50.0000 0.0009 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0010 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0011 -2.4900 4.7461
50.0000 2.5000 0.0000 50.0000 0.0000 -2.5000 4.3065
50.0000 2.5000 0.0000 73.0000 25.0000 -18.0000 27.1492
50.0000 2.5000 0.0000 61.0000 -5.0000 29.0000 22.8977
50.0000 2.5000 0.0000 56.0000 -27.0000 -3.0000 31.9030
50.0000 2.5000 0.0000 58.0000 24.0000 15.0000 19.4535
50.0000 2.5000 0.0000 50.0000 3.1736 0.5854 1.0000
50.0000 2.5000 0.0000 50.0000 3.2972 0.0000 1.0000
50.0000 2.5000 0.0000 50.0000 1.8634 0.5757 1.0000
50.0000 2.5000 0.0000 50.0000 3.2592 0.3350 1.0000
60.2574 -34.0099 36.2677 60.4626 -34.1751 39.4387 1.2644
63.0109 -31.0961 -5.8663 62.8187 -29.7946 -4.0864 1.2630
61.2901 3.7196 -5.3901 61.4292 2.2480 -4.9620 1.8731
35.0831 -44.1164 3.7933 35.0232 -40.0716 1.5901 1.8645
22.7233 20.0904 -46.6940 23.0331 14.9730 -42.5619 2.0373
36.4612 47.8580 18.3852 36.2715 50.5065 21.2231 1.4146
90.8027 -2.0831 1.4410 91.1528 -1.6435 0.0447 1.4441
90.9257 -0.5406 -0.9208 88.6381 -0.8985 -0.7239 1.5381
6.7747 -0.2908 -2.4247 5.8714 -0.0985 -2.2286 0.6377
2.0776 0.0795 -1.1350 0.9033 -0.0636 -0.5514 0.9082
"""


def constant(colour, size=24):
    return np.tile(np.array(colour, dtype=float), (size, size, 1))


class Masks(unittest.TestCase):
    def test_intersection_over_union_counts_pixels(self):
        a = np.zeros((4, 4), bool)
        b = np.zeros((4, 4), bool)
        a[:2], b[1:3] = True, True
        self.assertAlmostEqual(metrics.intersection_over_union(a, b), 1 / 3)
        self.assertEqual(metrics.intersection_over_union(a & ~a, b & ~b), 1.0)

    def test_majority_is_strict(self):
        on, off = np.ones((1, 1), bool), np.zeros((1, 1), bool)
        self.assertFalse(metrics.majority([on, off])[0, 0])
        self.assertFalse(metrics.majority([on, on, off, off])[0, 0])
        self.assertTrue(metrics.majority([on, on, off])[0, 0])

    def test_erosion_takes_a_pixel_off_every_side(self):
        mask = np.zeros((9, 9), bool)
        mask[2:7, 3:8] = True
        expected = np.zeros((9, 9), bool)
        expected[3:6, 4:7] = True
        np.testing.assert_array_equal(metrics.erode(mask), expected)
        np.testing.assert_array_equal(metrics.dilate(expected), mask)


class Correlation(unittest.TestCase):
    def test_pearson_closed_forms(self):
        x = np.array([0.0, 1.0, 2.0, 4.0])
        self.assertAlmostEqual(metrics.pearson(x, 3 - 2 * x), -1)
        self.assertAlmostEqual(metrics.pearson(np.array([1.0, 0, -1, 0]), np.array([0.0, 1, 0, -1])), 0)
        self.assertTrue(np.isnan(metrics.pearson(x, np.ones(4))))

    def test_spearman_is_blind_to_a_monotone_curve(self):
        x = np.linspace(0.1, 3, 50)
        self.assertAlmostEqual(metrics.spearman(x, np.exp(x)), 1)
        self.assertLess(metrics.pearson(x, np.exp(x)), 0.99)

    def test_tied_ranks_share_their_mean(self):
        np.testing.assert_allclose(metrics.ranks(np.array([5.0, 1, 5, 9])), [1.5, 0, 1.5, 3])


class Colour(unittest.TestCase):
    def test_white_and_black_in_lab(self):
        np.testing.assert_allclose(metrics.lab_from_srgb(constant([1, 1, 1], 1))[0, 0], [100, 0, 0], atol=1e-9)
        np.testing.assert_allclose(metrics.lab_from_srgb(constant([0, 0, 0], 1))[0, 0], [0, 0, 0], atol=1e-9)

    def test_red_in_lab(self):
        lab = metrics.lab_from_srgb(constant([1, 0, 0], 1))[0, 0]
        np.testing.assert_allclose(lab, [53.24, 80.09, 67.20], atol=0.02)

    def test_ciede2000_on_the_published_pairs(self):
        table = np.array([line.split() for line in SHARMA.strip().splitlines()], dtype=float)
        self.assertEqual(table.shape, (34, 7))
        forward = metrics.ciede2000(table[:, :3], table[:, 3:6])
        np.testing.assert_allclose(forward, table[:, 6], atol=5.1e-5)
        np.testing.assert_allclose(metrics.ciede2000(table[:, 3:6], table[:, :3]), forward, atol=1e-9)


class Flip(unittest.TestCase):
    def setUp(self):
        generator = np.random.default_rng(7)
        self.a = generator.random((40, 52, 3))
        self.b = generator.random((40, 52, 3))

    def test_pixels_per_degree_of_the_paper(self):
        self.assertAlmostEqual(metrics.PIXELS_PER_DEGREE, 67.02, places=2)

    def test_equal_pictures(self):
        np.testing.assert_array_equal(metrics.flip(self.a, self.a), 0)

    def test_symmetric_and_bounded(self):
        ab = metrics.flip(self.a, self.b)
        np.testing.assert_allclose(ab, metrics.flip(self.b, self.a), atol=1e-12)
        self.assertGreater(ab.mean(), 0.05)
        self.assertLessEqual(ab.max(), 1)

    def test_green_against_blue_is_the_largest_difference(self):
        np.testing.assert_allclose(metrics.flip(constant([0, 1, 0]), constant([0, 0, 1])), 1, atol=1e-6)

    def test_constant_greys_follow_the_closed_form(self):
        # No chroma, no features: only the redistributed power of the difference in L*.
        lab = lambda v: metrics.lab_from_srgb(constant([v] * 3, 1))[0, 0, 0]
        green, blue = (metrics._hunt_lab(np.array(c, dtype=float)) for c in ([0, 1, 0], [0, 0, 1]))
        maximum = (abs(green[0] - blue[0]) + np.hypot(*(green - blue)[1:])) ** 0.7
        expected = 0.95 / (0.4 * maximum) * (lab(0.6) - lab(0.5)) ** 0.7
        np.testing.assert_allclose(metrics.flip(constant([0.5] * 3), constant([0.6] * 3)), expected, rtol=1e-7)

    def test_a_line_stands_out_more_than_its_blur(self):
        picture = constant([0.5] * 3, 64)
        sharp, blurred = picture.copy(), picture.copy()
        sharp[:, 32] = 1.0
        blurred[:, 22:43] += 0.5 / 21
        self.assertGreater(metrics.flip(picture, sharp).max(), 2 * metrics.flip(picture, blurred).max())

    def test_fine_chroma_noise_vanishes_from_afar(self):
        grey = constant([0.5] * 3, 64)
        noisy = grey.copy()
        noisy[::2, ::2, 2] += 0.2
        noisy[1::2, 1::2, 2] -= 0.2
        self.assertLess(metrics.flip(grey, noisy, 67).mean(), 0.5 * metrics.flip(grey, noisy, 10).mean())


if __name__ == "__main__":
    unittest.main()

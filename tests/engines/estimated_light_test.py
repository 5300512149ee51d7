#!/usr/bin/env python3
"""Tests of the light's estimate, with closed forms and with pictures whose light is known."""
import pathlib
import tempfile
import unittest

try:
    import estimated_light
    import metrics
    import numpy as np
except ImportError as error:
    print(f"skipped: python3-numpy is needed ({error})")
    raise SystemExit(77)


def encoded(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)


class EstimatedLight(unittest.TestCase):
    def test_the_tone_curve_is_inverted(self):
        light = np.random.default_rng(1).uniform(0.01, 1.5, (1000, 1)) * np.array([[1.0, 0.9, 0.8]])
        back = estimated_light.light_from_picture(encoded(estimated_light.aces(light)))
        np.testing.assert_allclose(back, light, rtol=1e-6)

    def test_bumps_add_up_to_one_and_peak_at_their_centres(self):
        shapes = estimated_light.bumps(60, (32, 64))
        np.testing.assert_allclose(shapes.sum(axis=0), 1, rtol=1e-12)
        row, column = np.unravel_index(shapes[30].argmax(), shapes[30].shape)
        polar, azimuth = (row + 0.5) / 32 * np.pi, (column + 0.5) / 64 * 2 * np.pi
        peak = [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)]
        self.assertGreater(np.dot(peak, estimated_light.centres(60)[30]), np.cos(np.radians(9)))

    def test_differences_of_equal_weights_vanish(self):
        matrix = estimated_light.differences(40)
        np.testing.assert_allclose(matrix @ np.ones(40), 0, atol=1e-12)
        self.assertGreater(np.linalg.eigvalsh(matrix)[1], 0.1)  # of no others

    def test_least_squares_obey_the_optimality_conditions(self):
        random = np.random.default_rng(2)
        a, b = random.normal(size=(50, 12)), random.normal(size=50)
        x = estimated_light.non_negative_least_squares(a.T @ a, a.T @ b, np.zeros(12), sweeps=5000, tolerance=1e-12)
        slope = a.T @ (a @ x - b)
        self.assertTrue((x >= 0).all() and (x > 0).any() and (x == 0).any())
        np.testing.assert_allclose(slope[x > 0], 0, atol=1e-8)
        self.assertTrue((slope[x == 0] >= -1e-8).all())

    def test_a_known_light_is_found_behind_saturated_pixels(self):
        random = np.random.default_rng(3)
        basis = random.uniform(0, 1, (30, 4000, 3)).astype(np.float32)
        weights = np.where(random.uniform(size=(30, 3)) < 0.5, 0, random.uniform(0, 3, (30, 3)))
        target = np.einsum("ipc,ic->pc", basis, weights)
        limit = np.percentile(target, 80)
        saturated = target > limit
        found = estimated_light.fit(basis, np.minimum(target, limit), saturated, smoothness=0)
        np.testing.assert_allclose(found, weights, atol=0.02)

    def test_radiance_files_hold_the_light(self):
        rgb = np.random.default_rng(4).uniform(0, 20, (8, 16, 3))
        rgb[0, 0] = 0
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "light.hdr"
            estimated_light.write_hdr(path, rgb)
            data = path.read_bytes()
        header, end = b"-Y 8 +X 16\n", data.index(b"-Y 8 +X 16\n")
        rgbe = np.frombuffer(data[end + len(header):], np.uint8).reshape(8, 16, 4).astype(float)
        read = rgbe[..., :3] * np.exp2(rgbe[..., 3:] - 136)
        self.assertTrue((np.abs(read - rgb) <= rgb.max(axis=-1, keepdims=True) / 127).all())

    def test_the_estimate_explains_a_picture_of_its_own_bumps(self):
        count, size = estimated_light.BUMPS, 48
        estimated_light.BUMPS = 20
        self.addCleanup(setattr, estimated_light, "BUMPS", count)
        shapes = estimated_light.bumps(20)
        rows = np.linspace(0, shapes.shape[1] - 1, size).astype(int)
        columns = np.linspace(0, shapes.shape[2] - 1, size).astype(int)

        def draw(index, environment):  # the scene is the environment itself
            del index
            return environment[rows][:, columns]

        light = np.einsum("i,ihw->hw", np.linspace(0.1, 0.8, 20), shapes)
        picture = encoded(estimated_light.aces(np.repeat(light[rows][:, columns][..., None], 3, axis=-1)))
        found = estimated_light.estimate([picture, picture], draw, lambda f, items: list(map(f, items)))
        np.testing.assert_allclose(found, np.repeat(light[..., None], 3, axis=-1), atol=0.03)
        self.assertEqual(metrics.spearman(light.ravel(), light.ravel()), 1.0)


if __name__ == "__main__":
    unittest.main()

"""Estimates the environment that lit the engines' pictures from one of them.

A picture in linear light is linear in its environment. facet draws the training scene once under each of many bumps of
light that cover the sphere; the weights, none negative, are those whose sum of pictures comes nearest to the engines'.
Only the light is fitted. A wrong shading cannot be made good by it in other scenes, whose surfaces differ.
"""
import math

import metrics
import numpy as np

BUMPS = 320  # about 11 degrees apart; more resolve finer reflections and take longer
SHAPE = (128, 256)  # rows and columns of an environment's picture
SMOOTHNESS = 3e-5  # weight of neighbouring bumps' differences: only against noise where nothing is seen
FLOOR = 0.05  # errors count relative to light of this much and more
SATURATED = 0.97  # encoded values that the tone curve is too flat to be inverted at
CELL = 2  # the training picture's pixels are averaged over squares of this side

# Stephen Hill's fit of the ACES transforms after a factor of 1/0.6, as the pictures' makers say and as facet has it.
ACES_INPUT = np.array([[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]])
ACES_OUTPUT = np.array([[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]])
ACES_FACTOR = 1 / 0.6
FIT = (0.0245786, -0.000090537, 0.983729, 0.4329510, 0.238081)  # (x (x + a) + b) / (x (c x + d) + e)


def aces(light):
    """Display-linear values in [0, 1] of linear light."""
    a, b, c, d, e = FIT
    x = light @ ACES_INPUT.T * ACES_FACTOR
    return np.clip((x * (x + a) + b) / (x * (c * x + d) + e) @ ACES_OUTPUT.T, 0, 1)


def light_from_picture(encoded):
    """Linear light of sRGB values: both curves inverted; what the curve cannot give comes out near."""
    a, b, c, d, e = FIT
    y = np.clip(metrics.linear_from_srgb(encoded.astype(np.float64)) @ np.linalg.inv(ACES_OUTPUT).T, 0, 1)
    square, linear, constant = 1 - c * y, a - d * y, b - e * y
    x = (np.sqrt(linear * linear - 4 * square * constant) - linear) / (2 * square)
    return np.maximum(x @ np.linalg.inv(ACES_INPUT).T / ACES_FACTOR, 0)


def centres(count):
    """Points spread evenly over the sphere: Fibonacci's spiral."""
    y = 1 - (2 * np.arange(count) + 1) / count
    azimuth = np.arange(count) * math.pi * (3 - math.sqrt(5))
    radius = np.sqrt(1 - y * y)
    return np.stack([radius * np.cos(azimuth), y, radius * np.sin(azimuth)], axis=-1)


def bumps(count, shape=SHAPE):
    """(count, rows, columns): equirectangular pictures of bumps around `centres`; they add up to 1 everywhere.

    Which way a picture's middle looks does not matter, as they are read and written the same way.
    """
    polar = (np.arange(shape[0]) + 0.5) / shape[0] * math.pi
    azimuth = (np.arange(shape[1]) + 0.5) / shape[1] * 2 * math.pi
    directions = np.stack(np.broadcast_arrays(np.sin(polar)[:, None] * np.cos(azimuth), np.cos(polar)[:, None],
                                              np.sin(polar)[:, None] * np.sin(azimuth)), axis=-1)
    values = np.exp(0.45 * count * (directions @ centres(count).T - 1))
    return np.moveaxis(values / values.sum(axis=-1, keepdims=True), -1, 0)


def differences(count):
    """The matrix whose quadratic form is the sum of squared differences of neighbouring bumps' weights."""
    near = np.argsort(-(centres(count) @ centres(count).T), axis=1)[:, 1:7]
    matrix = np.zeros((count, count))
    for i in range(count):
        for j in near[i]:
            matrix[[i, j], [i, j]] += 1
            matrix[[i, j], [j, i]] -= 1
    return matrix


def write_hdr(path, rgb):
    """Radiance RGBE, not compressed."""
    largest = rgb.max(axis=-1)
    mantissa, exponent = np.frexp(largest)
    factor = np.where(largest > 1e-30, mantissa * 256 / np.maximum(largest, 1e-30), 0)
    rgbe = np.zeros(rgb.shape[:2] + (4,), np.uint8)
    rgbe[..., :3] = np.minimum(rgb * factor[..., None], 255)
    rgbe[..., 3] = np.where(largest > 1e-30, exponent + 128, 0)
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {rgb.shape[0]} +X {rgb.shape[1]}\n"
    path.write_bytes(header.encode() + rgbe.tobytes())


def non_negative_least_squares(gram, moment, start, sweeps=300, tolerance=1e-4):
    """argmin of x' gram x / 2 - moment' x over x >= 0, by coordinate descent from `start`."""
    x = start.copy()
    slope = gram @ x - moment
    for _ in range(sweeps):
        largest = 0.0
        for i, row in enumerate(gram):
            change = max(x[i] - slope[i] / row[i], 0.0) - x[i]
            if change:
                slope += row * change
                x[i] += change
                largest = max(largest, abs(change))
        if largest <= tolerance:
            break
    return x


def fit(basis, target, saturated, smoothness=SMOOTHNESS):
    """Weights (bumps, 3) with which `basis` (bumps, pixels, 3) gives `target` (pixels, 3), or as much and more where
    that is `saturated` (pixels, 3)."""
    count = len(basis)
    penalty = differences(count)
    weights = np.zeros((count, 3))
    for c in range(3):
        scale = (1 / (target[:, c] + FLOOR)).astype(np.float32)
        rows = basis[..., c].astype(np.float32) * scale
        wanted = target[:, c].astype(np.float32) * scale
        bounds = saturated[:, c]
        known, above = rows[:, ~bounds], rows[:, bounds]
        gram = (known @ known.T).astype(np.float64)
        moment = (known @ wanted[~bounds]).astype(np.float64)
        gram += penalty * (smoothness * np.trace(gram) / count)
        x = np.zeros(count)
        for _ in range(6):  # bounds that are not reached pull like the others
            short = x @ above < wanted[bounds]
            pulled = above[:, short]
            x = non_negative_least_squares(gram + pulled @ pulled.T, moment + pulled @ wanted[bounds][short], x)
        weights[:, c] = x
    return weights


def averaged_cells(values):
    """Means over CELL x CELL pixels of (height, width, channels)."""
    height, width, channels = values.shape
    return values.reshape(height // CELL, CELL, width // CELL, CELL, channels).mean(axis=(1, 3))


def estimate(engines, draw, over_all):
    """The environment's picture, linear (rows, columns, 3), and the training picture it gives, linear.

    `engines`: RGB(A) pictures; `draw(index, environment)`: facet's linear RGB of the training scene under it, at the
    same size; `over_all(function, items)`: a map, in parallel or not.
    """
    shapes = bumps(BUMPS)
    light = [averaged_cells(light_from_picture(e[..., :3])) for e in engines]
    target = np.median(light, axis=0)
    clear = [averaged_cells((e[..., :3] < SATURATED).astype(np.float64)) for e in engines]
    saturated = np.median(clear, axis=0) < 1

    def draw_one(index):  # the brightest pixel 1, for facet's pictures end there
        peak = shapes[index].max()
        grey = np.repeat((shapes[index] / peak)[..., None], 3, axis=-1)
        return (averaged_cells(draw(index, grey)) * peak).astype(np.float32)

    basis = np.array(over_all(draw_one, range(BUMPS)))
    flat = basis.reshape(BUMPS, -1, 3)
    weights = fit(flat, target.reshape(-1, 3), saturated.reshape(-1, 3))
    return np.einsum("ic,ihw->hwc", weights, shapes)

#!/usr/bin/env python3
"""Prints what SheenLobe::Environment() (material/lobes/sheen-inl.h) is off, beside other approximations.

Points of white sheen, of seven roughnesses and seen at seven angles, under a sky: the light that each reflects by the
exact integral over the hemisphere, and by the albedo times one lookup of the prefiltered sky. Printed for each sky: the
root mean square error relative to the mean, weighted by the albedo. Skies are Radiance files (.hdr) that are named on
the command line; without any, random soft lamps in a grey sky. Needs numpy.
"""
import sys

import numpy as np

POINTS, ROWS = 60, 96
ROUGHNESS = (0.07, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0)
N_DOT_V = (0.02, 0.05, 0.1, 0.2, 0.35, 0.55, 0.8)
IN_USE = 0.4  # the length along the surface of the direction whose length along the normal is the roughness
MASKING_AT_ONE = np.array([21.5473, 3.82987, 0.19823, -1.97760, -4.32054])
MASKING_AT_ZERO = np.array([25.3245, 3.32435, 0.16801, -1.27393, -4.85967])


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def sphere_of_directions():
    theta = (np.arange(ROWS) + 0.5) / ROWS * np.pi
    phi = (np.arange(2 * ROWS) + 0.5) / ROWS * np.pi - np.pi
    ring = np.sin(theta)[:, None]
    d = np.stack([ring * np.cos(phi), np.cos(theta)[:, None] + 0 * phi, ring * np.sin(phi)], -1)
    return d.reshape(-1, 3), (ring + 0 * phi).ravel() * (np.pi / ROWS) ** 2


def read_radiance(path):
    """The luminance of a run-length encoded file, averaged to ROWS rows."""
    data = np.fromfile(path, np.uint8)
    start = data.tobytes().index(b"\n\n") + 2
    end = data.tobytes().index(b"\n", start)
    words = data[start:end].tobytes().split()
    height, width, at = int(words[1]), int(words[3]), end + 1
    rgbe = np.empty((height, 4, width), np.uint8)
    for row in rgbe:
        at += 4
        for channel in row:
            x = 0
            while x < width:
                count, at = int(data[at]), at + 1
                if count > 128:
                    channel[x : x + count - 128], x, at = data[at], x + count - 128, at + 1
                else:
                    channel[x : x + count], x, at = data[at : at + count], x + count, at + count
    scale = np.exp2(rgbe[:, 3].astype(float) - 136)
    image = (0.2126 * rgbe[:, 0] + 0.7152 * rgbe[:, 1] + 0.0722 * rgbe[:, 2]) * scale
    weight = np.broadcast_to(np.sin((np.arange(height) + 0.5) / height * np.pi)[:, None], image.shape)
    cell = (np.arange(height) * ROWS // height)[:, None], (np.arange(width) * 2 * ROWS // width)[None]
    total, weights = np.zeros((2, ROWS, 2 * ROWS))
    np.add.at(total, cell, image * weight)
    np.add.at(weights, cell, weight)
    return (total / weights).ravel()


def masking(cosine, alpha):
    smooth = (1 - alpha) ** 2
    a, b, c, d, e = MASKING_AT_ONE * (1 - smooth) + MASKING_AT_ZERO * smooth

    def exponent(x):
        return a / (1 + b * x**c) + d * x + e

    low = exponent(np.minimum(cosine, 0.5))
    return np.exp(np.where(cosine < 0.5, low, 2 * exponent(0.5) - exponent(np.minimum(1 - cosine, 0.5))))


def sheen(normal, view, light, alpha):
    """D V n_dot_l for one normal and view."""
    n_dot_v, n_dot_l = normal @ view, light @ normal
    above = n_dot_l > 0
    n_dot_l = np.where(above, n_dot_l, 1)
    cos2 = np.minimum((n_dot_v + n_dot_l) ** 2 / np.maximum(2 + 2 * light @ view, 1e-12), 1)
    d = (2 + 1 / alpha) / (2 * np.pi) * np.maximum(1 - cos2, 1e-300) ** (0.5 / alpha)
    return np.where(above, d / (4 * n_dot_v * (1 + masking(n_dot_v, alpha) + masking(n_dot_l, alpha))), 0)


def main():
    random = np.random.default_rng(1)
    light, solid_angle = sphere_of_directions()
    if len(sys.argv) > 1:
        names, skies = sys.argv[1:], np.stack([read_radiance(path) for path in sys.argv[1:]], 1)
    else:
        lamps, width = unit(random.normal(size=(6, 3))), np.radians(random.uniform(3, 20, 6))
        skies = np.exp((light @ lamps.T - 1) / width**2)
        skies = skies / (solid_angle @ skies) + 1 / (4 * np.pi)  # half of the light comes from all around
        names = [f"lamp of {angle:.0f} degrees" for angle in np.degrees(width)]
    power = solid_angle[:, None] * skies
    normal = unit(random.normal(size=(POINTS, 3)))
    tangent = unit(np.cross(normal, random.normal(size=(POINTS, 3))))

    def prefiltered(direction, roughness=1.0):  # of roughness 1: irradiance / pi
        cosine, alpha = np.clip(direction @ light.T, 0, None), roughness**2
        weight = cosine / ((0.5 + 0.5 * cosine) * (alpha**2 - 1) + 1) ** 2
        return (weight @ power) / (weight @ solid_angle)[:, None]

    sums, weights = {}, 0.0
    for roughness in ROUGHNESS:
        for n_dot_v in N_DOT_V:
            sin_v = np.sqrt(1 - n_dot_v**2)
            view = normal * n_dot_v + tangent * sin_v
            lobe = np.stack([sheen(n, v, light, roughness**2) for n, v in zip(normal, view)])
            albedo = (lobe @ solid_angle)[:, None]
            exact = (lobe @ power) / albedo

            def turned(length):
                return prefiltered(unit(normal * roughness + tangent * (length * sin_v)))

            def square(approximation):
                return ((approximation - exact) ** 2).mean(0) / exact.mean(0) ** 2

            squares = {
                "in use": square(turned(IN_USE)),
                "the best length": np.min([square(turned(x)) for x in np.arange(0, 1.6, 0.1)], 0),
                "irradiance on the surface": square(prefiltered(normal)),
                "irradiance towards the viewer": square(prefiltered(view)),
                "prefiltered, in the mirror": square(prefiltered(2 * n_dot_v * normal - view, roughness)),
            }
            weight = min(albedo.mean(), 1) ** 2
            weights += weight
            for name, value in squares.items():
                sums[name] = sums.get(name, 0) + weight * value
    print("skies:", ", ".join(names))
    for name, value in sums.items():
        print(f"{name:30s}", "  ".join(f"{error:.3f}" for error in np.sqrt(value / weights)))


if __name__ == "__main__":
    main()

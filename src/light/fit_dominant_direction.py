#!/usr/bin/env python3
"""Prints the weight of the normal in DominantDirection() (material/lobes/specular-inl.h), by roughness.

Spheres of white metal under skies of random soft lamps: the light that each point reflects by the exact integral over
the hemisphere, and by the split sum with the prefiltered sky read along mix(mirror, normal, t). Printed: the t with the
least root mean square error (over the sphere, the lamps and the views), that error and that of the mirror direction
(t = 0), both relative to the mean, and the same for the polynomial in use. Needs numpy.
"""
import numpy as np

LAMPS, POINTS, ROWS = 48, 160, 64
POLYNOMIAL = (1.5, 0.35, -0.95)  # of alpha^2, alpha^3, alpha^4


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def sphere_of_directions():
    theta = (np.arange(ROWS) + 0.5) / ROWS * np.pi
    phi = (np.arange(2 * ROWS) + 0.5) / ROWS * np.pi
    ring = np.sin(theta)[:, None]
    d = np.stack([ring * np.cos(phi), np.cos(theta)[:, None] + 0 * phi, ring * np.sin(phi)], -1)
    return d.reshape(-1, 3), (ring + 0 * phi).ravel() * (np.pi / ROWS) ** 2


def ggx(n_dot_h_squared, alpha):
    return alpha ** 2 / (np.pi * (n_dot_h_squared * (alpha ** 2 - 1) + 1) ** 2)


def main():
    random = np.random.default_rng(1)
    light, solid_angle = sphere_of_directions()
    lamps = unit(random.normal(size=(LAMPS, 3)))
    width = np.radians(random.uniform(3, 20, LAMPS))
    # Half of the light comes from the lamp, half from all around.
    sky = np.exp((light @ lamps.T - 1) / (width ** 2))
    sky = sky / (solid_angle @ sky) + 1 / (4 * np.pi)
    power = solid_angle[:, None] * sky
    k = np.arange(POINTS) + 0.5
    radius, turn = np.sqrt(k / POINTS * 0.98), k * 2.399963  # evenly over the disk that the eye sees
    normal = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - radius ** 2)], -1)
    view = np.array([0.0, 0.0, 1.0])
    n_dot_v = normal[:, 2:]
    mirror = 2 * n_dot_v * normal - view
    n_dot_l = np.clip(normal @ light.T, 0, None)
    n_dot_h = np.clip(normal @ unit(light + view).T, 0, 1)

    print("roughness  best t: error   mirror: error   in use: t, error")
    for roughness in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0):
        alpha = roughness ** 2
        smith = n_dot_l * np.sqrt(n_dot_v ** 2 * (1 - alpha ** 2) + alpha ** 2) + n_dot_v * np.sqrt(
            n_dot_l ** 2 * (1 - alpha ** 2) + alpha ** 2)
        lobe = ggx(n_dot_h ** 2, alpha) * 0.5 / np.maximum(smith, 1e-20) * n_dot_l
        exact, albedo = lobe @ power, (lobe @ solid_angle)[:, None]

        def error(t):
            cosine = np.clip(unit(mirror * (1 - t) + normal * t) @ light.T, 0, None)
            weight = cosine * ggx(0.5 + 0.5 * cosine, alpha)
            split_sum = (weight @ power) / (weight @ solid_angle)[:, None] * albedo
            return np.sqrt(((split_sum - exact) ** 2).mean()) / exact.mean()

        candidates = np.arange(0, 1.0001, 0.02)
        best = min(candidates, key=error)
        used = alpha ** 2 * np.polyval(POLYNOMIAL[::-1], alpha)
        print(f"{roughness:9.1f}  {best:.2f}: {error(best):.3f}     {error(0.0):.3f}           {used:.3f}, {error(used):.3f}")


if __name__ == "__main__":
    main()

"""Measures of how far two pictures are apart, with numpy alone.

Pictures are float arrays in [0, 1] of shape (height, width, 3), sRGB encoded unless a name says linear; masks are
boolean arrays of shape (height, width).
"""
import math

import numpy as np

# Rows give X, Y, Z of linear Rec. 709 red, green, blue under D65 (the exact fractions of the sRGB primaries).
XYZ_FROM_RGB = np.array([
    [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
    [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
    [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
])
RGB_FROM_XYZ = np.linalg.inv(XYZ_FROM_RGB)
WHITE_XYZ = XYZ_FROM_RGB.sum(axis=1)


# ---- Masks -----------------------------------------------------------------------------------------------------------

def intersection_over_union(a, b):
    """|a and b| / |a or b|; 1 where both are empty."""
    union = np.count_nonzero(a | b)
    return 1.0 if union == 0 else np.count_nonzero(a & b) / union


def majority(masks):
    """Covered where more than half of the masks are."""
    votes = np.sum([mask.astype(np.int32) for mask in masks], axis=0)
    return 2 * votes > len(masks)


def shift(mask, dy, dx):
    """The mask moved by (dy, dx) pixels, uncovered where nothing moves in."""
    moved = np.zeros_like(mask)
    height, width = mask.shape
    moved[max(dy, 0):height + min(dy, 0), max(dx, 0):width + min(dx, 0)] = \
        mask[max(-dy, 0):height + min(-dy, 0), max(-dx, 0):width + min(-dx, 0)]
    return moved


def dilate(mask, radius=1):
    """Covered where the square of half-width `radius` around a pixel touches the mask."""
    rows = np.any([shift(mask, d, 0) for d in range(-radius, radius + 1)], axis=0)
    return np.any([shift(rows, 0, d) for d in range(-radius, radius + 1)], axis=0)


def erode(mask, radius=1):
    """Covered where the whole square of half-width `radius` around a pixel is; pixels outside the picture count."""
    return ~dilate(~mask, radius)


# ---- Correlation -----------------------------------------------------------------------------------------------------

def pearson(a, b):
    """Pearson's correlation of two 1-D samples; nan where one of them is constant."""
    a = a - a.mean()
    b = b - b.mean()
    scale = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / scale if scale > 1e-12 * a.size else float("nan")


def ranks(values):
    """Ranks from 0, ties sharing their mean rank."""
    unique, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    del unique
    first = np.cumsum(counts) - counts
    return (first + (counts - 1) / 2.0)[inverse.ravel()]


def spearman(a, b):
    """Spearman's rank correlation: blind to any monotone curve, such as exposure or a tone curve."""
    return pearson(ranks(a), ranks(b))


# ---- Colour ----------------------------------------------------------------------------------------------------------

def linear_from_srgb(srgb):
    """IEC 61966-2-1 decoding."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((np.maximum(srgb, 0.04045) + 0.055) / 1.055) ** 2.4)


def xyz_from_linear(rgb):
    return rgb @ XYZ_FROM_RGB.T


def lab_from_linear(rgb):
    """CIELAB (1976) of linear Rec. 709 light; white is (1, 1, 1)."""
    ratio = xyz_from_linear(rgb) / WHITE_XYZ
    delta = 6.0 / 29.0
    f = np.where(ratio > delta**3, np.cbrt(ratio), ratio / (3 * delta**2) + 4.0 / 29.0)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], axis=-1)


def lab_from_srgb(srgb):
    return lab_from_linear(linear_from_srgb(srgb))


def ciede2000(lab1, lab2):
    """CIEDE2000 colour difference, kL = kC = kH = 1.

    Sharma, Wu and Dalal, 2005, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test Data,
    and Mathematical Observations", equations 2 to 22.
    """
    lightness1, a1, b1 = np.moveaxis(np.asarray(lab1, dtype=float), -1, 0)
    lightness2, a2, b2 = np.moveaxis(np.asarray(lab2, dtype=float), -1, 0)
    chroma_mean = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    g = 0.5 * (1 - np.sqrt(chroma_mean**7 / (chroma_mean**7 + 25.0**7)))
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    chroma1, chroma2 = np.hypot(a1, b1), np.hypot(a2, b2)
    hue1 = np.degrees(np.arctan2(b1, a1)) % 360
    hue2 = np.degrees(np.arctan2(b2, a2)) % 360
    achromatic = chroma1 * chroma2 == 0

    d_lightness = lightness2 - lightness1
    d_chroma = chroma2 - chroma1
    turn = hue2 - hue1
    turn = np.where(turn > 180, turn - 360, np.where(turn < -180, turn + 360, turn))
    turn = np.where(achromatic, 0.0, turn)
    d_hue = 2 * np.sqrt(chroma1 * chroma2) * np.sin(np.radians(turn / 2))

    lightness = (lightness1 + lightness2) / 2
    chroma = (chroma1 + chroma2) / 2
    total = hue1 + hue2
    near = np.abs(hue1 - hue2) <= 180 + 1e-9  # opposite hues stay so when rounded
    hue = np.where(near, total / 2, np.where(total < 360, (total + 360) / 2, (total - 360) / 2))
    hue = np.where(achromatic, total, hue)
    t = (1 - 0.17 * np.cos(np.radians(hue - 30)) + 0.24 * np.cos(np.radians(2 * hue))
         + 0.32 * np.cos(np.radians(3 * hue + 6)) - 0.20 * np.cos(np.radians(4 * hue - 63)))
    d_theta = 30 * np.exp(-(((hue - 275) / 25) ** 2))
    r_c = 2 * np.sqrt(chroma**7 / (chroma**7 + 25.0**7))
    s_l = 1 + 0.015 * (lightness - 50) ** 2 / np.sqrt(20 + (lightness - 50) ** 2)
    s_c = 1 + 0.045 * chroma
    s_h = 1 + 0.015 * chroma * t
    r_t = -np.sin(np.radians(2 * d_theta)) * r_c
    l, c, h = d_lightness / s_l, d_chroma / s_c, d_hue / s_h
    return np.sqrt(np.maximum(l * l + c * c + h * h + r_t * c * h, 0.0))


# ---- FLIP ------------------------------------------------------------------------------------------------------------

PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * math.pi / 180  # a 0.7 m wide screen of 3840 pixels seen from 0.7 m: 67.02


def _convolve(channel, kernel_x, kernel_y):
    """Separable correlation with odd kernels, borders repeated."""
    radius = len(kernel_x) // 2
    padded = np.pad(channel, radius, mode="edge")
    height, width = channel.shape
    rows = sum(weight * padded[:, i:i + width] for i, weight in enumerate(kernel_x))
    return sum(weight * rows[i:i + height, :] for i, weight in enumerate(kernel_y))


def _spatial_filter(ycxcz, pixels_per_degree):
    """Filters with the eye's contrast sensitivity (section 4.1.1 there); linear RGB clamped to [0, 1]."""
    terms = {  # a1, b1, a2, b2 of each opponent channel, table 1
        0: (1.0, 0.0047, 0.0, 1e-5),
        1: (1.0, 0.0053, 0.0, 1e-5),
        2: (34.1, 0.04, 13.5, 0.025),
    }
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi**2)) * pixels_per_degree)
    x = np.arange(-radius, radius + 1) / pixels_per_degree
    filtered = np.empty_like(ycxcz)
    for channel, (a1, b1, a2, b2) in terms.items():
        total, weight = 0.0, 0.0
        for a, b in ((a1, b1), (a2, b2)):
            if a == 0:
                continue
            kernel = np.exp(-math.pi**2 * x * x / b)
            scale = a * math.sqrt(math.pi / b)
            total = total + scale * _convolve(ycxcz[..., channel], kernel, kernel)
            weight += scale * kernel.sum() ** 2
        filtered[..., channel] = total / weight
    y = (filtered[..., 0] + 16) / 116
    xyz = np.stack([y + filtered[..., 1] / 500, y, y - filtered[..., 2] / 200], axis=-1) * WHITE_XYZ
    return np.clip(xyz @ RGB_FROM_XYZ.T, 0, 1)


def _hunt_lab(linear):
    """CIELAB whose chroma fades with lightness (Hunt effect)."""
    lab = lab_from_linear(linear)
    lab[..., 1:] *= 0.01 * lab[..., :1]
    return lab


def _hyab(lab1, lab2):
    difference = lab1 - lab2
    return np.abs(difference[..., 0]) + np.hypot(difference[..., 1], difference[..., 2])


def _features(lightness, pixels_per_degree):
    """Magnitudes of edges and of points (section 4.2 there)."""
    deviation = 0.5 * 0.082 * pixels_per_degree
    radius = math.ceil(3 * deviation)
    x = np.arange(-radius, radius + 1, dtype=float)
    gauss = np.exp(-x * x / (2 * deviation**2))
    magnitudes = []
    for along in (-x * gauss, (x * x / deviation**2 - 1) * gauss):
        # Positive and negative weights of the two-dimensional kernel each add up to 1.
        positive = along[along > 0].sum() * gauss.sum()
        negative = -along[along < 0].sum() * gauss.sum()
        along = np.where(along > 0, along / positive, along / negative)
        magnitudes.append(np.hypot(_convolve(lightness, along, gauss), _convolve(lightness, gauss, along)))
    return magnitudes


def flip(reference, test, pixels_per_degree=PIXELS_PER_DEGREE):
    """LDR-FLIP of two sRGB pictures: per pixel, 0 (equal) to 1.

    Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, 2020, "FLIP: A Difference Evaluator for
    Alternating Images".
    """
    colours, features = [], []
    for picture in (reference, test):
        ratio = xyz_from_linear(linear_from_srgb(np.clip(picture, 0, 1))) / WHITE_XYZ
        ycxcz = np.stack([116 * ratio[..., 1] - 16, 500 * (ratio[..., 0] - ratio[..., 1]),
                          200 * (ratio[..., 1] - ratio[..., 2])], axis=-1)
        colours.append(_hunt_lab(_spatial_filter(ycxcz, pixels_per_degree)))
        features.append(_features(ratio[..., 1], pixels_per_degree))

    q_c, p_c, p_t = 0.7, 0.4, 0.95
    power = _hyab(*colours) ** q_c
    extremes = [_hunt_lab(np.array(primary, dtype=float)) for primary in ([0, 1, 0], [0, 0, 1])]
    maximum = float(_hyab(*extremes)) ** q_c
    knee = p_c * maximum
    colour = np.where(power < knee, p_t / knee * power, p_t + (power - knee) / (maximum - knee) * (1 - p_t))

    (edges1, points1), (edges2, points2) = features
    feature = np.maximum(np.abs(edges1 - edges2), np.abs(points1 - points2))
    feature = np.clip((feature / math.sqrt(2)) ** 0.5, 0, 1)
    return colour ** (1 - feature)

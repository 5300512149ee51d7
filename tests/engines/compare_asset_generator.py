#!/usr/bin/env python3
"""Renders the models of glTF Asset Generator with facet and compares with their sample pictures.

The pictures were lit by an unknown environment, which also stands behind the models: they bound shape, texture and
transparency, not exact colour. Camera: the eye is the manifest's translation with x negated (the viewer's own space
was left-handed), it looks at the origin, the vertical field of view is 0.8 rad. Animations stand at time 0 of the
first one.

covers   share of the pixels that stand out from the background plate that facet covers, within 2 pixels; the plate is
         the picture of a wholly cut-out model ("-" for the cameras that have none)
rim      share of facet's silhouette that lies within 2 pixels of what stands out, or, without a plate, of an edge of
         the picture; what has the background's colour cannot stand out
light    Spearman's correlation of CIE L* inside, facet laid over the plate
detail   Pearson's correlation of L* less its local mean (13 x 13 pixels): texture, blind to smooth light
chroma   Pearson's correlation of a* and b*
through  how strongly the plate's gradients show inside, where facet expects (1 - alpha) of them: 1 agrees

Exit codes: 0 no outlier but the known ones, 1 otherwise, 77 skipped (no corpus, no program).
"""
import json
import math
import sys

from harness import (Sheets, corpus, in_parallel, need, number, over, parser, print_table, read_rgba, render, selected,
                     work_folder)
import numpy as np
import metrics

SIZE = 400
FOV_DEGREES = math.degrees(0.8)
PLATE_CAMERA = [0.0, 0.0, 1.3]
PLATE = "Material_AlphaMask_03"  # alpha below the cutoff everywhere: the bare background
LIMITS = {"covers": 0.98, "rim": 0.6, "light": None, "detail": 0.7, "chroma": 0.8, "through": (0.65, 1.35)}
UNKNOWN_LOOKS = "KHR_materials_pbrSpecularGlossiness"
# Refused by the specification's rules: a newer minor version, and a required extension that nobody has.
MAY_BE_REFUSED = ("Compatibility_",)


def arguments_of(model):
    x, y, z = model["camera"]["translation"]
    x = -x
    radius = math.sqrt(x * x + y * y + z * z)
    theta, phi = math.degrees(math.atan2(x, z)), math.degrees(math.acos(y / radius))
    path = corpus() / "asset-generator" / model["fileName"]
    arguments = [path, "--size", f"{SIZE}x{SIZE}", f"--orbit={theta:.9g},{phi:.9g},{radius:.9g}", "--target=0,0,0",
                 "--fov", f"{FOV_DEGREES:.9g}", "--samples", "8", "--tonemap", "none", "--background", "transparent",
                 # The pictures' light is brighter than the studio: mean radiance about 1 comes nearest.
                 "--environment-intensity", "1.54",
                 "--ignore-required-extensions"]
    if json.loads(path.read_text(encoding="utf-8")).get("animations"):
        arguments += ["--animation", "0", "--time", "0"]
    return arguments


def local_mean(values, mask, radius=6):
    """Mean of `values` over the masked pixels of a square around each pixel."""
    def box(channel):
        padded = np.pad(channel, radius + 1)[:-1, :-1].cumsum(0).cumsum(1)
        side = 2 * radius + 1
        return padded[side:, side:] - padded[:-side, side:] - padded[side:, :-side] + padded[:-side, :-side]
    return box(np.where(mask, values, 0.0)) / np.maximum(box(mask.astype(np.float64)), 1)


def gradients(values):
    """Central differences along x and y, with zero rims."""
    dx, dy = np.zeros_like(values), np.zeros_like(values)
    dx[:, 1:-1] = (values[:, 2:] - values[:, :-2]) / 2
    dy[1:-1] = (values[2:] - values[:-2]) / 2
    return dx, dy


def edges(picture, threshold):
    """Pixels where a channel changes by `threshold` and more between neighbours."""
    strongest = np.max([np.hypot(*gradients(picture[..., c].astype(np.float64))) for c in range(3)], axis=0)
    return strongest > threshold


def correlation(a, b, contrast):
    """Pearson's correlation, or nan where either sample's deviation is below `contrast`."""
    if a.size < 50 or a.std() < contrast or b.std() < contrast:
        return float("nan")
    return metrics.pearson(a, b)


def compare(ours, sample, plate, has_plate):
    """The measures of the docstring. `plate` is the background, or grey where it is not known."""
    alpha = ours[..., 3].astype(np.float64)
    covered = alpha >= 0.5
    touched = alpha > 0.05
    result = dict.fromkeys(LIMITS, float("nan"))
    difference = np.abs(sample - plate).max(axis=-1)
    seen = difference > 14 / 255
    if has_plate and not touched.any():
        result["covers"] = 1.0 if np.count_nonzero(seen) < 0.002 * seen.size else 0.0
        return result, seen
    rim = touched & ~metrics.erode(touched)
    rim[:2], rim[-2:], rim[:, :2], rim[:, -2:] = False, False, False, False
    if has_plate:
        result["covers"] = float(np.count_nonzero(seen & metrics.dilate(touched, 2)) / max(np.count_nonzero(seen), 1))
    if rim.any():
        support = difference > 8 / 255 if has_plate else edges(sample, 0.01)
        result["rim"] = float(np.count_nonzero(rim & metrics.dilate(support, 2)) / np.count_nonzero(rim))

    inner = metrics.erode(touched if has_plate else covered, 2)
    if np.count_nonzero(inner) < 100:
        return result, seen
    composed = over(ours, plate)
    lab_ours, lab_sample = (metrics.lab_from_srgb(p.astype(np.float64)) for p in (composed, sample))
    light = [lab[..., 0][inner] for lab in (lab_ours, lab_sample)]
    if min(light[0].std(), light[1].std()) > 0.5:
        result["light"] = metrics.spearman(*light)
    detail = [(lab[..., 0] - local_mean(lab[..., 0], inner))[inner] for lab in (lab_ours, lab_sample)]
    result["detail"] = correlation(*detail, contrast=1.0)
    chroma = [(lab[..., 1:] - lab[..., 1:][inner].mean(axis=0))[inner].ravel() for lab in (lab_ours, lab_sample)]
    result["chroma"] = correlation(*chroma, contrast=5.0)

    glassy = inner & (alpha < 0.95)
    if has_plate and np.count_nonzero(glassy) > 0.02 * glassy.size:
        steep = glassy & edges(plate, 0.01)
        expected = np.concatenate([((1 - alpha) * g)[steep] for g in gradients(plate.mean(axis=-1).astype(np.float64))])
        found = np.concatenate([g[steep] for g in gradients(sample.mean(axis=-1).astype(np.float64))])
        if expected @ expected > 0:
            result["through"] = float(found @ expected / (expected @ expected))
    return result, seen


def outliers(result, shape_only):
    names = []
    for name, limit in LIMITS.items():
        value = result.get(name, float("nan"))
        if limit is None or value != value or (shape_only and name not in ("covers", "rim")):
            continue
        if (value < limit) if not isinstance(limit, tuple) else not limit[0] <= value <= limit[1]:
            names.append(name)
    return names


def main():
    options = parser(__doc__).parse_args()
    folder = corpus() / "asset-generator"
    need(folder / "Manifest.json")
    if not options.reuse:
        need(options.facet)
    groups = json.loads((folder / "Manifest.json").read_text(encoding="utf-8"))
    models = [m for g in groups for m in g["models"] if selected(m["fileName"], options.only)]
    plate_picture = read_rgba(folder / "SampleImages" / f"{PLATE}.jpg")[..., :3]
    work, temporary = work_folder(options)
    sheets = Sheets(options, "facet and the pictures of glTF Asset Generator")

    def evaluate(model):
        name = model["fileName"].rsplit(".", 1)[0]
        entry = {"name": name, "outliers": []}
        picture = work / f"{name}.png"
        if not (options.reuse and picture.exists()):
            error = render(options.facet, arguments_of(model), picture)
            if error:
                entry["note"] = error
                if not name.startswith(MAY_BE_REFUSED):
                    entry["outliers"] = ["failed"]
                return entry
        if "sampleImageName" not in model:
            entry["note"] = "renders; no picture to compare with"
            return entry
        ours = read_rgba(picture)
        sample = read_rgba(folder / model["sampleImageName"])[..., :3]
        has_plate = model["camera"]["translation"] == PLATE_CAMERA
        plate = plate_picture if has_plate else np.full_like(sample, 0.6)
        result, seen = compare(ours, sample, plate, has_plate)
        used = json.loads((folder / model["fileName"]).read_text(encoding="utf-8")).get("extensionsUsed", [])
        entry.update(result)
        entry["outliers"] = outliers(result, UNKNOWN_LOOKS in used)
        entry["note"] = " ".join(entry["outliers"] + (["(shape only)"] if UNKNOWN_LOOKS in used else []))
        if sheets.wanted():
            composed = over(ours, plate)
            touched = ours[..., 3] > 0.02
            panels = [("sample", sample), ("facet", composed), ("difference x 2", np.abs(composed - sample) * 2)]
            if has_plate:
                panels.append(("red extra, blue missing",
                               np.stack([touched & ~seen, touched & seen, seen & ~touched], axis=-1) * 1.0))
            sheets.add(name, panels, entry["note"])
        return entry

    results = in_parallel(evaluate, models, options.jobs)
    print_table(["model"] + list(LIMITS) + ["note"],
                [[r["name"]] + [number(r.get(key), "{:.3f}") for key in LIMITS] + [r.get("note", "")]
                 for r in results])
    wrong = [r for r in results if r["outliers"]]
    print(f"\n{len(results)} models, {len(wrong)} outliers")
    for r in wrong:
        print(f"  {r['name']}: {r['note']}")
    sheets.write()
    if options.json:
        options.json.write_text(json.dumps({"models": results}, indent=1), encoding="utf-8")
    del temporary
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

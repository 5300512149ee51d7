#!/usr/bin/env python3
"""Renders the reference scenes of the corpus with facet and compares with the pictures of other engines.

Shape: intersection over union (IoU) of the coverage mask (alpha of a half and more) with the strict majority of the
engines' masks. An engine's own IoU is against the same majority, itself included. Pixels that facet covers by exactly
a half have no right answer: they count as the majority says (the JSON has the figure without this as well).
Luminance: Pearson's and Spearman's correlation of CIE L* of two pictures in the pixels that both and the majority
cover, less a rim of one pixel. Spearman's is blind to exposure and tone curve. A picture's figure is its median over
the (other) engines. The target: the median of facet's figures over the scenes judged is at least the lowest
engine's median over them; and so is facet's figure of DamagedHelmet, the only scene whose environment is at hand.
Light: the environment of all other scenes cannot be had, so it is estimated from the engines' pictures of one training
scene, MetalRoughSpheresNoTextures (estimated_light.py), anew each time, or read from --work where it was left. The
scenes judged are held out: none of their pictures has a part in the estimate. They are those without a skybox whose
materials use no extension that facet does not have; the training scene has a skybox. Its own figures, set apart in the
tables, say how well the light could be fitted and nothing more. --studio lights with facet's own studio instead: fast,
but then luminance is not judged.
Colour, DamagedHelmet: mean CIEDE2000 inside the shared mask, and mean FLIP over the union of all masks, before black.

A run takes two to three minutes on two cores, of which the light is half.

Exit codes: 0 the targets are met, 1 they are missed or a scene failed, 77 skipped (no corpus, no program).
"""
import csv
import hashlib
import itertools
import json
import math
import pathlib
import struct
import sys

from harness import (Sheets, averaged, corpus, in_parallel, need, number, over, parser, print_table, read_rgba, render,
                     selected, work_folder)
import estimated_light
import metrics
import numpy as np

TARGET_IOU = 0.995
ALLOWED_MISSES = 1  # of the scenes shown without a skybox
COVERED = 0.5
# Half a pixel in 8 bits is 127 or 128.
TIE = 1.01 / 255
# The engines' pictures were drawn at the size of SCENES.tsv or a multiple of it, then averaged to 512 pixels a row; so
# are facet's. At 512 pixels, 8 samples leave many pixels of a silhouette exactly half covered.
SUPERSAMPLING = 2
TRAINING_SCENE = "MetalRoughSpheresNoTextures"  # smooth to rough spheres: all of the light is seen in them
# The built-in studio, turned and dimmed to light the scenes from about where the engines' environment does.
STUDIO = ["--environment-rotation", "135", "--environment-intensity", "0.5"]
COLOUR_SCENE = "DamagedHelmet"
# Extensions that change the look of a surface and that facet has; scenes with others count for their shape.
LOOKS_KNOWN = {"KHR_materials_" + name for name in (
    "anisotropy", "clearcoat", "diffuse_transmission", "dispersion", "emissive_strength", "ior", "iridescence",
    "pbrSpecularGlossiness", "sheen", "specular", "transmission", "unlit", "variants", "volume")}


def gltf_json(path):
    data = path.read_bytes()
    if data[:4] == b"glTF":
        length = struct.unpack_from("<I", data, 12)[0]
        data = data[20:20 + length]
    return json.loads(data)


def unknown_looks(path):
    used = gltf_json(path).get("extensionsUsed", [])
    return sorted(name for name in used if name.startswith("KHR_materials_") and name not in LOOKS_KNOWN)


def own_environment(scene):
    """The scene's environment, or None where the corpus lacks it."""
    path = corpus() / "environments" / scene["environment"]
    return path if path.exists() else None


def arguments_of(scene, light):
    """facet's arguments for a line of SCENES.tsv; `light` are those that light it."""
    root = corpus()
    target = [float(scene[f"target_{axis}"]) for axis in "xyz"]
    radius = float(scene["radius"])
    if radius == 0:  # the eye is at the target itself: look at a point straight ahead instead
        theta, phi, radius = math.radians(float(scene["theta_deg"])), math.radians(float(scene["phi_deg"])), 0.01
        back = (math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta))
        target = [t - radius * b for t, b in zip(target, back)]
    size = "x".join(str(SUPERSAMPLING * int(scene[side])) for side in ("width", "height"))
    arguments = [root / scene["model"], "--size", size,
                 f"--orbit={scene['theta_deg']},{scene['phi_deg']},{radius}",
                 "--target=" + ",".join(f"{t:.9g}" for t in target), "--fov", scene["vfov_deg"],
                 "--samples", "8", "--tonemap", "aces", "--ignore-required-extensions", "--background",
                 "environment" if scene["skybox"] == "yes" else "transparent"]
    return arguments + light


def estimate_light(scene, engines, options, work):
    """The file of the environment estimated from the training `scene`, made where --work has none of this program."""
    program = options.facet.read_bytes() if options.facet.exists() else b""
    recipe = pathlib.Path(estimated_light.__file__).read_bytes()
    path = work / f"estimated-light-{hashlib.sha256(program + recipe).hexdigest()[:12]}.hdr"
    if path.exists():
        return path
    left = sorted(work.glob("estimated-light-*.hdr"))
    if options.reuse and left:
        return left[-1]
    height, width = engines[0].shape[:2]

    def draw(index, environment):
        light, picture = work / f"bump-{index}.hdr", work / f"bump-{index}.png"
        estimated_light.write_hdr(light, environment)
        arguments = arguments_of(scene, ["--environment", light, "--threads", "1"])
        for option, value in (("--size", f"{width}x{height}"), ("--samples", "1"), ("--tonemap", "none")):
            arguments[arguments.index(option) + 1] = value
        error = render(options.facet, arguments, picture)
        if error:
            raise SystemExit(f"{scene['name']}: {error}")
        linear = metrics.linear_from_srgb(read_rgba(picture)[..., :3].astype(np.float64))
        light.unlink()
        picture.unlink()
        return linear

    environment = estimated_light.estimate(engines, draw, lambda f, items: in_parallel(f, items, options.jobs))
    estimated_light.write_hdr(path, environment)
    return path


def lightness(picture):
    return metrics.lab_from_srgb(picture[..., :3].astype(np.float64))[..., 0]


def median(values):
    values = [v for v in values if v == v]
    return float(np.median(values)) if values else float("nan")


def inside(*masks):
    """The pixels that all masks cover, less a rim of one pixel where enough remain."""
    shared = np.all(masks, axis=0)
    inner = metrics.erode(shared)
    return inner if np.count_nonzero(inner) >= 200 else shared


def correlations(pictures, masks, crowd):
    """{(a, b): (Pearson, Spearman)} of the lightness of every two pictures."""
    light = {name: lightness(picture) for name, picture in pictures.items()}
    pairs = {}
    for a, b in itertools.combinations(pictures, 2):
        mask = inside(masks[a], masks[b], crowd)
        pairs[(a, b)] = (float("nan"),) * 2
        if np.count_nonzero(mask) >= 50:
            samples = light[a][mask], light[b][mask]
            pairs[(a, b)] = metrics.pearson(*samples), metrics.spearman(*samples)
    return pairs


def summary(name, pairs, against, kind):
    """(min, median, mean, max) of a picture's correlations with those named in `against`."""
    values = [pairs[(a, b)][kind] for a, b in pairs if (a == name and b in against) or (b == name and a in against)]
    values = [v for v in values if v == v]
    if not values:
        return dict.fromkeys(("min", "median", "mean", "max"), float("nan"))
    return {"min": min(values), "median": median(values), "mean": sum(values) / len(values), "max": max(values)}


def colour_distances(pictures, shared, union):
    """{(a, b): (mean CIEDE2000, mean FLIP)} of every two pictures."""
    lab = {name: metrics.lab_from_srgb(p[..., :3].astype(np.float64)) for name, p in pictures.items()}
    flat = {name: over(p, [0, 0, 0]).astype(np.float64) for name, p in pictures.items()}
    return {(a, b): (float(metrics.ciede2000(lab[a][shared], lab[b][shared]).mean()),
                     float(metrics.flip(flat[a], flat[b])[union].mean()))
            for a, b in itertools.combinations(pictures, 2)}


def compare(scene, engines, ours, sheets):
    """All numbers of one scene. `engines`: {name: RGBA}; `ours`: RGBA, or None where only the engines are wanted."""
    skybox = scene["skybox"] == "yes"
    result = {"name": scene["name"], "skybox": skybox, "engines": {}, "facet": {},
              "unknown_looks": unknown_looks(corpus() / scene["model"]),
              "own_light": own_environment(scene) is not None, "training": scene["name"] == TRAINING_SCENE}
    pictures = dict(engines)
    if ours is not None:
        pictures["facet"] = ours
    if skybox:
        masks = {name: np.ones(p.shape[:2], bool) for name, p in pictures.items()}
        crowd = next(iter(masks.values()))
    else:
        masks = {name: p[..., 3] >= COVERED for name, p in pictures.items()}
        crowd = metrics.majority([masks[name] for name in engines])
        if ours is not None:
            result["facet"]["iou_ties_covered"] = float(metrics.intersection_over_union(masks["facet"], crowd))
            tie = np.abs(ours[..., 3] - 0.5) <= TIE
            masks["facet"] = np.where(tie, crowd, masks["facet"])
        for name, mask in masks.items():
            entry = result["facet"] if name == "facet" else result["engines"].setdefault(name, {})
            entry["iou"] = float(metrics.intersection_over_union(mask, crowd))
        for name in engines:  # against the others alone
            others = metrics.majority([masks[other] for other in engines if other != name])
            result["engines"][name]["iou_others"] = float(metrics.intersection_over_union(masks[name], others))

    pairs = correlations(pictures, masks, crowd)
    for name in pictures:
        others = [other for other in engines if other != name]
        entry = result["facet"] if name == "facet" else result["engines"].setdefault(name, {})
        entry["pearson"] = summary(name, pairs, others, 0)
        entry["spearman"] = summary(name, pairs, others, 1)
    if ours is not None:
        result["luminance_ok"] = {
            kind: bool(result["facet"][kind]["median"]
                       >= min(result["engines"][e][kind]["median"] for e in engines))
            for kind in ("pearson", "spearman")}
    if scene["name"] == COLOUR_SCENE:
        union = np.any(list(masks.values()), axis=0)
        distances = colour_distances(pictures, inside(*masks.values()), union)
        result["colour"] = [{"a": a, "b": b, "ciede2000": d[0], "flip": d[1]} for (a, b), d in distances.items()]

    if sheets.wanted():
        grey = 0.5
        panels = [(f"{name} {number(result['engines'][name].get('iou'))}", over(p, [grey] * 3))
                  for name, p in engines.items()]
        if ours is not None:
            panels.append((f"facet {number(result['facet'].get('iou'))}", over(ours, [grey] * 3)))
            if not skybox:
                wrong = np.stack([masks["facet"] & ~crowd, crowd & masks["facet"], crowd & ~masks["facet"]], axis=-1)
                panels.append(("mask: red extra, blue missing", wrong * np.array([1.0, 0.5, 1.0])))
        sheets.add(scene["name"], panels, ", ".join(result["unknown_looks"]))
    return result


def mean_of_others(distances, name, engines, key):
    values = [d[key] for d in distances if name in (d["a"], d["b"]) and {d["a"], d["b"]} - {name} <= set(engines)]
    return sum(values) / len(values)


def report_luminance(results, engine_names, with_facet, judged):
    """Prints the luminance tables; returns what is missed. `judged`: whether facet's light is the engines'."""
    missed = []
    looks = [r for r in results if not r["skybox"] and not r["unknown_looks"] and not r["training"]]
    training = [r for r in results if r["training"]] if judged else []
    pictures = (["facet"] if with_facet else []) + engine_names

    def medians(scenes, kind):
        figures = {name: [(r["facet"] if name == "facet" else r["engines"][name])[kind]["median"]
                          for r in scenes if name == "facet" or name in r["engines"]] for name in pictures}
        return {name: median(values) for name, values in figures.items()}

    for title, scenes in (("held out", looks), ("training, not judged", training)):
        if not scenes:
            continue
        print(f"\nLuminance, {title}: median over {len(scenes)} scene(s) of each picture's median correlation with "
              "the (other) engines")
        middles = {kind: medians(scenes, kind) for kind in ("spearman", "pearson")}
        print_table(["picture", "Spearman", "Pearson"],
                    [[name] + [number(middles[kind][name], "{:.3f}") for kind in middles] for name in pictures])
        if not with_facet or scenes is not looks:
            continue
        level = [r["name"] for r in looks if r["luminance_ok"]["spearman"]]
        print(f"facet at or above the lowest engine in {len(level)} of {len(looks)} scenes; below in: "
              + (", ".join(r["name"] for r in looks if r["name"] not in level) or "none"))
        ours, lowest = middles["spearman"]["facet"], min(middles["spearman"][e] for e in engine_names)
        verdict = f"facet's median {ours:.3f}, the lowest engine's {lowest:.3f}"
        if not judged:
            print(f"luminance: not judged under the studio's light ({verdict})")
        elif ours >= lowest:
            print(f"luminance: met ({verdict})")
        else:
            print(f"luminance: NOT met ({verdict})")
            missed.append(f"luminance: {verdict}")
        for r in looks:
            if r["own_light"] and not r["luminance_ok"]["spearman"]:
                missed.append(f"luminance of {r['name']}: Spearman {r['facet']['spearman']['median']:.3f} is below "
                              "every engine's")
    return missed


def report(results, with_facet, judged):
    """Prints the tables; returns what is missed, as sentences."""
    missed = []
    engine_names = sorted({name for r in results for name in r["engines"]})
    short = {"blender-cycles": "blender", "three-gpu-pathtracer": "three-pt", "gltf-sample-viewer": "khronos",
             "model-viewer": "modelv"}
    header = ["scene"] + (["IoU"] if with_facet else []) + [short.get(e, e) for e in engine_names]
    header += (["Spearman", "Pearson"] if with_facet else []) + ["engines' Spearman", "engines' Pearson", "note"]
    rows = []
    for r in results:
        row = [r["name"]]
        if r.get("error"):
            rows.append(row + ["FAILED"] + [""] * (len(header) - 3) + [r["error"]])
            missed.append(f"{r['name']}: {r['error']}")
            continue
        notes = [word for word, holds in (("skybox", r["skybox"]), ("TRAINING", r["training"])) if holds]
        if with_facet:
            row.append(number(r["facet"].get("iou")))
            if r["facet"].get("iou", 1) < TARGET_IOU:
                notes.append("IoU")
            if r.get("luminance_ok") and not r["luminance_ok"]["spearman"]:
                notes.append("luminance")
        row += [number(r["engines"].get(e, {}).get("iou")) for e in engine_names]
        if with_facet:
            row += [number(r["facet"].get(kind, {}).get("median"), "{:.3f}") for kind in ("spearman", "pearson")]
        for kind in ("spearman", "pearson"):
            medians = [v[kind]["median"] for v in r["engines"].values() if kind in v]
            medians = [m for m in medians if m == m]
            row.append(f"{min(medians):.3f}..{max(medians):.3f}" if medians else "-")
        notes += [name.replace("KHR_materials_", "+") for name in r["unknown_looks"]]
        rows.append(row + [" ".join(notes)])
    print_table(header, rows)

    good = [r for r in results if not r.get("error")]
    shapes = [r for r in good if not r["skybox"]]
    print("\nShape: scenes without a skybox with IoU >= %.3f, and the median IoU" % TARGET_IOU)
    lines = []
    for name in (["facet"] if with_facet else []) + engine_names:
        values = [r["facet"]["iou"] if name == "facet" else r["engines"][name]["iou"]
                  for r in shapes if name == "facet" or name in r["engines"]]
        if values:
            lines.append([name, f"{sum(v >= TARGET_IOU for v in values)} of {len(values)}", number(median(values))])
    print_table(["picture", "reached", "median"], lines)
    if with_facet:
        failed = sum(1 for r in results if r.get("error") and not r["skybox"])
        below = [r["name"] for r in shapes if r["facet"]["iou"] < TARGET_IOU]
        if len(below) + failed > ALLOWED_MISSES:
            missed.append(f"shape: {len(below) + failed} scenes below {TARGET_IOU}: " + ", ".join(below))

    missed += report_luminance(good, engine_names, with_facet, judged)

    for r in good:
        if "colour" not in r:
            continue
        print(f"\nColour of {r['name']}: mean distance to the (other) engines, and to each")
        engines = sorted(r["engines"])
        names = (["facet"] if with_facet else []) + engines
        means = {key: {n: mean_of_others(r["colour"], n, engines, key) for n in names} for key in ("ciede2000", "flip")}
        lines = []
        for name in names:
            row = [name]
            for key, form in (("ciede2000", "{:.2f}"), ("flip", "{:.4f}")):
                row.append(number(means[key][name], form))
                for other in engines:
                    pair = [d[key] for d in r["colour"] if {d["a"], d["b"]} == {name, other}]
                    row.append(number(pair[0] if pair else None, form))
            lines.append(row)
        print_table(["picture", "CIEDE2000"] + [short.get(e, e) for e in engines] + ["FLIP"]
                    + [short.get(e, e) for e in engines], lines)
        if with_facet:
            for key in means:
                worst = max(v for k, v in means[key].items() if k != "facet")
                best = min(v for k, v in means[key].items() if k != "facet")
                print(f"{key}: facet {means[key]['facet']:.4f}, engines {best:.4f} to {worst:.4f}")
                if means[key]["facet"] > worst:
                    missed.append(f"{r['name']}: mean {key} {means[key]['facet']:.4f}, the engines' worst {worst:.4f}")
    return missed


def main():
    p = parser(__doc__)
    p.add_argument("--engines-only", action="store_true", help="compare the engines with each other, without facet")
    p.add_argument("--studio", action="store_true", help="light with facet's studio; luminance is not judged")
    options = p.parse_args()
    folder = corpus() / "references"
    need(folder / "SCENES.tsv")
    if not options.engines_only and not options.reuse:
        need(options.facet)
    with open(folder / "SCENES.tsv", newline="", encoding="utf-8") as table:
        listed = list(csv.DictReader(table, delimiter="\t"))
    scenes = [s for s in listed if selected(s["name"], options.only)]
    work, temporary = work_folder(options)
    sheets = Sheets(options, "facet and the other engines")

    def engines_of(scene):
        return {e: read_rgba(folder / scene["name"] / f"{e}.webp") for e in scene["renders"].split(",")}

    light = STUDIO
    if not options.engines_only and not options.studio and not all(map(own_environment, scenes)):
        training = next(s for s in listed if s["name"] == TRAINING_SCENE)
        light = ["--environment", estimate_light(training, list(engines_of(training).values()), options, work)]

    def evaluate(scene):
        engines = engines_of(scene)
        ours = None
        if not options.engines_only:
            height, width = next(iter(engines.values())).shape[:2]
            picture = work / f"{scene['name']}.png"
            own = own_environment(scene)
            scene_light = ["--environment", own] if own else light
            if not (options.reuse and picture.exists()):
                error = render(options.facet, arguments_of(scene, scene_light), picture)
                if error:
                    return {"name": scene["name"], "skybox": scene["skybox"] == "yes", "engines": {}, "error": error,
                            "training": scene["name"] == TRAINING_SCENE}
            ours = averaged(read_rgba(picture), width, height)
        return compare(scene, engines, ours, sheets)

    results = in_parallel(evaluate, scenes, options.jobs)
    missed = report(results, not options.engines_only, not options.studio)
    sheets.write()
    if options.json:
        options.json.write_text(json.dumps({"scenes": results, "missed": missed}, indent=1), encoding="utf-8")
    del temporary
    print("\nTargets: " + ("met" if not missed else "MISSED\n  " + "\n  ".join(missed)))
    return 1 if missed and not options.engines_only else 0


if __name__ == "__main__":
    sys.exit(main())

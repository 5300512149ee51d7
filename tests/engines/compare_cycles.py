#!/usr/bin/env python3
"""Compares facet's exact reference, and its renderer, with Blender's path tracer Cycles (3.4 or newer 3.x).

Direct light only, as facet draws it: no bounces, and nothing in the scene shadows or mirrors anything else in it. The
bundled material grid under a photographed environment of the corpus and under one sun, the same with black base colour
(what remains of its dielectrics is their specular reflection) and with white (its metals reflect all there is), and
the bundled room by its own lights, the spot without its soft rim. Both programs look through the same camera node;
Cycles' materials are made of the same numbers. Its Principled BSDF has Disney's diffuse reflection; "principled"
leaves it, everything else has Lambert's in its place.

The tables: Cycles' luminance over the reference's, and the root of the mean square difference relative to the
reference's root of the mean square, both over the pixels that are covered in full, less a rim of one pixel. Noise is
what two Cycles pictures of different seeds and the reference's own batches say.

Needs blender with its glTF add-on, and `reference_film`, which is built with the tests. Not part of ctest: nothing is
judged. Exit codes: 0 done, 1 a program failed, 77 skipped (no blender, no program, no corpus).
"""
import json
import math
import pathlib
import shutil
import struct
import subprocess

from harness import ROOT, SKIP, Sheets, corpus, need, number, parser, print_table, render, selected, work_folder
import metrics
import numpy as np

ENVIRONMENT = "aircraft_workshop_01_1k.hdr"
SUN = {"type": "directional", "intensity": 3.0, "name": "sun"}
SUN_ROTATION = [-0.2016, 0.2016, 0.0, 0.9585]
GRID_HALF_HEIGHT = 8.1
# Name, file, environment, what is changed, materials in Cycles, pixels, the least roughness compared, and which of the
# metalnesses. Under a sun facet widens highlights of roughness 0, which Cycles leaves out, and small ones are a matter
# of samples.
SCENES = [
    ("grid, environment", "material_grid", True, "", "lambert", (168, 168), 0.0, (0, 1)),
    ("grid, environment, principled", "material_grid", True, "", "principled", (168, 168), 0.0, (0, 1)),
    ("grid, environment, black dielectrics", "material_grid", True, "black", "lambert", (168, 168), 0.0, (0, 0)),
    ("grid, environment, white metals", "material_grid", True, "white", "lambert", (168, 168), 0.0, (1, 1)),
    ("grid, sun", "material_grid", False, "sun", "lambert", (168, 168), 0.3, (0, 1)),
    ("grid, sun, principled", "material_grid", False, "sun", "principled", (168, 168), 0.3, (0, 1)),
    ("grid, sun, black dielectrics", "material_grid", False, "sun black", "lambert", (168, 168), 0.3, (0, 0)),
    ("grid, sun, white metals", "material_grid", False, "sun white", "lambert", (168, 168), 0.3, (1, 1)),
    ("room, own lights", "room", False, "", "lambert", (160, 160), 0.0, (0, 1)),
    ("room, own lights, principled", "room", False, "", "principled", (160, 160), 0.0, (0, 1)),
]


def read_glb(path):
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[20 + length:]


def write_glb(path, scene, chunks):
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    header = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(chunks), len(text), 0x4E4F534A)
    path.write_bytes(header + text + chunks)


def changed(scene, changes):
    """The scene as both programs can draw it."""
    for light in scene.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", []):
        if "spot" in light:  # the two fade differently to the rim: neither shall
            light["spot"]["innerConeAngle"] = light["spot"]["outerConeAngle"] - 1e-4
    for word, value in (("black", 0), ("white", 1)):
        if word in changes:
            for material in scene["materials"]:
                material["pbrMetallicRoughness"]["baseColorFactor"] = [value, value, value, 1]
    if "sun" in changes:
        scene["extensionsUsed"] = ["KHR_lights_punctual"]
        scene["extensions"] = {"KHR_lights_punctual": {"lights": [SUN]}}
        scene["scenes"][0]["nodes"].append(len(scene["nodes"]))
        scene["nodes"].append({"name": "sun", "rotation": SUN_ROTATION,
                               "extensions": {"KHR_lights_punctual": {"light": 0}}})
    return scene


def emission(material):
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
    return [strength * value for value in material.get("emissiveFactor", (0, 0, 0))]


def grid_cells(scene, size):
    """{(metalness, roughness): pixels nearest to that sphere}."""
    spheres = [(node["translation"], scene["materials"][scene["meshes"][node["mesh"]]["primitives"][0]["material"]])
               for node in scene["nodes"] if "mesh" in node]
    x = ((np.arange(size[0]) + 0.5) / size[0] * 2 - 1) * GRID_HALF_HEIGHT
    y = (1 - (np.arange(size[1]) + 0.5) / size[1] * 2) * GRID_HALF_HEIGHT
    distance = np.stack([np.hypot(x[None, :] - at[0], y[:, None] - at[1]) for at, _ in spheres])
    nearest = distance.argmin(axis=0)
    factors = [material["pbrMetallicRoughness"] for _, material in spheres]
    return {(f["metallicFactor"], f["roughnessFactor"]): nearest == i for i, f in enumerate(factors)}


def srgb_from_linear(linear):
    """IEC 61966-2-1 encoding, clipped to [0, 1]."""
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def luminance(rgba):
    return rgba[..., :3] @ metrics.XYZ_FROM_RGB[1]


def compare(test, reference, mask):
    """Ratio of mean luminance, relative RMSE."""
    difference = test[mask][:, :3] - reference[mask][:, :3]
    return (luminance(test)[mask].mean() / luminance(reference)[mask].mean(),
            math.sqrt(np.mean(difference**2) / np.mean(reference[mask][:, :3]**2)))


def run(command):
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise SystemExit(f"{command[0]}: exit {result.returncode}\n{(result.stderr or result.stdout)[-2000:]}")
    return result.stdout


def main():
    p = parser(__doc__)
    p.add_argument("--reference-film", type=pathlib.Path, metavar="PATH",
                   help="the program (default: tests/reference_film beside facet)")
    p.add_argument("--samples", type=int, default=256, metavar="N", help="Cycles' a pixel and seed (default: 256)")
    p.add_argument("--reference-samples", type=int, default=64, metavar="N", help="a pixel and batch (default: 64)")
    p.add_argument("--batches", type=int, default=16, metavar="N", help="of the reference (default: 16)")
    options = p.parse_args()
    blender = shutil.which("blender")
    if not blender:
        print("skipped: blender is not installed (Debian: blender, python3-numpy)")
        raise SystemExit(SKIP)
    program = options.reference_film or options.facet.parent / "tests" / "reference_film"
    environment = corpus() / "environments" / ENVIRONMENT
    for path in (options.facet, program, environment):
        need(path)
    work, keep = work_folder(options)
    work = work.resolve()

    jobs, arrays, scenes, noise = [], [], {}, {}
    for index, (name, file, lit, changes, materials, size, *_) in enumerate(SCENES):
        if not selected(name, options.only):
            continue
        scene, chunks = read_glb(ROOT / "assets" / "scenes" / f"{file}.glb")
        scene = changed(scene, changes)
        key = f"{file}{'-environment' if lit else ''}{'-' + changes.replace(' ', '-') if changes else ''}"
        path = work / f"{key}.glb"
        films = {kind: work / f"{key}-{kind}.exr" for kind in ("facet", "reference")}
        films |= {kind: work / f"{key}-{materials}-{kind}.exr" for kind in ("cycles0", "cycles1")}
        if key not in noise and not options.reuse:  # scenes that differ for Cycles alone share them
            write_glb(path, scene, chunks)
            light = environment if lit else "none"
            error = render(options.facet, [path, "--camera", "0", "--samples", "8", "--size", f"{size[0]}x{size[1]}",
                                           "--environment", light], films["facet"])
            if error:
                raise SystemExit(f"{name}: {error}")
            noise[key] = float(run([program, path, films["reference"], *size, light, options.reference_samples,
                                    options.batches]))
        lights = scene.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
        camera = scene["cameras"][0]
        jobs.append({"scene": str(path), "environment": str(environment) if lit else "", "size": size,
                     "materials": materials, "samples": options.samples, "threads": options.jobs,
                     "yfov": camera.get("perspective", {}).get("yfov"),
                     "lights": {light["name"]: light["intensity"] for light in lights},
                     "emission": {material["name"]: emission(material) for material in scene["materials"]},
                     "pictures": [str(films["cycles0"]), str(films["cycles1"])]})
        arrays += [[str(film), str(film.with_suffix(".npy"))] for film in films.values()]
        scenes[index] = (scene, films, noise.get(key))

    todo = {"jobs": [] if options.reuse else jobs, "arrays": arrays}
    (work / "jobs.json").write_text(json.dumps(todo), encoding="utf-8")
    run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
         pathlib.Path(__file__).with_name("cycles_pictures.py"), "--", work / "jobs.json"])

    rows, grids, numbers = [], {}, {}
    sheets = Sheets(options, "facet and Cycles")
    for index, (scene, films, left) in scenes.items():
        name, file, *_, size, least_roughness, metalnesses = SCENES[index]
        film = {kind: np.load(path.with_suffix(".npy")).astype(np.float64) for kind, path in films.items()}
        film["cycles"] = (film["cycles0"] + film["cycles1"]) / 2
        covered = metrics.erode(np.min([f[..., 3] for f in film.values()], axis=0) > 0.999)
        cells = grid_cells(scene, size) if file == "material_grid" else {}
        mask = covered.copy()
        for (metalness, roughness), cell in cells.items():
            if roughness < least_roughness or not metalnesses[0] <= metalness <= metalnesses[1]:
                mask &= ~cell
        cycles, facet = (compare(film[kind], film["reference"], mask) for kind in ("cycles", "facet"))
        cycles_noise = compare(film["cycles0"], film["cycles1"], mask)[1] / 2
        rows.append([name, *(number(v) for v in (*cycles, cycles_noise, *facet)), number(left)])
        ratios = {kind: {key: compare(film[kind], film["reference"], covered & cell)[0]
                         for key, cell in cells.items() if (mask & cell).any()} for kind in ("cycles", "facet")}
        roughnesses = sorted({key[1] for key in ratios["cycles"]})
        for kind in ratios if cells else ():
            grids[f"{kind} / reference, {name}"] = roughnesses, [
                [f"{m:.3g}"] + [number(ratios[kind][m, r], "{:.3f}") for r in roughnesses]
                for m in sorted({key[0] for key in ratios[kind]})]
        numbers[name] = {"cycles": cycles, "cycles_noise": cycles_noise, "facet": facet, "reference_noise": left,
                         "spheres": {kind: {f"{m:.3g} {r:.3g}": v for (m, r), v in values.items()}
                                     for kind, values in ratios.items()}}
        if sheets.wanted():
            panels = [(kind, srgb_from_linear(film[kind][..., :3])) for kind in ("reference", "cycles", "facet")]
            off = np.abs(luminance(film["cycles"]) - luminance(film["reference"])) * mask
            off /= luminance(film["reference"])[mask].mean()
            sheets.add(name, panels + [("|cycles - reference| / mean", np.repeat(off[..., None], 3, axis=2))], "")

    print_table(["scene", "Cycles / reference", "relative RMSE", "Cycles' noise", "facet / reference", "relative RMSE",
                 "reference's noise"], rows)
    for name, (roughnesses, table) in grids.items():
        print(f"\n{name}: metalness down, roughness across")
        print_table([""] + [f"{r:.3g}" for r in roughnesses], table)
    if options.json:
        options.json.write_text(json.dumps(numbers, indent=1), encoding="utf-8")
    sheets.write()
    del keep


main()

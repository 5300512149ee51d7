#!/usr/bin/env python3
"""Instructions of a steady frame, per covered pixel and triangle, and of a whole run, beside instructions.json.

    bench/instructions.py [--update] [--only SCENE]... [--json FILE] [--markdown FILE]

Counted by callgrind (Debian: valgrind) with AVX2's code on one core, 512 x 512 pixels, one sample, the built-in studio;
a frame is the difference between a run of three equal frames and one of two. Counts hold for one compiler and its
version, and move by less than 0.1 % between runs, so that a change that costs shows in review: --update rewrites
instructions.json, which is under version control. Exit code 2 where something needs over 1 % more than it states.
Scenes of the corpus are left out where it is absent.
"""
import json
import pathlib
import re
import sys
import tempfile

import harness

TRACKED = pathlib.Path(__file__).resolve().parent / "instructions.json"
STAGES = {"geometry": "RunGeometry", "tiles": "RunTiles", "encode": "EncodePixels"}
SIZE = (512, 512)


def subjects():
    bundled = harness.ROOT / "assets" / "scenes"
    named = {"showcase": bundled / "showcase.glb", "material_grid": bundled / "material_grid.glb",
             "DamagedHelmet": harness.corpus_model("DamagedHelmet"),
             "MetalRoughSpheresNoTextures": harness.corpus_model("MetalRoughSpheresNoTextures")}
    return {name: path for name, path in named.items() if path is not None}


def measure(build, model):
    frame, within, counts = harness.steady_frame(build, model, tuple(STAGES.values()), size=SIZE)
    with tempfile.TemporaryDirectory() as folder:
        facet = harness.need_program(build / "facet", "the target facet")
        whole, _ = harness.instructions([facet, "render", model, "-o", pathlib.Path(folder) / "picture.png", "--quiet",
                                         "--size", "512x512", "--samples", "1", "--threads", "1"])
    return {"covered_pixels": counts["covered_pixels"], "triangles": counts["triangles"], "frame": frame,
            **{key: within[function] for key, function in STAGES.items()}, "file_to_file": whole}


def compiler(build):
    cache = build / "CMakeCache.txt"
    versions = sorted(build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"))
    if not cache.exists() or not versions:
        return "?"
    text = versions[-1].read_text()
    return " ".join(re.search(rf'set\(CMAKE_CXX_COMPILER_{key} "([^"]*)"', text)[1] for key in ("ID", "VERSION"))


def change(now, before):
    return "" if not before or now is None else f"{100 * (now / before - 1):+.1f} %"


def each(now, stage, unit):
    """Instructions of the frame, and of one stage, for each of the units."""
    return [f"{now[key] / max(now[unit], 1):.0f}" if now[key] is not None else "-" for key in ("frame", stage)]


def main():
    p = harness.parser(__doc__)
    p.add_argument("--update", action="store_true", help="rewrite instructions.json")
    p.add_argument("--only", action="append", metavar="SCENE", help="only scenes whose name holds this")
    o = p.parse_args()
    stored = json.loads(TRACKED.read_text()) if TRACKED.exists() else {"scenes": {}}
    used = compiler(o.build)
    tables = harness.Tables(o.markdown)
    if stored.get("compiler", used) != used:
        tables.line(f"instructions.json was counted with {stored['compiler']}, this build is of {used}: nothing to compare.")
        stored = {"scenes": {}}
    tables.head("", ["scene", "a covered pixel", "of it tiles", "a triangle", "of it geometry", "frame, M",
                     *(key + ", M" for key in STAGES), "file to file, M", "changed"])
    fresh, worse = {}, []
    for name, path in subjects().items():
        if o.only and not any(text.lower() in name.lower() for text in o.only):
            continue
        now, before = measure(o.build, path), stored["scenes"].get(name, {})
        fresh[name] = now
        changed = []
        for key in ("frame", *STAGES, "file_to_file"):
            if before.get(key) and now[key] is not None and abs(now[key] / before[key] - 1) > 0.01:
                changed.append(f"{key} {change(now[key], before[key])}")
                if now[key] > before[key]:
                    worse.append(f"{name}: {changed[-1]}")
        millions = ["-" if now[key] is None else f"{1e-6 * now[key]:.2f}" for key in ("frame", *STAGES, "file_to_file")]
        tables.row([name, *each(now, "tiles", "covered_pixels"), *each(now, "geometry", "triangles"), *millions,
                    ", ".join(changed) or ("no" if before else "new")])
    if not fresh:
        raise harness.Failure("no scene has such a name")
    harness.write_json(o.json, {"compiler": used, "scenes": fresh})
    if o.update:
        scenes = {**stored["scenes"], **fresh}
        harness.write_json(TRACKED, {"compiler": used, "scenes": {name: scenes[name] for name in sorted(scenes)}})
    for line in worse:
        print("needs more: " + line, file=sys.stderr)
    return 2 if worse and not o.update else 0


harness.run_main(main)

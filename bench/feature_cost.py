#!/usr/bin/env python3
"""What you do not use costs nothing; what you use costs what it says. Two tables:

    bench/feature_cost.py [--table unused|curves] [--only NAME]... [--work FOLDER] [--json FILE] [--markdown FILE]

unused   Each feature is left out of a scene that has all the others, and that scene is drawn by facet as it is and by a
         facet that is compiled without the feature: instructions of a steady frame and of the whole run (callgrind,
         AVX2's code, one core), processor time and peak memory. "equal": facet as it is needs at most 1 % more
         instructions. Compiled without it means: a copy of the sources (in --work, kept to build less the next time) in
         which the branches that choose the feature are constants (WITHOUT, below); the product has no switches for it.
curves   Instructions as the use of a feature grows, less those of the same scene without it, the cost of one more, and
         the exponent between the last two points: 1 is linear.

Needs valgrind, python3-numpy and, for the first table, what builds facet.
"""
import pathlib
import re
import shutil
import subprocess
import tempfile

import harness
from harness import Failure

TILE, VISIBILITY = "src/render/tile_pass.cc", "src/render/tile_visibility.cc"
POSE, LIGHTING = "src/scene/pose.cc", "src/light/lighting-inl.h"


def never(bits):
    """A material's features, as an expression of src/material/slots.h, that no material has."""
    return [("src/plan/frame_material.h", r"\(features & feature\) != 0", f"(features & feature & ~({bits})) != 0"),
            ("src/material/closure-inl.h", r"return \(kPossible & lobe\)", f"return (kPossible & lobe & ~({bits}))"),
            ("src/material/read-inl.h", r"return \(kPossible & lobe\)", f"return (kPossible & lobe & ~({bits}))")]


# What compiles a feature out: (file, pattern, what takes its place). A pattern that no longer matches is an error.
WITHOUT = {
    "base colour texture": never("BitOf(Slot::BaseColor)"),
    "metallic-roughness texture": never("BitOf(Slot::MetallicRoughness)"),
    "normal texture": never("BitOf(Slot::Normal)"),
    "occlusion texture": never("BitOf(Slot::Occlusion)"),
    "emissive texture": never("BitOf(Slot::Emissive)"),
    "emission": never("kEmission"),
    "lighting": never("kLit"),
    "vertex colours": [("src/shade/interpolate-inl.h", r"if \(material\.vertex_colors\)", "if (false)"),
                       ("src/shade/attribute_setup.cc", r"if \(material\.vertex_colors\)", "if (false)")],
    "skinning": [(POSE, r"if \((settings\.skins && )?node\.skin >= 0", "if (false && node.skin >= 0")],
    "morph targets": [(POSE, r"shape\.morphed = [^;]*;", "shape.morphed = false;")],
    "alpha test": [(VISIBILITY, r"if \(!lists\.masked\[list_\]\.empty\(\)\) DrawMasked", "if (false) DrawMasked")],
    "blending": [(TILE, r"if \(visibility_\.HasBlended\(\)\)", "if (false)")],
    "punctual lights": [(LIGHTING, r"return data_->light_count;", "return 0;")],
    "directional lights": [(LIGHTING, r"if \(light\.type == LightType::Directional\)", "if (false)")],
    "spot lights": [(LIGHTING, r"if \(light\.type == LightType::Spot\)", "if (false)")],
    "environment": [(LIGHTING, r"return data_->environment != nullptr;", "return false;")],
    "background": [("src/render/environment_background.cc", r"if \(lighting_ == nullptr\) return;", "if (true) return;")],
    "4 samples": [("src/frame/tile.h", r"int tile_size = 0, samples = 0;",
                   "int tile_size = 0; static constexpr int samples = 1;"),
                  (VISIBILITY, r"tile_\.samples = [^;]*;", "")],
    "clear coat": never("kClearcoat"),
    "sheen": never("kSheen"),
    "specular factors": never("kSpecular"),
    "index of refraction": never("kIor"),
    "transmission": never("kTransmission"),
    "volume": never("kVolume"),
    "dispersion": never("kDispersion"),
    "diffuse transmission": never("kDiffuseTransmission"),
    "iridescence": never("kIridescence"),
    "anisotropy": never("kAnisotropy"),
    "material extensions": never("kLayerFeatures"),
    "models of other engines": [
        ("src/shade/shade_fragments.cc", r"    FACET_OWN_MODELS\(FACET_MODEL_CASE\)\n", "    default: break;\n"),
        ("src/plan/frame_material.h", r"parameters != nullptr \? ModelOf\(\*parameters\)", "false ? model"),
        ("src/plan/frame_plan.cc", r"\b[fm]\.parameters != nullptr", "false")],
}


def run(command, log):
    with open(log, "w") as out:
        if subprocess.run([str(c) for c in command], stdout=out, stderr=subprocess.STDOUT, check=False).returncode != 0:
            raise Failure(f"{command[0]} {command[1]}: failed, see {log}")


class Copy:
    """A copy of the sources that can be built with some lines changed."""

    def __init__(self, folder):
        self.source, self.build, self.folder = folder / "source", folder / "build", folder
        self.source.mkdir(parents=True, exist_ok=True)
        for name in ("CMakeLists.txt", "LICENSE", "README.md", "cmake", "include", "src", "bench", "assets", "docs"):
            self.refresh(harness.ROOT / name, self.source / name)

    def refresh(self, source, target):
        """Copies what changed, with its time, so that only that is built again."""
        if source.is_dir():
            target.mkdir(exist_ok=True)
            for child in source.iterdir():
                self.refresh(child, target / child.name)
        elif source.exists() and (not target.exists() or target.read_bytes() != source.read_bytes()):
            shutil.copyfile(source, target)

    def make(self, edits=()):
        """Builds with these edits, and takes them back; the folder of the programs."""
        originals = {}
        try:
            for name, pattern, replacement in edits:
                file = self.source / name
                text = file.read_text()
                originals.setdefault(file, text)
                text, count = re.subn(pattern, lambda _: replacement, text)
                if count == 0:
                    raise Failure(f"{name} no longer has /{pattern}/: change WITHOUT in this script")
                file.write_text(text)
            if not (self.build / "build.ninja").exists():
                run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                     "-DFACET_BUILD_TESTS=OFF", "-DFACET_BUILD_BENCH=ON"], self.folder / "configure.log")
            run(["ninja", "-C", self.build, "orbit_bench"], self.folder / "build.log")
        finally:
            for file, text in originals.items():
                file.write_text(text)
        return self.build


def measure(build, scene, options, runs):
    frame, _, _ = harness.steady_frame(build, scene, **options)
    whole, _ = harness.instructions(harness.orbit(build, scene, frames=1, step=0, **options))
    times = [harness.timed(harness.orbit(build, scene, frames=20, step=0, **options)) for _ in range(runs)]
    return {"frame": frame, "whole": whole, "cpu": min(t["cpu"] for t in times), "rss": min(t["rss"] for t in times)}


def drawn(feature):
    """How orbit_bench draws a scene without the feature."""
    picture = str(harness.ROOT / "assets" / "studio.hdr")
    light = {"environment": "none", "background": "studio"}.get(feature, picture)
    return {"light": light, "size": (256, 256), "samples": 1 if feature == "4 samples" else 4}


def unused(o, tables, folder):
    import scenes
    copy, results = Copy(o.work.resolve() if o.work else folder), {}
    as_built = folder / "as_built"
    (as_built / "bench").mkdir(parents=True)
    shutil.copy(copy.make() / "bench" / "orbit_bench", as_built / "bench")
    tables.head("**What is not used**", ["a scene without", "frame, M", "compiled without it", "ratio", "whole run, M",
                                         "compiled without it", "ratio", "equal", "processor, ms", "peak, MiB"])
    for feature, edits in WITHOUT.items():
        if o.only and not any(text.lower() in feature for text in o.only):
            continue
        scene = scenes.everything_but(feature).write(folder / "scene.glb")
        try:
            lean = copy.make(edits)
        except Failure as failure:
            tables.row([feature, str(failure)])
            results[feature] = {"problem": str(failure)}
            continue
        a = measure(as_built, scene, drawn(feature), o.runs)
        b = measure(lean, scene, drawn(feature), o.runs)
        ratios = [a[key] / b[key] for key in ("frame", "whole")]
        equal = all(ratio <= 1.01 for ratio in ratios)
        tables.row([feature, f"{1e-6 * a['frame']:.3f}", f"{1e-6 * b['frame']:.3f}", f"{ratios[0]:.4f}",
                    f"{1e-6 * a['whole']:.2f}", f"{1e-6 * b['whole']:.2f}", f"{ratios[1]:.4f}",
                    "yes" if equal else "NO", f"{1e3 * a['cpu']:.0f} / {1e3 * b['cpu']:.0f}",
                    f"{a['rss']:.1f} / {b['rss']:.1f}"])
        results[feature] = {"as_built": a, "without": b, "equal": equal}
    return results


def curves(o, tables, folder):
    import scenes
    showcase = harness.ROOT / "assets" / "scenes" / "showcase.glb"
    # (name, counts, scene of a count, the scene without the feature, whether a frame or the whole run is counted)
    one_sheet = scenes.layers(1)
    kinds = [
        ("point lights", [1, 10, 100, 1000], scenes.lit_by, scenes.lit_by(0), "frame"),
        ("point lights of short reach", [1, 10, 100, 1000], lambda n: scenes.lit_by(n, 0.35), scenes.lit_by(0),
         "frame"),
        ("blended layers", [1, 3, 10, 30, 100], lambda n: scenes.layers(n, "BLEND"), one_sheet, "frame"),
        ("opaque layers, farthest first", [1, 3, 10, 30, 100], scenes.layers, one_sheet, "frame"),
        ("morph targets", [1, 4, 16, 64], scenes.morphed, scenes.morphed(0), "whole"),
        ("joints", [1, 16, 256, 4096], scenes.skinned, scenes.skinned(0), "whole"),
        ("texels of a texture", [n * n for n in (64, 256, 1024, 2048)], lambda n: scenes.textured(round(n ** 0.5)),
         scenes.triangles(2 * 32 * 32), "whole"),
        ("coverage samples", [1, 2, 4, 8], lambda n: showcase, None, "frame"),
    ]
    tables.head("**What is used**", ["feature", "how much: millions of instructions more",
                                     "one more costs, in thousands", "exponent"])
    results = {}
    for name, counts, maker, without, part in kinds:
        if o.only and not any(text.lower() in name.lower() for text in o.only):
            continue

        def count(scene, n):
            path = scene if scene == showcase else scene.write(folder / "scene.glb")
            options = {"light": "none", "size": (128, 128), "samples": n if scene == showcase else 1}
            if part == "frame":
                return harness.steady_frame(o.build, path, **options)[0]
            return harness.instructions(harness.orbit(o.build, path, frames=1, step=0, **options))[0]

        base = 0 if without is None else count(without, 0)
        costs = [count(maker(n), n) - base for n in counts]
        each = (costs[-1] - costs[-2]) / (counts[-1] - counts[-2])
        tail = harness.exponent(counts, costs)
        tables.row([f"{name} ({part})", ", ".join(f"{n}: {1e-6 * c:.2f}" for n, c in zip(counts, costs)),
                    f"{1e-3 * each:.3f}", "-" if tail is None else f"{tail:.2f}"])
        results[name] = {"counts": counts, "instructions": costs, "base": base, "exponent": tail}
    return results


def main():
    p = harness.parser(__doc__)
    p.add_argument("--table", choices=["unused", "curves"], help="only this one")
    p.add_argument("--only", action="append", metavar="NAME", help="only features whose name holds this; repeatable")
    p.add_argument("--work", type=pathlib.Path, metavar="FOLDER", help="where facet is built (default: temporary)")
    p.add_argument("--runs", type=int, default=3, metavar="N", help="of which the least time is taken [3]")
    o = p.parse_args()
    tables, results = harness.Tables(o.markdown), {}
    try:
        import numpy  # noqa: F401, pylint: disable=unused-import
    except ImportError as error:
        raise Failure(f"{error}: install python3-numpy") from None
    with tempfile.TemporaryDirectory() as scratch:
        for name, table in (("unused", unused), ("curves", curves)):
            if o.table in (None, name):
                results[name] = table(o, tables, pathlib.Path(scratch))
    harness.write_json(o.json, results)
    return 0


harness.run_main(main)

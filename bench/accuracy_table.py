#!/usr/bin/env python3
"""Prints the table of docs/accuracy.md: where the default settings lie among all that `facet report` measures.

    bench/accuracy_table.py [--facet build/release/facet] [--budget 60s] [--size 256x256] [--output FOLDER]
                            [--environment FILE] [--error relative_rmse|flip|rmse|largest] [SCENE...]

Scenes default to the bundled ones and some of the corpus (FACET_CORPUS, or ../shared/corpus). With --output the reports
are kept there as HTML and JSON.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CORPUS = pathlib.Path(os.environ.get("FACET_CORPUS") or ROOT.parent / "shared" / "corpus") / "models"
MODELS = ["DamagedHelmet", "BoomBox", "Duck", "CesiumMan", "MetalRoughSpheresNoTextures", "TextureSettingsTest"]


def default_scenes():
    scenes = [ROOT / "assets" / "scenes" / (name + ".glb") for name in ("showcase", "material_grid", "animated")]
    for model in MODELS:
        found = sorted((CORPUS / model).glob("**/*.gl[bt]*")) if (CORPUS / model).is_dir() else []
        scenes += found[:1]
    return scenes


def measure(facet, scene, size, budget, environment, folder):
    stored = folder / (scene.stem + ".json")
    command = [facet, "report", str(scene), "-o", str(stored), "-o", str(folder / (scene.stem + ".html")),
               "--size", size, "--budget", budget, "--quiet"]
    if environment:
        command += ["--environment", environment]
    subprocess.run(command, check=True)
    return json.loads(stored.read_text())


def words(changed):
    return " ".join(f"{option} {value}" for option, value in sorted(changed.items())) or "the default"


def row(report, measure_of):
    points = report["points"]
    default = points[0]
    error, seconds = default["error"][measure_of], default["seconds"]
    # What else has no more error, and what else takes no more time.
    faster = min((p for p in points if p["error"][measure_of] <= error), key=lambda p: p["seconds"])
    better = min((p for p in points if p["seconds"] <= seconds), key=lambda p: p["error"][measure_of])
    rounding = (report.get("rounding") or {}).get("relative_rmse")
    reference = report["reference"]
    share = reference["pixels"] / (report["width"] * report["height"])
    of_part = "" if share == 1 else f" (of {100 * share:.0f} % of the picture)"
    return [report["scene"], str(len(points)), f"{1e3 * seconds:.1f}", f"{error:.4f}",
            f"{reference['relative_error']:.4f}{of_part}", "" if rounding is None else f"{rounding:.1e}",
            f"{seconds / faster['seconds']:.2f} ({words(faster['changed'])})",
            f"{error / max(better['error'][measure_of], 1e-300):.2f} ({words(better['changed'])})"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--facet", default=str(ROOT / "build" / "release" / "facet"))
    parser.add_argument("--budget", default="60s")
    parser.add_argument("--size", default="256x256")
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--environment")
    parser.add_argument("--error", default="relative_rmse", choices=["relative_rmse", "flip", "rmse", "largest"])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    head = ["scene", "points", "default, ms", arguments.error, "reference's own", "rounding",
            "default's time / fastest with no more error", "default's error / least in no more time"]
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.output or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for scene in arguments.scenes or default_scenes():
            report = measure(arguments.facet, scene, arguments.size, arguments.budget, arguments.environment, folder)
            print("| " + " | ".join(row(report, arguments.error)) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

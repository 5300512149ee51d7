#!/usr/bin/env python3
"""How time and memory grow with pixels, triangles, textures, lights, overdraw, transparent layers and threads.

    bench/scale.py [--quick] [--only CURVE]... [--runs N] [--json FILE] [--markdown FILE]

Each point is `facet render` of a scene made here (Debian: python3-numpy), file to PNG; times are the least of the runs,
memory is the process' peak. Below each curve stands the exponent of its tail, the slope of log cost over log size
between the last two points: 1 is linear, less is better. A point that fails says why. --quick stops before what takes
minutes and gigabytes.
"""
import json
import os
import pathlib
import tempfile

import harness
from harness import Failure

COLUMNS = ("load", "textures", "geometry", "raster", "write", "total")


def ladder(first, last, step, quick_last, quick):
    """first, first * step ... and `last` at the end."""
    last = quick_last if quick else last
    values, value = [], first
    while value < last:
        values.append(value)
        value *= step
    return values + [last]


def curves(quick):
    """(name, unit, [(x, scene maker or file, arguments)]); the scene is made when it is needed."""
    try:
        import scenes
    except ImportError as error:
        raise Failure(f"{error}: install python3-numpy") from None
    showcase = harness.ROOT / "assets" / "scenes" / "showcase.glb"
    small, frontal = ["--size", "512x512"], ["--size", "512x512", "--samples", "1", "--orbit", "0,90,2.6"]

    def made(values, maker, arguments):
        return [(value, (lambda value=value: maker(value)), arguments) for value in values]

    return [
        ("pixels", "pixels", [(side * side, showcase, ["--size", f"{side}x{side}"])
                              for side in ladder(64, 16384, 4, 4096, quick)]),
        ("triangles", "triangles", made(ladder(100, 20_000_000, 10, 1_000_000, quick), scenes.triangles, small)),
        ("triangles, nearly all outside the picture", "triangles",
         made(ladder(100, 20_000_000, 10, 1_000_000, quick), scenes.triangles, [*small, "--orbit", "0,90,0.4"])),
        ("texture", "texels", [(side * side, (lambda side=side: scenes.textured(side)), frontal)
                               for side in ladder(256, 8192, 2, 2048, quick)]),
        ("lights that shine everywhere", "lights", made(ladder(1, 1000, 10, 100, quick), scenes.lit_by, frontal)),
        ("lights of short reach", "lights", made(ladder(1, 1000, 10, 100, quick),
                                                 lambda n: scenes.lit_by(n, reach=0.35), frontal)),
        ("overdraw, farthest first", "layers", made(ladder(1, 100, 3, 27, quick), scenes.layers, frontal)),
        ("overdraw, nearest first", "layers",
         made(ladder(1, 100, 3, 27, quick), lambda n: scenes.layers(n, back_to_front=False), frontal)),
        ("transparent layers", "layers",
         made(ladder(1, 100, 3, 27, quick), lambda n: scenes.layers(n, alpha_mode="BLEND"), frontal)),
        ("threads", "threads", [(n, showcase, ["--size", "2048x2048", "--threads", str(n)])
                                for n in sorted({1, 2, len(os.sched_getaffinity(0))})]),
    ]


def measure(facet, scene, arguments, folder, runs):
    best = None
    for _ in range(runs):
        picture = folder / "picture.png"
        numbers = harness.timed([facet, "render", scene, "-o", picture, "--quiet", "--stats=json", *arguments])
        stats = json.loads(numbers["out"])
        point = {**{key: stats["seconds"][key] for key in COLUMNS}, "wall": numbers["wall"], "cpu": numbers["cpu"],
                 "rss": numbers["rss"], "texture_bytes": stats["bytes"]["textures"]}
        best = point if best is None else {key: min(point[key], best[key]) for key in point}
    return best


def number(x):
    return f"{x:,}" if x < 100_000 else f"{x:.3g}"


def main():
    p = harness.parser(__doc__)
    p.add_argument("--facet", type=pathlib.Path, metavar="PATH", help="the program (default: BUILD/facet)")
    p.add_argument("--quick", action="store_true", help="only up to 4096 x 4096 pixels, 1e6 triangles, 2k textures")
    p.add_argument("--only", action="append", metavar="CURVE", help="only curves whose name holds this; repeatable")
    p.add_argument("--runs", type=int, default=3, metavar="N", help="of each point [3]")
    o = p.parse_args()
    facet = harness.need_program(o.facet or o.build / "facet", "the target facet")
    tables, everything, summary = harness.Tables(o.markdown), {}, []
    machine = harness.machine()
    tables.line(f"{machine['cpu']}, {machine['cores']} cores; load at the start {machine['load']:.1f}; "
                "ms but for memory")
    for name, unit, points in curves(o.quick):
        if o.only and not any(text.lower() in name.lower() for text in o.only):
            continue
        tables.head(f"**{name}**", [unit, *COLUMNS, "whole process", "processor", "peak, MiB"])
        done = []
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            for x, scene, arguments in points:
                if callable(scene):
                    scene = scene().write(folder / "scene.glb")
                try:
                    point = measure(facet, scene, arguments, folder, o.runs)
                except Failure as failure:
                    tables.row([number(x), str(failure)])
                    continue
                done.append({"x": x, **point})
                tables.row([number(x), *(f"{1e3 * point[key]:.2f}" for key in COLUMNS), f"{1e3 * point['wall']:.1f}",
                            f"{1e3 * point['cpu']:.1f}", f"{point['rss']:.1f}"])
        tails = {key: harness.exponent([d["x"] for d in done], [d[key] for d in done])
                 for key in (*COLUMNS, "wall", "cpu", "rss")}
        text = {key: "-" if tail is None else f"{tail:.2f}" for key, tail in tails.items()}
        tables.row(["exponent", *(text[key] for key in (*COLUMNS, "wall", "cpu", "rss"))])
        everything[name] = {"unit": unit, "points": done, "exponents": tails}
        summary.append((name, text))
    if not summary:
        raise Failure("no curve has such a name")
    tables.head("**exponents of the tails**", ["curve", "wall time", "processor time", "memory"])
    for name, text in summary:
        tables.row([name, text["wall"], text["cpu"], text["rss"]])
    harness.write_json(o.json, {"machine": machine, "curves": everything})
    return 0


harness.run_main(main)

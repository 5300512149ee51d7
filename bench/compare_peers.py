#!/usr/bin/env python3
"""facet beside the renderers that people use today for glTF without a GPU: one table.

    bench/compare_peers.py [--only ROW]... [--runs N] [--npm FOLDER] [--json FILE] [--markdown FILE]

Every row runs facet and its peers by turns (facet, peer, facet, peer ...), whole processes, and states medians of wall
time (minimum in brackets), of processor time and of the largest process' memory (a browser has several). Frames are
steady: file loaded, the camera going round; processor time and memory are of the whole run. A peer that
is not installed says so in its cell (bench/install-peers.sh installs them). All peers draw with Mesa's llvmpipe;
--peers names the folder of the scripts that run them. The camera is theirs: 45 degrees, at distance 3.2 from
the origin.
"""
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

import harness
from harness import Failure, middle

CAMERA = ["--orbit", "0,90,3.2", "--target", "0,0,0", "--fov", "45"]
SOFTWARE = {"LIBGL_ALWAYS_SOFTWARE": "1"}
PYTHON = "/usr/bin/python3"  # Debian's, which has python3-vtk9


def options():
    p = harness.parser(__doc__)
    p.add_argument("--facet", type=pathlib.Path, metavar="PATH", help="the program (default: BUILD/facet)")
    p.add_argument("--model", type=pathlib.Path, default=harness.corpus_model("DamagedHelmet"), metavar="FILE",
                   help="default: the corpus' DamagedHelmet")
    p.add_argument("--hdri", type=pathlib.Path, metavar="FILE",
                   default=harness.corpus() / "environments" / "chinese_garden_1k.hdr", help="default: %(default)s")
    p.add_argument("--box", type=pathlib.Path, default=harness.corpus_model("Box"), metavar="FILE")
    p.add_argument("--spheres", type=pathlib.Path, default=harness.corpus_model("MetalRoughSpheresNoTextures"),
                   metavar="FILE")
    p.add_argument("--peers", type=pathlib.Path, default=harness.SHARED / "peers", metavar="FOLDER",
                   help="default: %(default)s")
    p.add_argument("--npm", type=pathlib.Path, metavar="FOLDER",
                   help="holds node_modules with puppeteer-core, three and model-viewer (default: the peers' folder)")
    p.add_argument("--runs", type=int, default=5, metavar="N", help="of each, one more to warm up [5]")
    p.add_argument("--frames", type=int, default=36, metavar="N", help="around the model, of a steady row [36]")
    p.add_argument("--only", action="append", metavar="TEXT", help="only rows whose name holds TEXT; may be repeated")
    o = p.parse_args()
    o.facet = o.facet or o.build / "facet"
    o.npm = o.npm or o.peers
    return o


# --- One-shot: file to PNG --------------------------------------------------------------------------------------------

class Display:
    """One Xvfb for all runs, which is kinder to the peers than to start one for each."""

    def __init__(self):
        self.process, self.name = None, None

    def __enter__(self):
        return self

    def environment(self):
        if self.process is None:
            if shutil.which("Xvfb") is None:
                raise Failure("not installed: Xvfb")
            self.process = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "64x64x24"],
                                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            self.name = ":" + self.process.stdout.readline().strip()
        return {**SOFTWARE, "DISPLAY": self.name}

    def __exit__(self, *_):
        if self.process is not None:
            self.process.terminate()
            self.process.wait()


def facet_once(o, model, folder, *arguments):
    harness.need_program(o.facet, "the target facet")
    return lambda: harness.timed([o.facet, "render", model, "-o", folder / "facet.png", "--quiet", *arguments])


def facet_cached(o, model, folder, *arguments):
    run = facet_once(o, model, folder, *arguments, "--cache", folder / "cache")
    run()  # fills it
    return run


def f3d_once(display, model, folder, hdri=None):
    if shutil.which("f3d") is None:
        raise Failure("not installed: f3d")
    command = ["f3d", "--dry-run", "--quiet", "--resolution=1024,1024", f"--output={folder / 'f3d.png'}", "--up=+Y",
               "--camera-position=0,0,3.2", "--camera-focal-point=0,0,0", "--camera-view-up=0,1,0",
               "--camera-view-angle=45"] + ([f"--hdri={hdri}"] if hdri else []) + [str(model)]
    environment = display.environment()
    return lambda: harness.timed(command, environment)


def browser_command(o, page, model, *arguments):
    for program in ("node", "chromium"):
        if shutil.which(program) is None:
            raise Failure("not installed: " + program)
    if not (o.npm / "node_modules" / "puppeteer-core").is_dir():
        raise Failure(f"not installed: node_modules in {o.npm.name}/")
    return ["node", o.peers / "browser.mjs", page, model, "--gl", "llvmpipe", *arguments]


def model_viewer_once(o, folder):
    command = browser_command(o, "modelviewer.html", o.model, "--hdr", o.hdri, "--bg", "1", "--w", "1024",
                              "--h", "1024", "--out", folder / "model-viewer.png")
    environment = {**SOFTWARE, "PEERS_NPM": str(o.npm.resolve())}
    return lambda: harness.timed(command, environment, family=True)


# --- Steady frames ----------------------------------------------------------------------------------------------------

def facet_frames(o, model, light, samples=1, threads=2, radius=3.2, anisotropy=8):
    command = harness.orbit(o.build, model, light, (1920, 1080), samples, threads, o.frames, radius,
                            anisotropy=anisotropy)

    def run():
        numbers = harness.timed(command, one_core=threads == 1)
        frame = json.loads(numbers["out"])
        return {**numbers, **frame, "wall": 1e-3 * frame["frame_ms"]}
    return run


def frames_of(command, environment):
    def run():
        numbers = harness.timed(command, environment, family=True)
        found = re.search(r"^\{.*\}$", numbers["out"], re.MULTILINE)
        result = json.loads(found[0]) if found else {"error": harness.last_line(numbers["out"])}
        if "full" not in result:
            raise Failure(str(result.get("error", "no times")).splitlines()[0])
        return {**numbers, "wall": 1e-3 * result["full"]["median"], "renderer": str(result.get("renderer", ""))}
    return run


def three_frames(o, samples=1):
    command = browser_command(o, "three.html", o.model, "--hdr", o.hdri, "--w", "1920", "--h", "1080", "--n", o.frames,
                              "--cov", "0", "--aa", "1" if samples > 1 else "0")
    return frames_of(command, {**SOFTWARE, "PEERS_NPM": str(o.npm.resolve())})


def vtk_frames(o, display, samples=1):
    if subprocess.run([PYTHON, "-c", "import vtk"], capture_output=True, check=False).returncode != 0:
        raise Failure("not installed: python3-vtk9")
    command = [PYTHON, o.peers / "vtk-llvmpipe.py", o.model, o.hdri, "--n", o.frames,
               "--aa", samples if samples > 1 else 0]
    return frames_of(command, display.environment())


# --- The table --------------------------------------------------------------------------------------------------------

def rows(o, display, folder):
    """(name, what facet is to reach, {contestant: maker of its run}); the first contestant is facet."""
    plain = [*CAMERA, "--size", "1024x1024", "--samples", "1"]
    hdri = ["--environment", o.hdri, "--background", "environment"]
    frames = "frame 1920x1080, HDRI and background"
    return [
        ("one-shot, 1024x1024, no AA, built-in light", "<= 0.12 s, <= 120 MiB", {
            "facet": lambda: facet_once(o, o.model, folder, *plain),
            "F3D": lambda: f3d_once(display, o.model, folder)}),
        ("one-shot, 1024x1024, HDRI, cold", "<= 0.25 s", {
            "facet": lambda: facet_once(o, o.model, folder, *plain, *hdri, "--cache", "none"),
            "F3D": lambda: f3d_once(display, o.model, folder, o.hdri),
            "model-viewer": lambda: model_viewer_once(o, folder)}),
        ("one-shot, 1024x1024, HDRI, its light cached", "<= 0.15 s", {
            "facet": lambda: facet_cached(o, o.model, folder, *plain, *hdri)}),
        ("one-shot, a box, 1024x1024", "<= 0.03 s", {
            "facet": lambda: facet_once(o, o.box, folder, *plain),
            "F3D": lambda: f3d_once(display, o.box, folder)}),
        (frames + ", no AA", "<= 10 ms", {
            "facet": lambda: facet_frames(o, o.model, o.hdri),
            "facet, one place a texture, as three.js": lambda: facet_frames(o, o.model, o.hdri, anisotropy=1),
            "three.js": lambda: three_frames(o),
            "VTK": lambda: vtk_frames(o, display)}),
        (frames + ", 4 samples", "<= 14 ms", {
            "facet": lambda: facet_frames(o, o.model, o.hdri, samples=4),
            "facet, one place a texture, as three.js": lambda: facet_frames(o, o.model, o.hdri, 4, anisotropy=1),
            "three.js": lambda: three_frames(o, 4),
            "VTK": lambda: vtk_frames(o, display, 4)}),
        ("frame 1920x1080, 1.04 M triangles, 1 thread", "<= 30 ns a triangle", {
            "facet": lambda: facet_frames(o, o.spheres, "studio", threads=1, radius=0)}),
        (frames + ", one thread beside two", ">= 1.9 times", {
            "facet": lambda: facet_frames(o, o.model, o.hdri),
            "facet, 1 thread": lambda: facet_frames(o, o.model, o.hdri, threads=1)}),
    ]


def made(makers):
    """{contestant: function}; what cannot be made is a function that says why."""
    def refuse(failure):
        def run():
            raise failure
        return run
    result = {}
    for name, maker in makers.items():
        try:
            result[name] = maker()
        except Failure as failure:
            if name.startswith("facet"):
                raise
            result[name] = refuse(failure)
    return result


def milliseconds(numbers, key="wall"):
    return f"{1e3 * middle(numbers, key):.1f} ms ({1e3 * min(n[key] for n in numbers):.1f})"


def note(name, facet):
    if "triangles" in name:
        return f"{1e9 * middle(facet, 'wall') / facet[0]['triangles']:.1f} ns a triangle"
    if "frame_ms" in facet[0]:
        return f"{1e6 * middle(facet, 'frame_ms') / facet[0]['fragments']:.1f} ns a model's fragment"
    return ""


def main():
    o = options()
    for name, path in (("--model", o.model), ("--hdri", o.hdri), ("--box", o.box), ("--spheres", o.spheres)):
        if path is None or not path.exists():
            raise Failure(f"{name}: {path or 'the corpus'} is absent")
    tables, everything = harness.Tables(o.markdown), []
    machine = harness.machine()
    tables.line(f"{machine['cpu']}, {machine['cores']} cores; load at the start {machine['load']:.1f}; {o.runs} runs; "
                f"{time.strftime('%Y-%m-%d')}")
    tables.head("", ["work", "to reach", "renderer", "wall, median (minimum)", "processor", "peak memory",
                     "times facet's", "note"])
    with Display() as display, tempfile.TemporaryDirectory() as scratch:
        for name, goal, makers in rows(o, display, pathlib.Path(scratch)):
            if o.only and not any(text.lower() in name.lower() for text in o.only):
                continue
            results = harness.side_by_side(made(makers), o.runs)
            if isinstance(results["facet"], Failure):
                raise results["facet"]
            facet = middle(results["facet"], "wall")
            for peer, numbers in results.items():
                cells = [name, goal] if peer == "facet" else ["", ""]
                if isinstance(numbers, Failure):
                    tables.row([*cells, peer, str(numbers), "", "", "", ""])
                    everything.append({"work": name, "renderer": peer, "problem": str(numbers)})
                    continue
                ratio = middle(numbers, "wall") / facet
                tables.row([*cells, peer, milliseconds(numbers), f"{middle(numbers, 'cpu'):.2f} s",
                            f"{middle(numbers, 'rss'):.0f} MiB", f"{ratio:.2f}" if peer != "facet" else "",
                            note(name, numbers) if peer.startswith("facet") else ""])
                runs = [{key: value for key, value in n.items() if key != "out"} for n in numbers]
                everything.append({"work": name, "goal": goal, "renderer": peer, "ratio": ratio, "runs": runs})
    harness.write_json(o.json, {"machine": machine, "rows": everything})
    return 0


harness.run_main(main)

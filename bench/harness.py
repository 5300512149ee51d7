"""What the benches share: finding things, timing whole processes, counting instructions, tables, slopes."""
import argparse
import json
import math
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared"
BUILD = ROOT / "build" / "release"


class Failure(Exception):
    """Ends a bench with one line."""


def corpus():
    """The corpus' folder: FACET_CORPUS, or beside the project."""
    return pathlib.Path(os.environ.get("FACET_CORPUS") or SHARED / "corpus")


def corpus_model(name):
    """The path of a corpus model, or None."""
    path = corpus() / "models" / name / (name + ".glb")
    return path if path.exists() else None


def parser(description):
    p = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write all numbers")
    p.add_argument("--markdown", type=pathlib.Path, metavar="FILE", help="write the tables into a file too")
    p.add_argument("--build", type=pathlib.Path, default=BUILD, metavar="FOLDER",
                   help="where facet and bench/orbit_bench were built (default: %(default)s)")
    return p


def run_main(main):
    """Runs main(), whose failures are one line on standard error."""
    try:
        sys.exit(main())
    except (Failure, OSError) as failure:
        print(f"{pathlib.Path(sys.argv[0]).name}: {failure}", file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)


def need_program(path, target=""):
    """`path`, which must be there; `target`: what builds it."""
    if shutil.which(str(path)) is None:
        raise Failure(f"{path} is absent" + (f": build {target}, or give --build" if target else ""))
    return str(path)


def last_line(text):
    lines = text.strip().splitlines()
    return lines[-1] if lines else "no message"


# --- Whole processes --------------------------------------------------------------------------------------------------

# Starts and measures one command. A process of its own, and a small one: Linux counts the memory of whoever starts a
# program as the program's first peak. With "family", processes that outlive the one that started them, as a browser's
# do, come here and their processor time is counted.
STARTER = """
import os, resource, sys, time
report, family = int(sys.argv[1]), sys.argv[2] == "family"
if family:
    import ctypes
    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
start = time.monotonic()
try:
    pid = os.posix_spawnp(sys.argv[3], sys.argv[3:], os.environ)
except OSError as error:
    sys.exit(str(error))
status = os.waitpid(pid, 0)[1]
wall = time.monotonic() - start
while family and time.monotonic() < start + wall + 3:
    try:
        if os.waitpid(-1, os.WNOHANG)[0] == 0:
            time.sleep(0.02)
    except ChildProcessError:
        break
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
os.write(report, b"%r %r %d" % (wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss))
code = os.waitstatus_to_exitcode(status)
sys.exit(code if code >= 0 else 128 - code)
"""


def on_one_core():
    """For a process about to start: one core, and so one thread in all that it does."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def timed(command, env=None, timeout=600, family=False, one_core=False):
    """Runs it: {wall, cpu: seconds; rss: MiB of the largest process; out}. Raises Failure where it fails."""
    name, late = pathlib.Path(str(command[0])).name, threading.Event()
    read, write = os.pipe()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err, open(read, "rb") as report:
        process = subprocess.Popen([sys.executable, "-I", "-S", "-c", STARTER, str(write),
                                    "family" if family else "one", *map(str, command)],
                                   stdin=subprocess.DEVNULL, stdout=out, stderr=err, pass_fds=[write],
                                   start_new_session=True, env={**os.environ, **(env or {})},
                                   preexec_fn=on_one_core if one_core else None)
        os.close(write)

        def stop():
            late.set()
            os.killpg(process.pid, signal.SIGKILL)
        timer = threading.Timer(timeout, stop)
        timer.start()
        code = process.wait()
        timer.cancel()
        out.seek(0), err.seek(0)
        text, errors = out.read().decode(errors="replace"), err.read().decode(errors="replace")
        if late.is_set():
            raise Failure(f"{name}: not done after {timeout} s")
        if code != 0:
            raise Failure(f"{name}: exit {code}: {last_line(errors or text)}")
        wall, cpu, rss = report.read().split()
    return {"wall": float(wall), "cpu": float(cpu), "rss": int(rss) / 1024, "out": text}


def side_by_side(contestants, runs, warmup=1):
    """{name: function() -> dict of numbers} run by turns, A B A B ...; {name: list of the dicts, or a Failure}."""
    results = {name: [] for name in contestants}
    for i in range(warmup + runs):
        for name, run in contestants.items():
            if isinstance(results[name], Failure):
                continue
            try:
                numbers = run()
                if i >= warmup:
                    results[name].append(numbers)
            except Failure as failure:
                results[name] = failure
    return results


def middle(numbers, key):
    return statistics.median(n[key] for n in numbers)


# --- Instructions -----------------------------------------------------------------------------------------------------

def instructions(command, stages=()):
    """Instructions under callgrind, AVX2's code on one core: (total, {stage: within functions whose names match})."""
    need_program("valgrind")
    with tempfile.TemporaryDirectory() as folder:
        counts = pathlib.Path(folder) / "counts"
        run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", *map(str, command)],
                             capture_output=True, text=True, env={**os.environ, "FACET_TARGET": "AVX2"}, check=False,
                             preexec_fn=on_one_core)
        collected = re.search(r"Collected : (\d+)", run.stderr)
        if run.returncode != 0 or collected is None:
            raise Failure(f"valgrind {command[0]}: exit {run.returncode}: {last_line(run.stderr)}")
        within = {}
        if stages:
            listing = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(counts)],
                                     capture_output=True, text=True, check=False)
            if listing.returncode != 0:
                raise Failure("callgrind_annotate failed: " + (listing.stderr.strip().splitlines() or ["?"])[-1])
            listing = listing.stdout
            for stage in stages:  # the outermost function of that name has the most
                hits = [int(m[1].replace(",", "")) for m in re.finditer(
                    r"^\s*([\d,]+) \([^)]*\)\s+\S*:facet::" + stage + r"\(", listing, re.MULTILINE)]
                within[stage] = max(hits, default=None)
    return int(collected[1]), within


def orbit(build, model, light="studio", size=(512, 512), samples=1, threads=1, frames=2, radius=0, step=-1,
          anisotropy=8):
    """orbit_bench's command line. step: degrees between frames; less than 0: once around."""
    program = need_program(build / "bench" / "orbit_bench", "the target orbit_bench")
    return [program, model, light, *size, samples, threads, frames, radius, step, anisotropy]


def steady_frame(build, model, stages=(), **options):
    """(instructions of one steady frame, {stage: instructions}, orbit_bench's numbers): the difference of runs of three
    and of two equal frames, so that loading, decoding and first allocations fall out."""
    few = orbit(build, model, frames=1, step=0, **options)
    more = orbit(build, model, frames=2, step=0, **options)
    (a, within_a), (b, within_b) = instructions(few, stages), instructions(more, stages)
    within = {s: None if None in (within_a[s], within_b[s]) else within_b[s] - within_a[s] for s in stages}
    return b - a, within, json.loads(timed(few)["out"])


# --- Tables -----------------------------------------------------------------------------------------------------------

class Tables:
    """Prints Markdown tables as they are made, and keeps them for --markdown."""

    def __init__(self, path):
        self.path, self.text = path, ""

    def line(self, text=""):
        print(text, flush=True)
        self.text += text + "\n"
        if self.path:
            self.path.write_text(self.text)

    def head(self, title, columns):
        self.line(f"\n{title}\n" if title else "")
        self.line("| " + " | ".join(columns) + " |")
        self.line("|" + "---|" * len(columns))

    def row(self, cells):
        self.line("| " + " | ".join(str(c) for c in cells) + " |")


def write_json(path, value):
    if path:
        path.write_text(json.dumps(value, indent=2) + "\n")


def machine():
    """What the numbers were taken on."""
    def first(file, pattern):
        found = re.search(pattern, pathlib.Path(file).read_text(), re.MULTILINE)
        return found[1].strip() if found else "?"
    return {"cpu": first("/proc/cpuinfo", r"^model name\s*:(.*)$"), "cores": len(os.sched_getaffinity(0)),
            "load": os.getloadavg()[0], "memory_mib": int(first("/proc/meminfo", r"^MemTotal:\s*(\d+)")) // 1024}


def exponent(xs, ys, tail=2):
    """The slope of log y over log x, fitted through the last `tail` points: 1 is linear. None: too few points."""
    points = [(math.log(x), math.log(y)) for x, y in zip(xs, ys) if x > 0 and y and y > 0][-tail:]
    if len(points) < 2:
        return None
    mean_x, mean_y = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    across = sum((x - mean_x) ** 2 for x, _ in points)
    return None if across == 0 else sum((x - mean_x) * (y - mean_y) for x, y in points) / across

#!/usr/bin/env python3
"""What embedding facet adds to a program: facet::core in several builds, each linked with a program that renders a
scene made by hand (tests/package/consumer/consumer.cc), stripped; beside them the facet program of a whole build.

Debian 12 has no static oneTBB, and its shared one needs the shared C++ runtime: a program that is one file, with
nothing beside it but the kernel, is built without threads. Builds take minutes, in a folder that is removed afterwards,
or in --folder, which is kept and used again."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import harness

# Name: (build type, options of facet, flags of the linker).
STATIC = "-static -Wl,--gc-sections"  # what is dropped is of the C++ library; of facet it would be 1 %
BUILDS = {
    "core, as it comes": ("Release", {}, ""),
    "core, AVX2 and scalar code only": ("Release", {"FACET_DISABLED_TARGETS": "|HWY_SSE4|HWY_AVX3"}, ""),
    "core, scalar code only": ("Release", {"FACET_SCALAR_ONLY": "ON"}, ""),
    "core, scalar code only, -Os": ("MinSizeRel", {"FACET_SCALAR_ONLY": "ON"}, ""),
    "core, one thread, static": ("Release", {"FACET_THREADS": "OFF"}, STATIC),
    "the same, scalar code only, -Os": ("MinSizeRel", {"FACET_THREADS": "OFF", "FACET_SCALAR_ONLY": "ON"}, STATIC),
}

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(size LANGUAGES CXX)
set(FACET_CORE_ONLY ON)
add_subdirectory("{root}" facet)
add_executable(smallest "{root}/tests/package/consumer/consumer.cc")
target_link_libraries(smallest PRIVATE facet::core)
"""


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise harness.Failure(f"{command[0]}: exit {done.returncode}: {harness.last_line(done.stderr or done.stdout)}")
    return done.stdout


def measure(program, stripped):
    """Bytes of the stripped file and of its sections, the shared libraries that it names, and all that they bring."""
    run("strip", "-o", stripped, program)
    text, data, zeros = map(int, run("size", stripped).splitlines()[1].split()[:3])
    needed = re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", stripped))
    loaded = dict(re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", stripped) if needed else "", re.MULTILINE))
    return {"file": stripped.stat().st_size, "text": text, "data": data, "zeros": zeros,
            "needed": [name for name in needed if not name.startswith("ld-linux")],
            "loaded": {name: pathlib.Path(path).resolve().stat().st_size for name, path in loaded.items()}}


def build(folder, name, jobs):
    kind, options, flags = BUILDS[name]
    where = folder / re.sub(r"\W+", "-", name)
    (where / "source").mkdir(parents=True, exist_ok=True)
    (where / "source" / "CMakeLists.txt").write_text(PROJECT.replace("{root}", str(harness.ROOT)))
    run("cmake", "-S", where / "source", "-B", where / "build", "-G", "Ninja", f"-DCMAKE_BUILD_TYPE={kind}",
        f"-DCMAKE_EXE_LINKER_FLAGS={flags}", *(f"-D{key}={value}" for key, value in options.items()))
    run("cmake", "--build", where / "build", "-j", jobs, "--target", "smallest")
    program = where / "build" / "smallest"
    run(program)  # it tells by its exit status whether the picture is right
    return measure(program, where / "smallest")


def mebi(size):
    return f"{size / 2**20:.2f}"


def main():
    p = harness.parser(__doc__)
    p.add_argument("--folder", type=pathlib.Path, help="build here and keep it")
    p.add_argument("--jobs", type=int, default=2)
    args = p.parse_args()
    for tool in ("cmake", "ninja", "strip", "size", "readelf", "ldd"):
        harness.need_program(tool)
    folder = args.folder or pathlib.Path(tempfile.mkdtemp(prefix="facet-size-"))
    results = {}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in BUILDS:
            print(f"building: {name}", file=sys.stderr, flush=True)
            results[name] = build(folder, name, args.jobs)
        whole = args.build / "facet"
        if whole.exists():
            results["the facet program"] = measure(whole, folder / "facet")
        module = args.build / "facet_oiio.so"
        if module.exists():
            results["its OpenImageIO module"] = measure(module, folder / "facet_oiio.so")
    finally:
        if not args.folder:
            shutil.rmtree(folder, ignore_errors=True)
    tables = harness.Tables(args.markdown)
    tables.head("", ["build", "file, MiB", "code and constants", "data", "shared libraries it names",
                     "all that it loads, number and MiB"])
    for name, r in results.items():
        tables.row([name, mebi(r["file"]), mebi(r["text"]), mebi(r["data"] + r["zeros"]),
                    ", ".join(r["needed"]) or "none", f"{len(r['loaded'])}, {mebi(sum(r['loaded'].values()))}"])
    harness.write_json(args.json, {"machine": harness.machine(), "builds": results})
    return 0


if __name__ == "__main__":
    harness.run_main(main)

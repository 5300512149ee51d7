#!/usr/bin/env python3
"""One hash per scene, everywhere: renders scenes in every configuration and compares the films bit by bit.

Builds what it needs in build/PRESET, renders the bundled scenes, small files for every decoder (made for the purpose in
build/decoder-files) and the corpus (FACET_CORPUS, else ../shared/corpus, where it is there), and prints the SHA-256 of
each scene's linear film. Exit code 0: each scene has one hash, and so have its planes besides colour and what was
decoded for it; 1: some scene has several, and the configurations that differ are named; 2: something could not be built
or run.

  prove.py                                everything
  prove.py --quick                        of the corpus only what is compressed; without the debug and scalar builds
  prove.py --configurations gcc,arm64 --scenes 'room|Duck'
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
QEMU_ARM64 = ["qemu-aarch64", "-L", str(ROOT / "build/arm64-sysroot")]

# preset: the build. crossed: every instruction set with every number of threads and every tile size on the bundled
# scenes, and each of the three apart on the corpus; else every instruction set with 2 threads and tiles of 32.
# processor: of what model qemu-user is to be one; it has the best instruction set alone. qemu computes estimates of
# reciprocals exactly, which no maker's processor does, and libraries choose their code by the model.
Configuration = collections.namedtuple(
    "Configuration", "name what preset crossed quick arguments environment bundled processor",
    defaults=[False, True, [], {}, False, None])


def emulated(processor, what):
    return Configuration(processor.lower(), f"GCC, release, on an emulated processor: {what}", "release",
                         processor=processor)


CONFIGURATIONS = [
    Configuration("gcc", "GCC, release", "release", crossed=True),
    Configuration("clang", "Clang, release", "release-clang"),
    Configuration("debug", "GCC, without optimisation", "debug", quick=False),
    Configuration("asan", "Clang, address and undefined-behaviour sanitizers", "asan"),
    Configuration("scalar", "GCC, built without vector instructions", "scalar", quick=False),
    Configuration("host", "GCC, release; the host rounds upward and flushes subnormals to zero", "release",
                  arguments=["--hostile"]),
    Configuration("jpeg", "GCC, release; libjpeg-turbo without its vector code", "release",
                  environment={"JSIMD_FORCENONE": "1"}),
    Configuration("arm64", "GCC, release, 64-bit Arm under qemu-user", "arm64"),
    Configuration("arm64-host", "the same; the host rounds upward and flushes subnormals to zero", "arm64",
                  arguments=["--hostile"], bundled=True),
    emulated("max", "all that qemu-user has"),
    emulated("Haswell", "Intel, 2013"),
    emulated("EPYC", "AMD, 2017"),
    emulated("Opteron_G5", "AMD, 2012"),
    emulated("Westmere", "Intel, 2010"),
    emulated("Conroe", "Intel, 2006"),
]
DECODERS = "decoders"  # the group of the files that are made for them
THREADS = [1, 2, 3, 8]
TILES = [8, 16, 32, 64]
INPUTS = ["description", "geometry", "textures", "environment"]


class Failure(Exception):
    pass


def run(command, **options):
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    if done.returncode != 0:
        raise Failure(f"{' '.join(map(str, command[:6]))} ... failed with {done.returncode}:\n{done.stdout[-2000:]}"
                      f"{done.stderr[-2000:]}")
    return done.stdout


def find_scenes(decoder_files, corpus, quick):
    """[(group, arguments of film_hashes)]."""
    bundled = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "assets/scenes").glob("*.glb"))
    scenes = [("bundled", [scene]) for scene in bundled]
    scenes += [("bundled", ["--environment", "assets/studio.hdr", scene]) for scene in bundled]
    for path in sorted(decoder_files.iterdir()):
        is_scene = path.suffix == ".glb"
        scenes.append((DECODERS, [str(path)] if is_scene else ["--environment", str(path), bundled[0]]))
    if corpus is None:
        return scenes
    folders = [("models/*-Draco", "corpus"), ("models/*-Meshopt", "corpus")] if quick else [
        ("models", "corpus"), ("asset-generator", "asset generator")]
    for folder, group in folders:
        for pattern in ["**/*.glb", "**/*.gltf"]:
            scenes += [(group, [str(path)]) for path in sorted(corpus.glob(f"{folder}/{pattern}"))]
    if quick:
        return scenes
    for path in sorted((corpus / "environments").glob("*.hdr")):
        scenes.append(("corpus", ["--environment", str(path), bundled[0]]))
    return scenes


def in_batches(scenes):
    """The decoders' files of one kind together: most of a small file's time is the start of the program."""
    batches = []
    for group, arguments in scenes:
        kind = group == DECODERS and pathlib.Path(arguments[-2 if len(arguments) > 1 else 0]).name.split("-")[0]
        if kind and batches and batches[-1][0] == kind:
            batches[-1][2].extend(arguments)
        else:
            batches.append((kind, group, list(arguments)))
    return [(group, arguments) for _, group, arguments in batches]


def build(preset, target, builds, jobs):
    folder = builds / preset
    if preset == "arm64":
        run(["scripts/install-arm64.sh"])
    run(["cmake", "--preset", preset, "-B", str(folder)])
    run(["cmake", "--build", str(folder), "--target", target, "--parallel", str(jobs)])


def runs_for(targets, crossed, group, with_environment):
    if group == DECODERS and with_environment:
        return []
    if not crossed or group == DECODERS:
        return [(target, 2, 32) for target in targets]
    if group == "bundled":
        return [(target, threads, tile) for target in targets for threads in THREADS for tile in TILES]
    best = targets[-1]
    return sorted({(target, 2, 32) for target in targets} | {(best, threads, 32) for threads in THREADS} |
                  {(best, 2, tile) for tile in TILES})


def measure(configuration, scenes, builds, size, jobs):
    """{(scene, what): {value: [configurations]}} of one configuration."""
    program = [str(builds / configuration.preset / "tests/film_hashes")]
    if configuration.preset == "arm64":
        program = QEMU_ARM64 + program
    if configuration.processor:
        program = ["qemu-x86_64", "-cpu", configuration.processor] + program
        if not shutil.which(program[0]):
            raise Failure(f"{program[0]} is not there: scripts/install-dependencies.sh installs it")
    targets = run(program + ["--targets"]).split()
    if configuration.processor:
        targets = targets[-1:]
    environment = dict(os.environ, **configuration.environment)

    def one(entry):
        group, arguments = entry
        command = program + configuration.arguments + ["--size", str(size)]
        for target, threads, tile in runs_for(targets, configuration.crossed, group, "--environment" in arguments):
            command += ["--run", f"{target}:{threads}:{tile}"]
        return run(command + arguments, env=environment)

    wanted = in_batches([entry for entry in scenes if entry[0] == "bundled" or not configuration.bundled])
    results = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for (group, _), text in zip(wanted, pool.map(one, wanted)):
            results += [(group, *line.split("\t")) for line in text.splitlines()]
    return targets, results


def name_of(scene, corpus):
    for folder in [corpus, ROOT]:
        if folder:
            scene = scene.replace(str(folder) + "/", "")
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--configurations", help="names, by commas: " + ", ".join(c.name for c in CONFIGURATIONS))
    parser.add_argument("--scenes", default="", metavar="REGEX", help="only scenes whose path it matches")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--size", type=int, default=96, help="pixels along each side (default 96)")
    parser.add_argument("--builds", type=pathlib.Path, default=ROOT / "build", help="the folder of the builds")
    parser.add_argument("--no-build", action="store_true", help="take the builds as they are")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--markdown", action="store_true", help="print the tables of docs/determinism.md")
    options = parser.parse_args()

    names = options.configurations.split(",") if options.configurations else [
        c.name for c in CONFIGURATIONS if c.quick or not options.quick]
    unknown = set(names) - {c.name for c in CONFIGURATIONS}
    if unknown:
        parser.error("unknown configurations: " + ", ".join(sorted(unknown)))
    chosen = [c for c in CONFIGURATIONS if c.name in names]

    corpus = pathlib.Path(os.environ.get("FACET_CORPUS", ROOT / "../shared/corpus")).resolve()
    if not corpus.is_dir():
        print(f"the corpus is not at {corpus}: left out", file=sys.stderr)
        corpus = None
    builds = options.builds.resolve()
    decoder_files = builds / "decoder-files"
    if not options.no_build:
        build("release", "decoder_files", builds, options.jobs)
    run([str(builds / "release/tests/decoder_files"), str(decoder_files)])
    scenes = [s for s in find_scenes(decoder_files, corpus, options.quick) if re.search(options.scenes, " ".join(s[1]))]
    if not scenes:
        parser.error("no scene matches")

    seen = collections.defaultdict(lambda: collections.defaultdict(list))  # (scene, what) -> value -> configurations
    groups, films, skipped = {}, collections.Counter(), collections.defaultdict(set)
    used_targets = {}
    for c in chosen:
        start = time.monotonic()
        if not options.no_build:
            build(c.preset, "film_hashes", builds, options.jobs)
        built = time.monotonic()
        used_targets[c.name], results = measure(c, scenes, builds, options.size, options.jobs)
        errors = {}
        for group, scene, what, value in results:
            scene = name_of(scene, corpus)
            groups[scene] = group
            errors.setdefault(scene, "none")
            if what == "skipped":
                skipped[c.name].add(scene)
            elif what == "error":
                errors[scene] = value
            elif what in INPUTS:
                seen[scene, what][value].append(c.name)
            else:
                run_of_it, _, plane = what.partition("/")
                films[c.name] += not plane
                seen[scene, plane or "film"][value].append(f"{c.name} {run_of_it}")
        for scene in errors.keys() - skipped[c.name]:
            seen[scene, "error"][errors[scene]].append(c.name)
        print(f"{c.name}: {films[c.name]} films in {time.monotonic() - built:.0f} s (built in {built - start:.0f} s)",
              file=sys.stderr)

    differing = []
    for (scene, what), values in seen.items():
        if what == "error" and groups[scene] in ["bundled", DECODERS]:
            differing += [f"FAILS: {scene} in {', '.join(values[value])}: {value}" for value in values if value != "none"]
        if len(values) == 1:
            continue
        usual = max(values, key=lambda value: len(values[value]))
        for value, where in values.items():
            differing.append(f"DIFFERS: {what} of {scene}: {value} in {', '.join(where)}; elsewhere {usual}"
                             if value != usual else f"         {what} of {scene}: {value} in {len(where)} others")
    hashes = {scene: max(values, key=lambda value: len(values[value]))
              for (scene, what), values in seen.items() if what == "film"}

    if options.markdown:
        print("| configuration | what | instruction sets | films |\n|---|---|---|---|")
        for c in chosen:
            print(f"| {c.name} | {c.what} | {', '.join(used_targets[c.name])} | {films[c.name]} |")
        print(f"\n| scene | SHA-256 of the film, {options.size} x {options.size} |\n|---|---|")
        for scene, value in hashes.items():
            if groups[scene] == "bundled":
                print(f"| {scene} | `{value}` |")
        for group in [DECODERS, "corpus", "asset generator"]:
            count = sum(groups[scene] == group for scene in groups)
            if count:
                print(f"| {group} | {count} scenes, one hash each |")
    else:
        for scene, value in hashes.items():
            print(f"{value}  {scene}")
    out = sys.stderr if options.markdown else sys.stdout
    for name, missing in skipped.items():
        if missing:
            files = sorted(pathlib.Path(scene).name for scene in missing)
            print(f"{name} skipped, for want of OpenImageIO: {', '.join(files)}", file=out)
    for line in differing:
        print(line, file=out)
    print(f"{len(groups)} scenes, {sum(films.values())} films in {len(chosen)} configurations: "
          + (f"{len(differing)} lines of differences" if differing else "one hash per scene"), file=out)
    return 1 if differing else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        print(f"prove.py: {failure}", file=sys.stderr)
        sys.exit(2)

#!/usr/bin/env python3
"""Looks through the shared libraries that decode what a picture is made from for what scan_objects.py looks for in facet's
own objects. What is there is listed below, with the reason why no decoded bit depends on it; anything else is a finding.

scan_libraries.py [--objdump PROGRAM] [--nm PROGRAM] PROGRAM_OR_MODULE...   those that these link
scan_libraries.py [--objdump PROGRAM] [--nm PROGRAM] --libraries FILE...    these files
scan_libraries.py --self-test --compiler C++ [FLAG...]  shows that each kind is found, in a library made for the purpose

One line per finding; exit code 0: none, 1: some, 2: something could not be read. An instruction cannot tell all: code that
is chosen by the processor may be exact in each version and still differ, which is what prove.py is for.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

import scan_objects

# what: kinds of findings, or C library functions. where: the exported function that stands at or before the finding.
# unless: what facet must not call, for the reason to hold.
Allowed = collections.namedtuple("Allowed", "what where why unless", defaults=[None])
FUSED, ESTIMATE, X87 = "fused multiply-add", "reciprocal estimate", "x87 arithmetic"

LIBRARIES = {
    "libmeshoptimizer": [
        Allowed(f"{FUSED}|{ESTIMATE}", ".*", "facet calls the codecs alone, which have no floats: the filters are its own",
                unless="meshopt_(?!decode(VertexBuffer|IndexBuffer|IndexSequence)$).*"),
    ],
    "libdraco": [
        Allowed(f"{FUSED}|log2", ".*(Encod|Entropy).*", "encoders"),
        Allowed(f"{FUSED}|powf?", ".*(Gltf|Scene|MeshUtils|TrsMatrix|Texture|parser::|stbi_|Stdio|std::).*",
                "whole scenes, pictures, texts: only meshes are asked for"),
        Allowed(FUSED, ".*(KdTree|AdaptiveRAns).*", "point clouds"),
        Allowed(FUSED, ".*Attribute(Octahedron|Quantization)Transform.*", "facet does these steps anew, from the integers"),
        Allowed(FUSED, ".*PredictionSchemeTexCoordsDecoder.*",
                "texture coordinates in bitstreams before 2.2, which KHR_draco_mesh_compression does not have"),
    ],
    "libpng": [
        Allowed(f"{FUSED}|pow", ".*", "gamma and physical sizes, which facet does not ask for",
                unless="png_(set_(gamma|alpha_mode|background|rgb_to_gray|quantize)|get_(.*_dpi|.*_inches)).*"),
    ],
    "libjpeg": [
        Allowed(FUSED, "jpeg_[fi]dct_float|jinit_color_converter",
                "the transform in floats, and encoders: facet asks for the one in integers"),
    ],
    "libz": [],
    "libdeflate": [],
    "libwebp": [Allowed("log|log10|pow", ".*", "encoders, measures of their loss")],
    "libwebpdemux": [],
    "libOpenEXR": [
        Allowed("acosf|asinf|atan2f|sincosf", ".*LatLongMap.*", "directions, which facet computes itself"),
        Allowed("logf|pow", ".*round12log.*", "a function for those who write files"),
    ],
    "libOpenEXRCore": [],
    "libImath": [],
    "libIex": [],
    "libIlmThread": [],
}
# Beside them facet itself links only these, which decode nothing. The module links OpenImageIO with all that it can read.
OTHERS = re.compile(r"linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|atomic|gcc_s|stdc\+\+|tbb|sharpyuv)|facet_oiio")


def name_of(path):
    """libOpenEXR-3_1.so.30 -> libOpenEXR."""
    return re.match(r".*?(?=\.so|-\d|\d*\.so|$)", pathlib.Path(path).name).group().rstrip("0123456789")


def linked_by(program):
    """Paths by name."""
    found = {}
    for line in scan_objects.lines_of(["ldd", program]):
        path = line.split("=>")[-1].split("(")[0].strip()
        if path == "not found":
            raise RuntimeError(f"{program}: {line.strip()}")
        found[name_of(path)] = path
    return found


def imports_of(program, nm):
    words = [line.split() for line in scan_objects.lines_of([nm, "--dynamic", "--undefined-only", program])]
    return {w[-1].split("@")[0] for w in words if len(w) == 2}


def findings_in(library, objdump, nm):
    """{(what, where): times}."""
    found, called = collections.Counter(), set()
    for _, function, line, table in scan_objects.instructions_of(library, objdump):
        where = function.strip("<>").split("@@")[0]
        for what in scan_objects.inexact(line, table):
            found[what, where] += 1
        call = re.search(r"<(\w+)@plt>$", line)
        if call and scan_objects.LIBM.fullmatch(call.group(1)):
            found[call.group(1), where] += 1
            called.add(call.group(1))
    for name in imports_of(library, nm) - called:
        if scan_objects.LIBM.fullmatch(name):
            found[name, "somewhere"] += 1
    return found


def judge(name, found, imports):
    """Lines about what is not allowed."""
    lines = []
    for (what, where), times in sorted(found.items()):
        reasons = [a for a in LIBRARIES[name] if re.fullmatch(a.what, what) and re.fullmatch(a.where, where)]
        if not reasons:
            lines.append(f"{name}: {what}, {times} times in or after {where}")
        for reason in reasons:
            calls = [i for i in sorted(imports) if reason.unless and re.fullmatch(reason.unless, i)]
            if calls:
                lines.append(f"{name}: {what} in or after {where} was allowed ({reason.why}), but facet calls {calls[0]}")
    return lines


def self_test(compiler, flags, objdump, nm):
    wrong = []

    def expect(name, found, imports, count):
        lines = judge(name, found, imports)
        if len(lines) != count:
            wrong.append(f"FAILED: {name} with {dict(found)}, called by {imports}: {lines}")

    with tempfile.TemporaryDirectory() as folder:
        source, library = pathlib.Path(folder) / "sample.cc", pathlib.Path(folder) / "libz.so.1"
        sample = scan_objects.samples_for(compiler, flags)[ESTIMATE]
        source.write_text(sample + '\n#include <cmath>\nextern "C" float g(float a) { return std::sin(a) + 1.0f; }\n')
        subprocess.run([compiler, *flags, "-O2", "-fPIC", "-shared", str(source), "-o", str(library), "-lm"], check=True)
        found = findings_in(str(library), objdump, nm)
    if {what for what, _ in found} != {ESTIMATE, "sinf"} or ("sinf", "g") not in found:
        wrong.append(f"FAILED: the sample was seen as {dict(found)}")
    expect("libz", found, set(), len(found))
    expect("libmeshoptimizer", {(ESTIMATE, "f"): 1}, {"meshopt_decodeVertexBuffer", "memcpy"}, 0)
    expect("libmeshoptimizer", {(ESTIMATE, "f"): 1}, {"meshopt_decodeFilterOct"}, 1)
    expect("libjpeg", {(FUSED, "jpeg_idct_float"): 1}, set(), 0)
    expect("libjpeg", {(FUSED, "jpeg_idct_islow"): 1}, set(), 1)
    for line in wrong:
        print(line)
    print(f"{len(wrong)} judged wrongly")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--objdump", default="objdump")
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--libraries", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--compiler")
    parser.add_argument("files", nargs="*")
    options, flags = parser.parse_known_args()
    if options.self_test:
        return self_test(options.compiler, flags, options.objdump, options.nm)
    lines, paths, imports = [], {}, set()
    if options.libraries:
        paths = {name_of(path): path for path in options.files}
    else:
        for program in options.files:
            linked = linked_by(program)
            imports |= imports_of(program, options.nm)
            paths.update({name: path for name, path in linked.items() if name in LIBRARIES})
            if not re.search(r"facet_oiio", program):
                lines += [f"{name}: is not known here; does it decode?" for name in linked
                          if name not in LIBRARIES and not OTHERS.fullmatch(name)]
        lines += [f"{name}: is not linked as a shared library, so nothing was looked at" for name in LIBRARIES
                  if name not in paths]
    times = 0
    for name, path in sorted(paths.items()):
        found = findings_in(path, options.objdump, options.nm)
        times += sum(found.values())
        lines += judge(name, found, imports)
    for line in lines:
        print(line)
    print(f"{len(paths)} libraries ({', '.join(sorted(paths))}): {times} places looked at, {len(lines)} findings")
    return 1 if lines else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, RuntimeError, subprocess.CalledProcessError) as error:
        print(f"scan_libraries.py: {error}", file=sys.stderr)
        sys.exit(2)

#!/usr/bin/env python3
"""Looks through compiled objects for arithmetic whose last bit depends on the machine: fused multiply-adds, estimates of
reciprocals, x87 arithmetic, and calls to the C library's transcendental functions.

scan_objects.py [--objdump PROGRAM] [--nm PROGRAM] LIBRARY...
scan_objects.py --self-test --compiler C++ [FLAG...]  shows that each of these is found, in objects made for the purpose

One line per finding; exit code 0: none, 1: some, 2: something could not be read.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

# Mnemonics, by what is wrong with them. A line of objdump has the file's architecture at its start.
X86 = [
    ("fused multiply-add", re.compile(r"vfn?m(add|sub|addsub|subadd)\d*[ps][sdh]|vfc?maddc[ps]h|vfcmulc[ps]h")),
    ("reciprocal estimate", re.compile(r"v?r(cp|sqrt)(14|28)?[ps][sdh]")),
    ("x87 arithmetic", re.compile(
        r"f(i?(add|sub|mul|div)r?p?|(sub|div)rp|sqrt|sin|cos|sincos|ptan|patan|yl2x|yl2xp1|2xm1|scale|prem1?|rndint)"
        r"[slt]?")),
]
ARM64 = [
    ("fused multiply-add", re.compile(r"f(n?madd|n?msub|n?ml[as]|mlal2?|mlsl2?|cmla|n?mad|n?msb)")),
    ("reciprocal estimate", re.compile(r"(f|u)(recp|rsqrt)[esx]|frecp[esx]|frsqrt[es]")),
]
FUNCTIONS = ("sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 "
             "log10 log1p pow cbrt hypot fma erf erfc tgamma lgamma sinpi cospi").split()
LIBM = re.compile(r"(__)?(" + "|".join(FUNCTIONS) + r")(f|l)?(_finite)?|_ZGV\w+")


def lines_of(command):
    """The output of a program line by line; fails as the program does."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, errors="replace") as process:
        yield from process.stdout
    if process.returncode != 0:
        raise RuntimeError(f"{command[0]} cannot read {command[-1]}")


def instructions_of(library, objdump):
    """(member, function, line, table) of each instruction; table has what is wrong on its architecture."""
    table, member, function = None, pathlib.Path(library).name, ""
    for line in lines_of([objdump, "--disassemble", "--demangle", "--no-show-raw-insn", "--no-addresses", library]):
        if ":     file format " in line:
            member, architecture = line.strip().split(":     file format ")
            table = ARM64 if "aarch64" in architecture else X86 if "x86-64" in architecture else None
            if table is None:
                raise RuntimeError(f"{member}: instructions of {architecture} are not known here")
        elif line.startswith("<"):
            function = line.strip().rstrip(":")
        elif line.startswith("\t"):
            yield member, function, " ".join(line.split()), table


def inexact(line, table):
    """What is wrong with an instruction."""
    mnemonic = line.split(" ", 1)[0]
    return [what for what, pattern in table if pattern.fullmatch(mnemonic)]


def findings_in(library, objdump, nm):
    """(what, where, line) of everything in one library or object that should not be there, and how much was looked at."""
    found, instructions = [], 0
    for member, function, line, table in instructions_of(library, objdump):
        instructions += 1
        found += [(what, f"{member} {function}", line) for what in inexact(line, table)]
    member = pathlib.Path(library).name
    for line in lines_of([nm, "--undefined-only", library]):
        words = line.split()
        if line.endswith(":\n"):
            member = line.strip().rstrip(":")
        elif len(words) == 2 and LIBM.fullmatch(words[1].split("@")[0]):
            found.append(("C library function", member, words[1]))
    return found, instructions


def scan(libraries, objdump, nm):
    total, count = 0, 0
    for library in libraries:
        found, instructions = findings_in(library, objdump, nm)
        total += instructions
        count += len(found)
        for what, where, line in found:
            print(f"{library}: {what}: {line} in {where}")
        if instructions == 0:
            raise RuntimeError(f"{library}: holds no instructions")
    print(f"{len(libraries)} libraries, {total} instructions: {count} findings")
    return count


SAMPLES_X86 = {
    "fused multiply-add": '__attribute__((target("fma"))) float f(float a, float b, float c)'
                          " { return __builtin_fmaf(a, b, c); }",
    "reciprocal estimate": "#include <immintrin.h>\n__m128 f(__m128 a) { return _mm_rcp_ps(_mm_rsqrt_ss(a)); }",
    "x87 arithmetic": "long double f(long double a, long double b) { return a * b; }",
}
SAMPLES_ARM64 = {
    "fused multiply-add": "float f(float a, float b, float c) { return __builtin_fmaf(a, b, c); }",
    "reciprocal estimate": "#include <arm_neon.h>\nfloat32x4_t f(float32x4_t a)"
                           " { return vrsqrteq_f32(vrecpeq_f32(a)); }",
}


def samples_for(compiler, flags):
    machine = subprocess.run([compiler, "-dumpmachine"], stdout=subprocess.PIPE, text=True, check=True).stdout
    arm = "aarch64" in machine or any("aarch64" in flag for flag in flags)
    return dict(SAMPLES_ARM64 if arm else SAMPLES_X86)


def self_test(compiler, flags, objdump, nm):
    samples = samples_for(compiler, flags)
    samples["C library function"] = "#include <cmath>\nfloat f(float a) { return std::sin(a); }"
    samples[None] = "#include <cmath>\nfloat f(float a, float b, float c) { return std::sqrt(a * b + c) / b; }"
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        source, object_file = pathlib.Path(folder) / "sample.cc", pathlib.Path(folder) / "sample.o"
        for expected, text in samples.items():
            source.write_text(text + "\n")
            subprocess.run([compiler, *flags, "-O2", "-fno-math-errno", "-ffp-contract=off", "-c", str(source), "-o",
                            str(object_file)], check=True)
            found, _ = findings_in(str(object_file), objdump, nm)
            kinds = {what for what, _, _ in found}
            if kinds != ({expected} if expected else set()):
                wrong += 1
                print(f"FAILED: {expected or 'harmless code'} was seen as {kinds or 'harmless'}")
    print(f"{len(samples)} samples: {wrong} judged wrongly")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--objdump", default="objdump")
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--compiler")
    parser.add_argument("libraries", nargs="*")
    options, flags = parser.parse_known_args()
    try:
        if options.self_test:
            return 1 if self_test(options.compiler, flags, options.objdump, options.nm) else 0
        return 1 if scan(options.libraries + flags, options.objdump, options.nm) else 0
    except (OSError, RuntimeError, subprocess.CalledProcessError) as error:
        print(f"scan_objects.py: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())

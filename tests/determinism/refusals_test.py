#!/usr/bin/env python3
"""Flags that change floating-point results are refused: when facet is configured, and when it is compiled.

refusals_test.py SOURCE_DIR CMAKE CXX_COMPILER [FLAG...]      FLAGs are for every compilation, such as --sysroot
"""

import pathlib
import subprocess
import sys
import tempfile

CHANGES_RESULTS = ["-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math",
                   "-ffinite-math-only", "-fno-signed-zeros", "-mrecip", "-ffp-contract=fast", "-ffp-contract=on"]
CHANGES_BASELINE = ["-march=native", "-mcpu=cortex-a72", "-mfma", "-mavx2", "-msse4.2"]
HARMLESS = ["", "-O3", "-g -O2 -fstack-protector-strong -D_FORTIFY_SOURCE=2", "-fno-fast-math -ffp-contract=off",
            "-mtune=generic -msse2 -mfpmath=sse", "-flto=auto"]


def output_of(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, " ".join(done.stdout.split())


def main():
    source, cmake, compiler, *flags = sys.argv[1:]
    failures = []

    def expect(holds, what):
        if not holds:
            failures.append(what)

    # The module by itself: as it stands at configure time, without the seconds that finding a compiler takes.
    module = str(pathlib.Path(source) / "cmake/FacetArithmeticCheck.cmake")
    for variable in ["CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_RELEASE"]:
        for flag in CHANGES_RESULTS + CHANGES_BASELINE:
            code, text = output_of(cmake, f"-D{variable}=-O2 {flag} -g", "-P", module)
            expect(code != 0 and f"facet cannot be compiled with {flag}:" in text, f"{variable} {flag}: {text}")
    for flag in HARMLESS:
        code, text = output_of(cmake, f"-DCMAKE_CXX_FLAGS={flag}", "-P", module)
        expect(code == 0, f"refused {flag}: {text}")

    with tempfile.TemporaryDirectory() as folder:
        # The whole project, and a project that adds it.
        code, text = output_of(cmake, "-S", source, "-B", folder + "/whole", "-DCMAKE_CXX_FLAGS=-ffast-math")
        expect(code != 0 and "facet cannot be compiled with -ffast-math:" in text, f"configuring: {text}")
        outer = pathlib.Path(folder) / "outer"
        outer.mkdir()
        (outer / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(outer LANGUAGES CXX)\nadd_compile_options(-Ofast)\n"
            f"add_subdirectory({source} facet)\n")
        code, text = output_of(cmake, "-S", str(outer), "-B", folder + "/outer-build")
        expect(code != 0 and "facet cannot be compiled with -Ofast:" in text, f"as a subproject: {text}")

        # The header that the rendering path includes.
        program = pathlib.Path(folder) / "includes.cc"
        program.write_text('#include "facet/shader/dispatch.h"\n')
        compile = [compiler, *flags, "-std=c++20", "-I" + source + "/include", "-fsyntax-only", str(program)]
        code, text = output_of(*compile)
        expect(code == 0, f"the header alone: {text}")
        for flag in ["-ffast-math", "-Ofast", "-ffinite-math-only"]:
            code, text = output_of(*compile, flag)
            expect(code != 0 and "without -ffast-math" in text, f"compiled with {flag}: {text}")

    for failure in failures:
        print("FAILED:", failure)
    print("flags that change results are refused" if not failures else f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

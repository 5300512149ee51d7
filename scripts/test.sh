#!/usr/bin/env bash
# Builds and runs the tests.
#   scripts/test.sh                    the release build with GCC, all tests
#   scripts/test.sh PRESET...          other builds of CMakePresets.json: release-clang, debug, asan, tsan, scalar
#   scripts/test.sh --all              release, release-clang, asan, tsan and scalar, one after the other
# Options: --jobs N (default: one per core), --filter REGEX (tests whose name matches), --target NAME (build this alone;
# may stand several times), --no-install (leave the system's packages alone). Exit code 0 if every test of every build
# passed; the last lines are a summary.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=$(nproc)
filter=
install=yes
targets=()
presets=()
while (( $# > 0 )); do
  case $1 in
    -h | --help) sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    --all) presets+=(release release-clang asan tsan scalar) ;;
    --jobs) jobs=${2:?--jobs needs a number}; shift ;;
    --filter) filter=${2:?--filter needs a regular expression}; shift ;;
    --target) targets+=(--target "${2:?--target needs a name}"); shift ;;
    --no-install) install= ;;
    -*) echo "test.sh: unknown option $1; see --help" >&2; exit 2 ;;
    *) presets+=("$1") ;;
  esac
  shift
done
(( ${#presets[@]} > 0 )) || presets=(release)

cd "$root"
[[ -z $install ]] || scripts/install-dependencies.sh

export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1:strict_string_checks=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
# TBB itself is not built for the thread sanitizer: what it does inside its own locks is not ours to report.
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$root/tests/tsan.supp:ignore_noninstrumented_modules=1}

failed=()
summary=()
for preset in "${presets[@]}"; do
  echo "== $preset: build"
  # A quickstart in the same folder may have switched the tests off.
  cmake --preset "$preset" -DFACET_BUILD_TESTS=ON -DFACET_BUILD_BENCH=ON >/dev/null
  cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}"
  echo "== $preset: test"
  arguments=(--test-dir "build/$preset" --output-on-failure --parallel "$jobs")
  [[ -z $filter ]] || arguments+=(--tests-regex "$filter")
  log=$(mktemp)
  if ! ctest "${arguments[@]}" | tee "$log"; then
    failed+=("$preset")
  fi
  skipped=$(grep -cF '***Skipped' "$log" || true)
  summary+=("$preset: $(grep -E 'tests passed|No tests were found' "$log" | tail -1 || true), $skipped skipped")
  rm -f "$log"
done

echo
printf '%s\n' "${summary[@]}"
if (( ${#failed[@]} > 0 )); then
  echo "FAILED: ${failed[*]}"
  exit 1
fi

#!/usr/bin/env bash
# Builds the fuzzers (tests/fuzz) and runs one after the other, with sanitizers, on inputs that grow out of small files.
#   scripts/fuzz.sh                    an hour each
# Options: --seconds N (each; default 3600), --only NAME (this fuzzer; may stand several times), --list (their names),
# --seed N (the same start for each run; default: another each time), --jobs N (for building; default: one per core),
# --no-install (leave the system's packages alone).
# What is new to a fuzzer is kept in build/fuzz/corpus, where the next run begins; an input that crashes, takes too long or
# too much memory in build/fuzz/finds. Exit code 0 if nothing was found; the last lines are a summary.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=$(nproc)
seconds=3600
seed=0
only=()
list=
install=yes
while (( $# > 0 )); do
  case $1 in
    -h | --help) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    --only) only+=("${2:?--only needs the name of a fuzzer}"); shift ;;
    --seed) seed=${2:?--seed needs a number}; shift ;;
    --jobs) jobs=${2:?--jobs needs a number}; shift ;;
    --list) list=yes ;;
    --no-install) install= ;;
    *) echo "fuzz.sh: unknown option $1; see --help" >&2; exit 2 ;;
  esac
  shift
done

cd "$root"
[[ -z $install ]] || scripts/install-dependencies.sh
build=build/fuzz
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$jobs"

names=()
for program in "$build"/fuzzers/*; do
  names+=("$(basename "$program")")
done
if [[ -n $list ]]; then
  printf '%s\n' "${names[@]}"
  exit 0
fi
for name in "${only[@]}"; do
  [[ -x $build/fuzzers/$name ]] || { echo "fuzz.sh: no fuzzer $name; there are: ${names[*]}" >&2; exit 2; }
done
(( ${#only[@]} == 0 )) || names=("${only[@]}")

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch
# What is freed is kept for a while, to catch its use; not so much that it looks like what is in use. Memory that is not
# there is an Error of facet's, where it was asked for.
export ASAN_OPTIONS=${ASAN_OPTIONS:-quarantine_size_mb=16:allocator_may_return_null=1:strict_string_checks=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}

# One work may take 64 MiB (tests/fuzz/fuzz.h): loading and rendering, each, and what the sanitizer adds.
limits=(-rss_limit_mb=640 -malloc_limit_mb=100 -timeout=20)
summary=()
failed=()
for name in "${names[@]}"; do
  corpus=$build/corpus/$name
  finds=$build/finds
  log=$build/corpus/$name.log
  mkdir -p "$corpus" "$finds"
  inputs=("$corpus")
  for folder in "$build/seeds/$name" "tests/fuzz/corpus/$name"; do
    [[ ! -d $folder ]] || inputs+=("$folder")
  done
  echo "== $name: $seconds s"
  before=$(find "$finds" -name "$name-*" | sort)
  status=0
  "$build/fuzzers/$name" -max_total_time="$seconds" -seed="$seed" -max_len=65536 "${limits[@]}" -print_final_stats=1 \
    -artifact_prefix="$finds/$name-" "${inputs[@]}" >"$log" 2>&1 || status=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1)
  summary+=("$name: ${executions:-0} executions, $(find "$corpus" -type f | wc -l) inputs kept")
  if (( status != 0 )); then
    failed+=("$name")
    tail -60 "$log"
    comm -13 <(echo "$before") <(find "$finds" -name "$name-*" | sort) | while read -r find; do
      [[ -z $find ]] || echo "again: $build/fuzzers/$name ${limits[*]} $find"
    done
  fi
done

echo
printf '%s\n' "${summary[@]}"
if (( ${#failed[@]} > 0 )); then
  echo "FOUND SOMETHING: ${failed[*]}"
  exit 1
fi

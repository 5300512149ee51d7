#!/usr/bin/env bash
# Installs what facet is built from, on Debian 12: packages of the distribution, nothing else. Run it as root (or where
# sudo works). Does nothing when everything is there.
#   scripts/install-dependencies.sh [--minimal]
# --minimal: what the program needs to be built with GCC; without the second compiler, the tests' and benchmarks'
# libraries, the comparison script's Python modules and the emulator.
set -euo pipefail

packages=(cmake ninja-build g++ pkg-config
  libglm-dev libhwy-dev libtbb-dev                      # the core
  nlohmann-json3-dev libdraco-dev libmeshoptimizer-dev
  libpng-dev libdeflate-dev libjpeg-dev libwebp-dev libopenimageio-dev libimath-dev # pictures
  libcli11-dev)
extras=(clang libclang-rt-dev libgtest-dev libbenchmark-dev libtinygltf-dev python3 python3-numpy python3-pil
  qemu-user) # the tests' processors of other makers

case "${1:-}" in
  "") packages+=("${extras[@]}") ;;
  --minimal) ;;
  *) sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if (( ${#missing[@]} == 0 )); then
  exit 0
fi

as_root=()
if (( EUID != 0 )); then
  command -v sudo >/dev/null || { echo "install-dependencies.sh: run as root to install: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -qq && "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi

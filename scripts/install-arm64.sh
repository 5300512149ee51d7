#!/usr/bin/env bash
# Installs what the arm64 preset is cross-compiled with and run by, on Debian 12: the compiler and qemu-user from the
# distribution (as root, or where sudo works), and the 64-bit Arm versions of facet's libraries, unpacked into
# build/arm64-sysroot: the machine's own packages are left alone. Does nothing when everything is there.
#   scripts/install-arm64.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if (( $# > 0 )); then
  sed -n '2,5s/^# \{0,1\}//p' "scripts/install-arm64.sh"
  [[ $1 == --help || $1 == -h ]] && exit 0
  exit 2
fi

tools=(cmake ninja-build g++-aarch64-linux-gnu qemu-user)
libraries=(libc6-dev libstdc++-12-dev libglm-dev libhwy-dev libtbb-dev nlohmann-json3-dev libdraco-dev
  libmeshoptimizer-dev libpng-dev libdeflate-dev libjpeg-dev libwebp-dev libcli11-dev libgtest-dev libtinygltf-dev)
sysroot=$PWD/build/arm64-sysroot
stamp=$sysroot/packages

missing=()
for package in "${tools[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if (( ${#missing[@]} == 0 )) && [[ "$(cat "$stamp" 2>/dev/null)" == "${libraries[*]}" ]]; then
  exit 0
fi

mkdir -p build
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
quietly() {
  "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; echo "install-arm64.sh: failed: $*" >&2; exit 1; }
}

if (( ${#missing[@]} > 0 )); then
  as_root=()
  if (( EUID != 0 )); then
    command -v sudo >/dev/null || { echo "install-arm64.sh: run as root to install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  echo "installing: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  quietly "${as_root[@]}" apt-get update
  quietly "${as_root[@]}" apt-get install -y --no-install-recommends "${missing[@]}"
fi

# An apt of its own, for a machine of that architecture on which nothing is installed.
echo "unpacking 64-bit Arm libraries into build/arm64-sysroot"
mkdir -p "$scratch"/{lists,archives}/partial "$scratch/root"
: >"$scratch/status"
cat >"$scratch/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Install-Recommends "false";
APT::Sandbox::User "";
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
#clear DPkg::Pre-Install-Pkgs;
Debug::NoLocking "true";
Dir::State "$scratch";
Dir::State::lists "$scratch/lists";
Dir::State::status "$scratch/status";
Dir::Cache "$scratch";
Dir::Cache::archives "$scratch/archives";
END
export APT_CONFIG=$scratch/apt.conf
quietly apt-get update
quietly apt-get install -y --download-only "${libraries[@]}"
for package in "$scratch"/archives/*.deb; do
  quietly dpkg-deb --extract "$package" "$scratch/root"
done
# Links that start at the root would leave the folder.
find "$scratch/root" -type l -lname '/*' -printf '%P\t%l\n' | while IFS=$'\t' read -r link target; do
  ln -sfn "$(realpath -m --relative-to "$(dirname "$scratch/root/$link")" "$scratch/root$target")" "$scratch/root/$link"
done
# Draco's package names files from the root too.
sed -i 's|"/usr|"${CMAKE_SYSROOT}/usr|' "$scratch"/root/usr/lib/aarch64-linux-gnu/cmake/draco/draco-targets*.cmake
rm -rf "$sysroot"
mv "$scratch/root" "$sysroot"
echo "${libraries[*]}" >"$stamp"

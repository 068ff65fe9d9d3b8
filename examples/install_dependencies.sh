#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what colmap_curvix is built from, on Debian 12, Ubuntu 22.04 and
# later. Does nothing where all of it is there already.
#
#   examples/install_dependencies.sh            for the program
#   examples/install_dependencies.sh --python   and for pycurvix
#   examples/install_dependencies.sh --tests    and for all tests
set -euo pipefail

# libopencv-dev holds OpenCV's CMake configuration, libpcl-dev PCL's, and brings
# libgdal-dev with it. dpkg-dev and file are for the target `package`.
packages=(
  cmake dpkg-dev file g++ git ninja-build
  libboost-program-options-dev libceres-dev libeigen3-dev
  libgoogle-glog-dev libjs-three libnanoflann-dev libopencv-dev
  libpcl-dev libzip-dev nlohmann-json3-dev
)
python_packages=(pybind11-dev python3-dev python3-numpy)
case "${1:-}" in
  "") ;;
  --python) packages+=("${python_packages[@]}") ;;
  --tests)
    packages+=("${python_packages[@]}" colmap libbenchmark-dev libgmock-dev
      libgtest-dev python3-ezdxf python3-jsonschema python3-matplotlib
      python3-pil python3-scipy python3-vtk9)
    ;;
  *)
    echo "Usage: $0 [--python | --tests]" >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "This system has no apt-get: nothing is installed. The build needs" \
    "what these Debian packages hold; CMake says what it does not find:"
  printf '  %s\n' "${packages[@]}"
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  state="$(dpkg-query --show --showformat='${db:Status-Status}' \
    "$package" 2>/dev/null || true)"
  [[ "$state" == installed* ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Packages are missing, and without sudo only root can install them:" \
      "apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${missing[*]}"
# The ${a[@]+...} spelling is for an empty array under `set -u` in old shells.
run_apt() {
  ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
    apt-get --quiet --quiet -o Dpkg::Use-Pty=0 "$@"
}
run_apt update
run_apt install --yes --no-install-recommends "${missing[@]}" >/dev/null

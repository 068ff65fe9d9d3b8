#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages, installs them on the same Debian (12 or 13) that
# holds nothing else, uses them there, and removes them. As root, with
# debootstrap, lintian and network.
#
#   tests/packages/deb.sh [folder for the clean Debian: build-deb/clean]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
root="${1:-build-deb/clean}"
# shellcheck source=/dev/null
suite="$(. /etc/os-release && echo "$VERSION_CODENAME")"

step() { printf '\n== %s\n' "$*"; }

# What packages put on the disk; caches and lists of packages aside.
files_of_system() {
  find "$root"/{etc,opt,usr} ! -name '*cache*' ! -name '*~' -printf '%P\n' | sort
}

# In the clean Debian, with /proc, which goes with this process.
inside() {
  # shellcheck disable=SC2016  # for the inner shell to expand
  unshare --mount bash -ec 'mount -t proc proc "$1/proc"
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive chroot "$@"' - "$root" "$@"
}

packages_of_system() {
  # shellcheck disable=SC2016  # dpkg-query's own
  inside dpkg-query --show --showformat='${Package}\n' | sort --unique
}

step "1 of 5: build the packages"
examples/install_dependencies.sh --python
cmake --preset deb --log-level=NOTICE
rm -f build-deb/*.deb
cmake --build --preset deb --target package
packages=(build-deb/colmap-curvix_*.deb build-deb/python3-curvix_*.deb)
# Who builds the package for others names an address.
lintian --allow-root --fail-on error,warning \
  --suppress-tags malformed-contact "${packages[@]}"
# With another BLAS it runs, too.
if dpkg-deb --field "${packages[0]}" Depends | grep --fixed-strings atlas; then
  echo "The package needs ATLAS" >&2
  exit 1
fi

step "2 of 5: a clean $suite"
if [[ ! -e "$root/var/lib/apt/lists" ]]; then
  debootstrap --variant=minbase --include=man-db,netbase "$suite" "$root"
fi
inside apt-get -qq -o Dpkg::Use-Pty=0 update
files_of_system >build-deb/before.txt
packages_of_system >build-deb/packages_before.txt

step "3 of 5: install"
cp "${packages[@]}" "$root"
inside apt-get -qq -o Dpkg::Use-Pty=0 install --yes --no-install-recommends \
  "${packages[@]/#build-deb/}" >/dev/null
inside dpkg --verify colmap-curvix python3-curvix

step "4 of 5: use"
inside colmap_curvix help >/dev/null
inside man --pager=cat colmap_curvix | head -5
inside test -s /usr/share/doc/colmap-curvix/copyright
inside test -s /usr/share/colmap-curvix/blender/curvix_blender.py
inside test -s /usr/share/colmap-curvix/freecad/curvix.FCMacro
inside colmap_curvix synthesize --workspace_path /root/part
inside colmap_curvix --workspace_path /root/part \
  --output_formats ply,obj,pcd,txt,json,dxf,step,vtp,glb,svg,colmap,html
inside colmap_curvix evaluate --curves_path /root/part/curvix/0/curves.ply \
  --truth_path /root/part/gt.txt
cat >"$root/root/use.py" <<'END'
import pycurvix

curves = pycurvix.reconstruct('/root/part', output_path='/root/part/again')
curves.select(curves.lengths() > 0.5).write('/root/part/long.dxf')
print(curves, pycurvix.evaluate(curves, '/root/part/gt.txt')['F5'])
END
inside python3 /root/use.py
inside cmp /root/part/curvix/0/curves.ply /root/part/again/curves.ply
rm -r "$root/root/part" "$root/root/use.py"

step "5 of 5: remove"
# With all that came with them: apt keeps what it suggests itself, as GnuPG.
mapfile -t came < <(packages_of_system |
  comm -13 build-deb/packages_before.txt -)
inside apt-get -qq -o Dpkg::Use-Pty=0 purge --yes "${came[@]}" >/dev/null
rm "$root"/*.deb
files_of_system | diff build-deb/before.txt -
echo "Installed, used and removed; nothing is left of them:"
stat --format='%s bytes: %n' "${packages[@]}"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian package, installs it on a Debian 12 that holds nothing else,
# uses it there, and removes it. As root, with debootstrap, lintian and network.
#
#   tests/packages/deb.sh [folder for the Debian 12: build-deb/debian-12]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
root="${1:-build-deb/debian-12}"

step() { printf '\n== %s\n' "$*"; }

# What packages put on the disk; caches and lists of packages aside.
files_of_system() {
  find "$root"/{etc,opt,usr} ! -name '*cache*' ! -name '*~' -printf '%P\n' | sort
}

# In the Debian 12, with /proc, which goes with this process.
inside() {
  # shellcheck disable=SC2016  # for the inner shell to expand
  unshare --mount bash -ec 'mount -t proc proc "$1/proc"
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive chroot "$@"' - "$root" "$@"
}

step "1 of 5: build the package"
examples/install_dependencies.sh
cmake --preset deb --log-level=NOTICE
rm -f build-deb/*.deb
cmake --build --preset deb --target package
package="$(echo build-deb/colmap-curvix_*.deb)"
# Who builds the package for others names an address.
lintian --allow-root --fail-on error,warning \
  --suppress-tags malformed-contact "$package"

step "2 of 5: a clean Debian 12"
if [[ ! -e "$root/var/lib/apt/lists" ]]; then
  debootstrap --variant=minbase --include=man-db bookworm "$root"
fi
inside apt-get -qq -o Dpkg::Use-Pty=0 update
files_of_system >build-deb/before.txt

step "3 of 5: install"
cp "$package" "$root/package.deb"
inside apt-get -qq -o Dpkg::Use-Pty=0 install --yes --no-install-recommends \
  /package.deb >/dev/null
inside dpkg --verify colmap-curvix

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
rm -r "$root/root/part"

step "5 of 5: remove"
inside apt-get -qq -o Dpkg::Use-Pty=0 purge --yes --autoremove colmap-curvix >/dev/null
rm "$root/package.deb"
files_of_system | diff build-deb/before.txt -
echo "Installed, used and removed: $(basename "$package")," \
  "$(stat --format=%s "$package") bytes; nothing of it is left."

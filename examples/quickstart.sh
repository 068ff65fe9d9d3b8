#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to curves: installs what is missing, builds
# build/bin/colmap_curvix, photographs a synthetic part whose edges are known
# exactly, turns the photographs into curves and compares the two.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/bin/colmap_curvix
workspace=build/quickstart

step() { printf '\n== %s\n' "$*"; }

# score <name>: a number of the evaluation of all kinds, with one decimal.
score() {
  local LC_ALL=C
  printf '%.1f' \
    "$(sed -E 's/,"kinds":.*//; s/.*"'"$1"'":(-?[0-9][0-9.e+-]*).*/\1/' \
      <<<"$scores")"
}

step "1 of 4: install what the build needs"
examples/install_dependencies.sh

step "2 of 4: build $program"
cmake --preset release --log-level=NOTICE
cmake --build --preset release

step "3 of 4: photograph a part whose edges are known"
rm -rf "$workspace"
"$program" synthesize --workspace_path "$workspace"

step "4 of 4: turn the photographs into curves"
"$program" --workspace_path "$workspace"

scores="$("$program" evaluate --json \
  --curves_path "$workspace/curvix/0/curves.ply" \
  --truth_path "$workspace/gt.txt")"
cat <<END

The curves are in $workspace/curvix/0. Open viewer.html in a browser, or
curves.ply in MeshLab or Blender.

Compared with the exact edges of the part ("on": within 0.5 % of its length):
  $(score Rv5) % of the edges that the photographs show are on a curve
  $(score P5) % of the length of the curves is on an edge
  $(score tangent) degrees is the median error of their direction

Now yours:  $program --workspace_path <a COLMAP workspace>
END

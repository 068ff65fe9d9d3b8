#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The one command, and what it leaves behind.
#
#   examples/01_curves_from_workspace.sh proj [options of colmap_curvix]
#
# proj is a COLMAP workspace: photographs in proj/images and their poses in
# proj/sparse/0 or proj/dense/0/sparse, as COLMAP's automatic_reconstructor or
# mapper write them. To have one to try:
#
#   build/bin/colmap_curvix synthesize --workspace_path proj
#
# COLMAP_CURVIX names another program than build/bin/colmap_curvix.
set -euo pipefail
if (($# == 0)); then
  echo "Usage: $0 <workspace> [options]" >&2
  exit 2
fi
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="${COLMAP_CURVIX:-$here/../build/bin/colmap_curvix}"
workspace="$1"
shift

code=0
summary="$("$program" --workspace_path "$workspace" "$@")" || code=$?
echo "$summary"
if ((code != 0)); then exit "$code"; fi
results="$(sed -n 's/^Written to //p' <<<"$summary")"

echo
echo "What it left behind:"
find "$results" -type f -printf '%9s bytes  %p\n' | sort -k 3

curves="$results/curves.txt"
if [[ -f "$curves" ]]; then
  echo
  echo "How $curves begins:"
  head -n 6 "$curves" | cut -c 1-72
fi

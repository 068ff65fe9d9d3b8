#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Times the whole program, from files to files, and prints one table: synthetic
# views from all around one part, of growing numbers and pixels, and scenes of
# the data folder, photographs among them, where there is one.
#
#   tests/benchmarks/run.sh [program] [scene ...]
#
# `scene` is a folder below the data folder ($CURVIX_DATA, else ../shared/data
# beside the source tree). CPU seconds are those of one thread.
set -euo pipefail
root="$(cd "$(dirname "$0")/../.." && pwd)"
program="${1:-$root/build/bin/colmap_curvix}"
shift $(($# > 0 ? 1 : 0))
data="${CURVIX_DATA:-$root/../shared/data}"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

# measure <name> <workspace>: prints a row.
measure() {
  local threads
  for threads in 1 2; do
    "$program" --workspace_path "$2" --output_path "$folder/out$threads" \
      --clean --num_threads "$threads" >/dev/null 2>"$folder/log" ||
      { tail -n 1 "$folder/log" >&2; return 0; }
  done
  python3 - "$1" "$folder" <<'PY'
import json
import sys

name, folder = sys.argv[1:]
one, two = (json.load(open(f"{folder}/out{n}/report.json")) for n in (1, 2))
run = one["run"]
views = one["input"]["num_views"]
stage = {s["name"]: s["cpu_seconds"] for s in run["stages"]}
group = stage.get("link_edges", 0) + stage.get("grow_curves", 0)
rest = run["cpu_seconds"] - stage["detect_edges"] - stage["sketch_edges"] - group
counts = {s["name"]: s["counts"] for s in one["stages"]}
print(f"| {name} | {views} | {counts['detect_edges']['edges']} "
      f"| {counts['sketch_edges']['3D edges']} | {run['cpu_seconds']:.1f} "
      f"| {stage['detect_edges']:.1f} | {stage['sketch_edges']:.1f} "
      f"| {group:.1f} | {rest:.1f} "
      f"| {1000 * run['cpu_seconds'] / views:.0f} "
      f"| {two['run']['wall_seconds'] / run['wall_seconds']:.2f} "
      f"| {run['peak_memory_mb']:.0f} |")
PY
  rm -rf "$folder"/out1 "$folder"/out2
}

# part <views> <pixels>
part() {
  "$program" synthesize --workspace_path "$folder/part" --num_views "$1" \
    --width "$2" --height "$2" >/dev/null 2>&1
  measure "part, $2 px" "$folder/part"
  rm -rf "$folder/part"
}

echo "| scene | views | 2D edges | 3D edges | CPU s | detect | sketch" \
  "| link, grow | rest | CPU ms / view | wall, 2 threads / 1 | MB |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
if (($# == 0)); then
  for views in 50 100 200 400; do part "$views" 240; done
  for views in 50 100 200 400; do part "$views" 800; done
  for pixels in 480 960; do part 50 "$pixels"; done
  set -- abc_nef/00000006 cad/abc_0_13 dino_ring dtu_scan24 \
    photos/sceaux_castle photos/room photos/building43 photos/desk photos/entry
fi
for scene in "$@"; do
  if [[ -d "$data/$scene" ]]; then measure "$scene" "$data/$scene"; fi
done

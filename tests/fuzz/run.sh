#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzzers with clang (Debian: clang libclang-rt-14-dev) and runs each
# for some minutes, one after the other; stops at the first that finds something.
#
#   tests/fuzz/run.sh [minutes of each: 10] [reader ...: all]
#
# What they learn stays in build-fuzz/corpus and is gone on from; the figures go
# to build-fuzz/fuzz.log.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
minutes="${1:-10}"
readers=("${@:2}")
[[ -d /dev/shm ]] && export TMPDIR=/dev/shm # files of readers, in memory

cmake --preset fuzz --log-level=NOTICE
cmake --build --preset fuzz --target fuzzers
if ((${#readers[@]} == 0)); then
  for source in tests/fuzz/*_fuzz.cc; do
    readers+=("$(basename "$source" _fuzz.cc)")
  done
fi

for reader in "${readers[@]}"; do
  corpus="build-fuzz/corpus/$reader"
  log="build-fuzz/fuzz/$reader.log"
  mkdir -p "$corpus"
  CURVIX_FUZZ_SEEDS="$corpus" "build-fuzz/fuzz/${reader}_fuzzer" \
    -max_total_time=$((60 * minutes)) -timeout=10 -rss_limit_mb=2048 \
    -max_len=16384 -print_final_stats=1 -verbosity=1 \
    -artifact_prefix="build-fuzz/fuzz/$reader-" "$corpus" >"$log" 2>&1 || {
    tail -n 40 "$log"
    echo "The input is in build-fuzz/fuzz/$reader-*."
    exit 1
  }
  executions="$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
  echo "$reader: $executions executions in $minutes minutes" |
    tee -a build-fuzz/fuzz.log
done

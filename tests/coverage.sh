#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Counts the lines of each folder of src/, and of plugin/, that the tests reach
# (Debian: lcov). Builds in build-coverage, at -O1: the tests compute a lot.
# Without the tests of faults: runs that are killed, or cannot write files, leave
# broken counters, and every later run says so on stderr.
#
#   tests/coverage.sh [build target ...: everything] [-- ctest arguments]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build="build-coverage"
targets=()
while (($# > 0)) && [[ "$1" != -- ]]; do
  targets+=("$1")
  shift
done
(($# == 0)) || shift

cmake --preset coverage --log-level=NOTICE
cmake --build --preset coverage ${targets[@]+--target "${targets[@]}"}
find "$build" -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)" --timeout 1800 \
  --exclude-regex '^end_to_end/(Colmap)?Faults\.' "$@"

lcov --quiet --capture --directory "$build" --base-directory . --no-external \
  --output-file "$build/coverage.info"
awk -F '[:,]' -v root="$PWD/" '
  /^SF:/ { file = substr($2, length(root) + 1); parts = split(file, part, "/")
           folder = part[1] == "src" && parts > 2 ? "src/" part[2] : part[1] }
  /^DA:/ { line = file ":" $2; of[line] = folder; times[line] += $3 }
  END { for (l in of) { ++lines[of[l]]; if (times[l] > 0) ++reached[of[l]] }
        for (f in lines) if (f ~ /^(src|plugin)/)
          printf "%-22s %6d of %6d lines  %5.1f %%\n",
                 f, reached[f], lines[f], 100 * reached[f] / lines[f] }
' "$build/coverage.info" | sort

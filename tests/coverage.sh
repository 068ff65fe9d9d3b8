#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Counts the lines of each folder of src/, and of plugin/, that the tests reach
# (Debian: lcov). Builds in build-coverage, at -O1: the tests compute a lot.
#
#   tests/coverage.sh [build target ...: everything] [-- ctest arguments]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build-coverage
targets=()
while (($# > 0)) && [[ "$1" != -- ]]; do
  targets+=("$1")
  shift
done
(($# == 0)) || shift

cmake --preset coverage --log-level=NOTICE
cmake --build --preset coverage ${targets[@]+--target "${targets[@]}"}
find "$build" -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)" --timeout 1800 "$@"

lcov --quiet --capture --directory "$build" --base-directory . --no-external \
  --output-file "$build/coverage.info"
awk -F: -v root="$PWD/" '
  /^SF:/ { parts = split(substr($2, length(root) + 1), part, "/")
           folder = part[1] == "src" && parts > 2 ? "src/" part[2] : part[1] }
  /^LF:/ { lines[folder] += $2 }
  /^LH:/ { reached[folder] += $2 }
  END { for (f in lines) if (f ~ /^(src|plugin)/)
          printf "%-22s %6d of %6d lines  %5.1f %%\n",
                 f, reached[f], lines[f], 100 * reached[f] / lines[f] }
' "$build/coverage.info" | sort

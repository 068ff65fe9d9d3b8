#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds everything with warnings as errors and runs
# all tests. The last line is "N passed, N failed, N skipped"; succeeds if none
# failed. A step that fails before the tests counts as one failed test.
set -euo pipefail
if (($# > 0)); then
  echo "usage: tests/run.sh, without arguments" >&2
  exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
results=build-tests/results.xml

# attribute <name>: of the test suite in the results.
attribute() {
  sed -nE '1,/^[[:space:]]*>/ s/^[[:space:]]+'"$1"'="([0-9]+)".*/\1/p' "$results"
}

run() {
  local status=0
  "$@" || status=$?
  if ((status != 0)); then
    echo "'$*' failed; what it says above is the reason."
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
  fi
}

run examples/install_dependencies.sh --tests
run cmake --preset tests --log-level=NOTICE
run cmake --build --preset tests

rm -f "$results"
ctest --preset tests --parallel "$(nproc)" --output-junit results.xml || true
run test -s "$results"

tests="$(attribute tests)"
failed="$(attribute failures)"
skipped="$(($(attribute skipped) + $(attribute disabled)))"
echo "$((tests - failed - skipped)) passed, $failed failed, $skipped skipped"
((failed == 0 && tests > 0))

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs tests under sanitizers.
#
#   tests/sanitize.sh address   all of them: addresses, leaks, undefined behaviour
#   tests/sanitize.sh thread    those of parallel code: data races
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  address)
    cmake --preset asan --log-level=NOTICE
    cmake --build --preset asan
    ctest --preset asan --parallel "$(nproc)" --timeout 1800
    ;;
  thread)
    declare -A cases=(
      [base_tests]='Concatenate.*:ParallelFor*'
      [end_to_end_tests]='ProgramAlone.*:ProgramRun.*'
      [invariance_tests]='*ReconstructionInvariance.*'
      [pipeline_tests]='ReconstructCurves.*:*WhyEmptyOf.*'
      [poses_tests]='RefinePosesWithCurves.*')
    export TSAN_OPTIONS="halt_on_error=1:suppressions='$PWD/tests/thread_sanitizer.supp'"
    cmake --preset tsan --log-level=NOTICE
    cmake --build --preset tsan --target "${!cases[@]}"
    for program in "${!cases[@]}"; do
      "build-tsan/tests/$program" --gtest_filter="${cases[$program]}"
    done
    ;;
  *)
    sed -n 's/^#   / /p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac

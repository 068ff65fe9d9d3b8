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
    tests=(base_parallel_test end_to_end_program_test
      invariance_reconstruction_invariance_test pipeline_reconstruct_test
      poses_refine_poses_test)
    export TSAN_OPTIONS="halt_on_error=1:suppressions=$PWD/tests/thread_sanitizer.supp"
    cmake --preset tsan --log-level=NOTICE
    cmake --build --preset tsan --target "${tests[@]}"
    for test in "${tests[@]}"; do
      "build-tsan/tests/$test"
    done
    ;;
  *)
    sed -n 's/^#   / /p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Lets each fault of faults_test.cc strike often, the program as it was built.
#
#   tests/end_to_end/faults.sh [rounds: 30] [build folder: build-tests]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
CURVIX_FAULT_ROUNDS="${1:-30}" "${2:-build-tests}/tests/end_to_end_tests" \
  --gtest_filter='*Faults.*'

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <curvix/status.h>
#include <functional>

namespace curvix {

// Called by a stage with (done, total) steps, or (0, 0); false asks it to stop.
// Its result is then not to be used.
using StepDone = std::function<bool(int, int)>;

// Of a run that the user has stopped.
inline Status CancelledStatus() {
  return {StatusCode::kCancelled, "Interrupted; nothing was written"};
}

}  // namespace curvix

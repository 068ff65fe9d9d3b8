// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <curvix/status.h>

namespace curvix {

// Of a run that the user has stopped.
inline Status CancelledStatus() {
  return {StatusCode::kCancelled, "interrupted; nothing was written"};
}

}  // namespace curvix

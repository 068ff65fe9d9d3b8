// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <sstream>
#include <stdexcept>

// Throws std::logic_error with file, line and `message` (a stream expression)
// when a precondition or an invariant does not hold. Active in every build
// type.
#define CURVIX_CHECK(condition, message)                                     \
  do {                                                                       \
    if (!(condition)) {                                                      \
      std::ostringstream curvix_check_text;                                  \
      curvix_check_text << __FILE__ << ":" << __LINE__ << ": " << #condition \
                        << " does not hold: " << message;                    \
      throw std::logic_error(curvix_check_text.str());                       \
    }                                                                        \
  } while (false)

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The only door to threads.
#pragma once

#include <cstddef>
#include <functional>

namespace curvix {

// Calls f(i) for every i in [0, n), on up to num_threads threads; on as many as
// there are cores if that is not positive. f may write to slot i and nothing
// else, so results do not depend on the number of threads. If calls throw, the
// exception of the smallest index is rethrown once the others have ended, of
// which some may be left out. Calls must not be nested.
void ParallelFor(std::size_t n,
                 int num_threads,
                 const std::function<void(std::size_t)>& f);

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). All threads are started here.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

namespace curvix {

// Calls f(i) for every i in [0, n), on up to num_threads threads; on as many as
// there are cores if that is not positive. f may write to slot i and nothing
// else, so results do not depend on the number of threads. If calls throw, the
// exception of the smallest index is rethrown once the others have ended, of
// which some may be left out. Calls must not be nested.
void ParallelFor(std::size_t n,
                 int num_threads,
                 const std::function<void(std::size_t)>& f);

// As ParallelFor, until a call returns false or keep_going does: no further
// index is handed out then. All smaller ones have been, and are finished.
// keep_going is asked by the calling thread only, after each of its own calls:
// it is given the number of calls that have ended.
void ParallelForWhile(std::size_t n,
                      int num_threads,
                      const std::function<bool(std::size_t)>& f,
                      const std::function<bool(std::size_t)>& keep_going);

// The elements of all parts in one vector, in order.
template <typename T>
std::vector<T> Concatenate(std::vector<std::vector<T>> parts) {
  std::size_t size = 0;
  for (const std::vector<T>& part : parts) size += part.size();
  std::vector<T> whole;
  whole.reserve(size);
  for (std::vector<T>& part : parts) {
    whole.insert(whole.end(),
                 std::make_move_iterator(part.begin()),
                 std::make_move_iterator(part.end()));
  }
  return whole;
}

}  // namespace curvix

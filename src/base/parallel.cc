// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace curvix {
namespace {

// Keeps the exception of the smallest index.
class FirstError {
 public:
  void Keep(std::size_t index, std::exception_ptr error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (error_ == nullptr || index < index_) {
      index_ = index;
      error_ = std::move(error);
    }
  }
  void Rethrow() const {
    if (error_ != nullptr) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = 0;
  std::exception_ptr error_;
};

// Neighbours often read the same memory, so a thread takes several at once, but
// few enough that all threads end together.
std::size_t BlockSize(std::size_t n, int num_threads) {
  constexpr std::size_t kBlocksPerThread = 64;
  constexpr std::size_t kMaxSize = 64;
  return std::clamp<std::size_t>(
      n / (kBlocksPerThread * static_cast<std::size_t>(num_threads)),
      1,
      kMaxSize);
}

// `requested` if positive, else the number of cores.
int ResolveNumThreads(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

void ParallelFor(std::size_t n,
                 int num_threads,
                 const std::function<void(std::size_t)>& f) {
  const std::size_t size = BlockSize(n, ResolveNumThreads(num_threads));
  ParallelForWhile((n + size - 1) / size,
                   num_threads,
                   [&](std::size_t block) {
                     const std::size_t end = std::min(n, (block + 1) * size);
                     for (std::size_t i = block * size; i < end; ++i) f(i);
                     return true;
                   },
                   [](std::size_t) { return true; });
}

void ParallelForWhile(std::size_t n,
                      int num_threads,
                      const std::function<bool(std::size_t)>& f,
                      const std::function<bool(std::size_t)>& keep_going) {
  FirstError error;
  // Handing out indices one by one balances uneven work; which thread computes
  // a slot has no influence on what is written there.
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> num_ended = 0;
  const auto work = [&](bool may_ask) {
    for (std::size_t i = next++; i < n; i = next++) {
      bool is_asking = false;
      try {
        if (!f(i)) next = n;
        ++num_ended;
        is_asking = may_ask;
        if (may_ask && !keep_going(num_ended)) next = n;
      } catch (...) {
        error.Keep(i, std::current_exception());
        if (is_asking) next = n;
      }
    }
  };
  const std::size_t num_helpers =
      std::min<std::size_t>(
          n, static_cast<std::size_t>(ResolveNumThreads(num_threads))) -
      std::min<std::size_t>(n, 1);
  std::vector<std::thread> helpers;
  helpers.reserve(num_helpers);
  try {
    for (std::size_t i = 0; i < num_helpers; ++i) {
      helpers.emplace_back(work, false);
    }
  } catch (const std::exception&) {
    // No memory for another thread: those that there are do the work.
  }
  work(true);
  for (std::thread& helper : helpers) helper.join();
  error.Rethrow();
}

}  // namespace curvix

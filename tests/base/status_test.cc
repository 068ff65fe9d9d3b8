// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/status.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <utility>

namespace curvix {
namespace {

TEST(Result, GivesItsValueAwayWhenItIsMoved) {
  auto number = std::make_unique<int>(7);
  const int* place = number.get();
  Result<std::unique_ptr<int>> result(std::move(number));
  const std::unique_ptr<int> taken = *std::move(result);
  EXPECT_EQ(taken.get(), place);
}

TEST(Result, ThrowsWhereThereIsNoValue) {
  const Result<int> failure = Status(StatusCode::kInternal, "why");
  EXPECT_FALSE(failure.ok());
  EXPECT_EQ(failure.status().message(), "why");
  EXPECT_THROW((void)*failure, std::logic_error);
}

}  // namespace
}  // namespace curvix

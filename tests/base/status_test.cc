// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/status.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
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

Result<int> Half(int number) {
  if (number % 2 == 0) return number / 2;
  return Status::InvalidArgument(std::to_string(number) + " is odd");
}

Result<int> Quarter(int number) {
  CURVIX_ASSIGN_OR_RETURN(const int half, Half(number));
  int quarter = 0;
  CURVIX_ASSIGN_OR_RETURN(quarter, Half(half));
  return quarter;
}

Status CheckQuarter(int number) {
  CURVIX_RETURN_IF_ERROR(Quarter(number).status());
  if (number > 0) CURVIX_RETURN_IF_ERROR(Half(1).status());
  return {};
}

TEST(Status, IsHandedOnToTheCaller) {
  EXPECT_EQ(*Quarter(8), 2);
  EXPECT_EQ(Quarter(7).status().message(), "7 is odd");
  EXPECT_EQ(Quarter(6).status().message(), "3 is odd");
  EXPECT_TRUE(CheckQuarter(0).ok());
  EXPECT_EQ(CheckQuarter(8).message(), "1 is odd");
  EXPECT_EQ(CheckQuarter(5).code(), StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "model/connectivity_graph.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace curvix {
namespace {

TEST(ConnectivityGraph, IsValidIfEveryLinkIsMutual) {
  EXPECT_NO_THROW(Validate(ConnectivityGraph()));
  EXPECT_NO_THROW(
      Validate({{1, std::nullopt}, {std::nullopt, 0}, {false, true}}));
}

TEST(ConnectivityGraph, IsInvalidIfALinkIsOneSidedOrLeadsNowhere) {
  EXPECT_THROW(
      Validate(
          {{1, std::nullopt}, {std::nullopt, std::nullopt}, {false, false}}),
      std::logic_error);
  EXPECT_THROW(Validate({{7}, {std::nullopt}, {false}}), std::logic_error);
  EXPECT_THROW(Validate({{-1}, {std::nullopt}, {false}}), std::logic_error);
  EXPECT_THROW(Validate({{0}, {0}, {false}}), std::logic_error);
  EXPECT_THROW(Validate({{std::nullopt}, {}, {false}}), std::logic_error);
}

}  // namespace
}  // namespace curvix

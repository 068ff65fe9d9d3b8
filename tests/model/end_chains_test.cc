// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_chains.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/model/end_ties.h"

namespace curvix {
namespace {

// "2 0- 1" for a chain, "(0 1)" for a closed one; - marks flipped items.
std::string Drawing(const EndChain& chain) {
  std::string text;
  for (const ChainItem& link : chain.items) {
    if (!text.empty()) text += ' ';
    text += std::to_string(link.item) + (link.flipped ? "-" : "");
  }
  return chain.closed ? "(" + text + ")" : text;
}

std::vector<std::string> Drawings(const EndTies& ties) {
  std::vector<std::string> drawings;
  for (const EndChain& chain : FollowEnds(ties)) {
    drawings.push_back(Drawing(chain));
  }
  return drawings;
}

TEST(FollowEnds, GivesEveryItemOnce) {
  EXPECT_EQ(Drawings({}), std::vector<std::string>{});
  EXPECT_EQ(Drawings(Tied(3, {})), (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_EQ(Drawings(Tied(3, {{Head(2), Tail(0)}})),
            (std::vector<std::string>{"2 0", "1"}));
}

TEST(FollowEnds, FlipsItemsThatAreTiedAtTheSameSide) {
  EXPECT_EQ(Drawings(Tied(2, {{Head(0), Head(1)}})),
            (std::vector<std::string>{"0 1-"}));
  EXPECT_EQ(Drawings(Tied(2, {{Tail(0), Tail(1)}})),
            (std::vector<std::string>{"1- 0"}));
  EXPECT_EQ(Drawings(Tied(3, {{Head(0), Head(1)}, {Tail(1), Head(2)}})),
            (std::vector<std::string>{"0 1- 2-"}));
}

TEST(FollowEnds, ClosesRings) {
  EXPECT_EQ(Drawings(Tied(1, {{Head(0), Tail(0)}})),
            (std::vector<std::string>{"(0)"}));
  EXPECT_EQ(
      Drawings(Tied(
          3, {{Head(0), Head(2)}, {Tail(2), Tail(1)}, {Head(1), Tail(0)}})),
      (std::vector<std::string>{"(0 2- 1)"}));
}

TEST(FollowEnds, RefusesTiesThatAreNotMutual) {
  EndTies ties(4);
  ties[0] = 3;
  EXPECT_THROW((void)FollowEnds(ties), std::logic_error);
  EXPECT_THROW((void)FollowEnds(EndTies(3)), std::logic_error);
}

TEST(TieCheapestFirst, GivesFreeEndsToTheCheapestPair) {
  EXPECT_EQ(TieCheapestFirst({{2, 1, 2}, {1, 1, 4}, {3, 2, 5}}, 3),
            Tied(3, {{1, 4}, {2, 5}}));
  EXPECT_EQ(TieCheapestFirst({{1, 4, 1}, {1, 2, 1}}, 3), Tied(3, {{1, 2}}));
}

}  // namespace
}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "parts/scene_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace curvix {
namespace {

using Places = std::vector<std::vector<Eigen::Vector3d>>;

constexpr double kOverlap = 0.5;

// A row of views one apart; each sees 40 places up to three to either side.
Places Street(int num_views) {
  Places places;
  for (int i = 0; i < num_views; ++i) {
    places.emplace_back();
    for (int k = 0; k < 40; ++k) {
      const double x = i + 3 * std::sin(1.7 * k + i);
      places.back().emplace_back(x, 0.3 * x, std::cos(2.9 * k));
    }
  }
  return places;
}

TEST(PartitionViews, IsOnePartIfAllViewsFit) {
  const auto partition = PartitionViews(Street(10), kOverlap, 10);
  ASSERT_TRUE(partition.ok());
  ASSERT_EQ(partition->parts.size(), 1u);
  EXPECT_TRUE(partition->cuts.empty());
  EXPECT_EQ(partition->parts[0].view_idxs.size(), 10u);
  EXPECT_EQ(partition->parts[0].own_view_idxs.size(), 10u);
  EXPECT_EQ(OwnerOf(*partition, {1e9, -3, 7}), 0);
}

TEST(PartitionViews, GivesEachViewToOnePartInBalance) {
  for (const int num_views : {30, 61, 200}) {
    const auto partition = PartitionViews(Street(num_views), kOverlap, 24);
    ASSERT_TRUE(partition.ok()) << num_views;
    std::vector<int> num_owners(static_cast<std::size_t>(num_views), 0);
    std::size_t least = 1000, most = 0;
    for (const ScenePart& part : partition->parts) {
      EXPECT_LE(part.view_idxs.size(), 24u);
      EXPECT_TRUE(std::includes(part.view_idxs.begin(),
                                part.view_idxs.end(),
                                part.own_view_idxs.begin(),
                                part.own_view_idxs.end()));
      least = std::min(least, part.own_view_idxs.size());
      most = std::max(most, part.own_view_idxs.size());
      for (const int idx : part.own_view_idxs) {
        ++num_owners[static_cast<std::size_t>(idx)];
      }
    }
    EXPECT_EQ(num_owners, std::vector<int>(num_owners.size(), 1));
    EXPECT_LE(most - least, 2u);
  }
}

TEST(PartitionViews, DividesTheOthersBesideAViewThatIsFarOff) {
  Places places = Street(60);
  for (Eigen::Vector3d& place : places[30]) place.z() += 500;
  const auto partition = PartitionViews(places, kOverlap, 24);
  ASSERT_TRUE(partition.ok());
  EXPECT_LE(partition->parts.size(), 5u);
}

TEST(PartitionViews, GivesEachPlaceToOneCore) {
  const auto partition = PartitionViews(Street(100), kOverlap, 24);
  ASSERT_TRUE(partition.ok());
  const auto cores = CoresOf(*partition);
  ASSERT_GT(cores.size(), 3u);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d place(0.13 * i - 10, std::sin(i), std::cos(3 * i));
    int num_owners = 0;
    for (std::size_t k = 0; k < cores.size(); ++k) {
      if (DistanceBeyond(cores[k], place) > 0) continue;
      ++num_owners;
      EXPECT_EQ(OwnerOf(*partition, place), static_cast<int>(k));
    }
    EXPECT_EQ(num_owners, 1);
  }
}

TEST(PartitionViews, GivesAPartAllViewsThatSeeItsSurroundings) {
  const Places places = Street(100);
  const auto partition = PartitionViews(places, kOverlap, 24);
  ASSERT_TRUE(partition.ok());
  const auto cores = CoresOf(*partition);
  for (std::size_t k = 0; k < cores.size(); ++k) {
    for (int i = 0; i < 100; ++i) {
      int num_near = 0;
      for (const auto& place : places[static_cast<std::size_t>(i)]) {
        num_near += DistanceBeyond(cores[k], place) <= 2 * kOverlap;
      }
      const auto& idxs = partition->parts[k].view_idxs;
      const bool is_there = std::binary_search(idxs.begin(), idxs.end(), i);
      EXPECT_EQ(is_there, num_near >= 2) << "part " << k << ", view " << i;
    }
  }
}

// A part of one or two views could not be reconstructed.
TEST(PartitionViews, GivesNoPartFewerThanThreeViewsOfItsOwn) {
  Places far_apart(8);
  for (std::size_t i = 0; i < far_apart.size(); ++i) {
    far_apart[i].emplace_back(100.0 * static_cast<double>(i * i), 0, 0);
  }
  const auto partition = PartitionViews(far_apart, kOverlap, 4);
  ASSERT_TRUE(partition.ok());
  EXPECT_EQ(partition->parts.size(), 2u);
  EXPECT_FALSE(PartitionViews(far_apart, kOverlap, 3).ok());
  // Three are found, between two, which are too few, and four, too many.
  far_apart.resize(9);
  far_apart.back().emplace_back(1e5, 0, 0);
  EXPECT_EQ(PartitionViews(far_apart, kOverlap, 3)->parts.size(), 3u);
}

TEST(PartitionViews, CannotDivideViewsOfOnePlace) {
  Places ring(50);
  for (auto& places : ring) {
    for (int k = 0; k < 40; ++k) {
      places.emplace_back(std::cos(k), std::sin(k), 0.1 * k);
    }
  }
  EXPECT_FALSE(PartitionViews(ring, kOverlap, 49).ok());
  EXPECT_TRUE(PartitionViews(ring, kOverlap, 50).ok());
}

TEST(PartitionViews, SaysHowManyViewsWouldDo) {
  for (const int num_views : {20, 40, 90}) {
    const Status status =
        PartitionViews(Street(num_views), kOverlap, 3).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    const std::string& why = status.message();
    const int fewest = std::stoi(why.substr(why.rfind(' ')));
    EXPECT_LT(fewest, num_views);
    EXPECT_TRUE(PartitionViews(Street(num_views), kOverlap, fewest).ok());
    EXPECT_FALSE(PartitionViews(Street(num_views), kOverlap, fewest - 1).ok());
  }
}

}  // namespace
}  // namespace curvix

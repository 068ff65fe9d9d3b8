// SPDX-License-Identifier: BSD-3-Clause
// Against the edges of another implementation of the same detector. Its files
// count pixels from (1, 1) at the centre of the first one; it rounds colours
// after compositing and grey levels after weighing them, drops edges within
// 10 px of the border, and keeps gradients above 1 (2 at its weakest edge).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/grid_index.h"
#include "edge_detection/curvelets.h"
#include "tests/edge_detection/oriented_edges.h"
#include "tests/support/data_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

fs::path ReferenceFolder() { return DataFolder() / "toed_reference"; }

GrayImage RoundedGrey(const fs::path& path) {
  const cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(image.type(), CV_8UC4);
  GrayImage gray{image.cols, image.rows, {}};
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec4b& bgra = image.at<cv::Vec4b>(y, x);
      const auto over_black = [&](int c) {
        return std::round(bgra[c] * bgra[3] / 255.0);
      };
      gray.pixels.push_back(static_cast<float>(
          std::round(0.114 * over_black(0) + 0.587 * over_black(1) +
                     0.299 * over_black(2))));
    }
  }
  return gray;
}

std::vector<Edge2d> ReadReference(const fs::path& path) {
  std::vector<Edge2d> edges;
  std::ifstream stream(path);
  Edge2d edge;
  while (stream >> edge.position.x() >> edge.position.y() >> edge.angle >>
         edge.strength) {
    edge.position.array() -= 0.5;
    edges.push_back(edge);
  }
  return edges;
}

std::vector<Edge2d> DetectLikeReference(const fs::path& image_path) {
  const GrayImage image = RoundedGrey(image_path);
  std::vector<Edge2d> edges = AcrossGradients(LocateEdges(image, {}, 1));
  OrientEdges(image, 1, /*refine=*/false, &edges);
  return WithoutBorder(std::move(edges), image, 10);
}

std::optional<std::size_t> Find(const GridIndex& index,
                                const std::vector<Edge2d>& edges,
                                const Edge2d& edge,
                                double max_distance_px,
                                double max_angle_deg) {
  std::optional<std::size_t> found;
  index.VisitAround(edge.position, 0.5, [&](const IndexedEdge& candidate) {
    const auto i = static_cast<std::size_t>(candidate.edge_idx);
    const double turn = UndirectedDifference(edges[i].angle, edge.angle);
    if ((edges[i].position - edge.position).norm() <= max_distance_px &&
        RadToDeg(turn) <= max_angle_deg) {
      found = i;
    }
  });
  return found;
}

double ShareFound(const std::vector<Edge2d>& wanted,
                  const std::vector<Edge2d>& edges,
                  double max_distance_px,
                  double max_angle_deg) {
  const GridIndex index(edges, 1);
  const auto found =
      std::count_if(wanted.begin(), wanted.end(), [&](const Edge2d& edge) {
        return Find(index, edges, edge, max_distance_px, max_angle_deg)
            .has_value();
      });
  return static_cast<double>(found) / static_cast<double>(wanted.size());
}

class ReferenceEdges : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(ReferenceFolder())) {
      GTEST_SKIP() << "no reference edges in " << ReferenceFolder()
                   << "; set CURVIX_DATA to the folder of test data";
    }
  }
};

TEST_F(ReferenceEdges, AreFoundAndNothingElse) {
  for (const std::string view : {"0", "7"}) {
    const auto reference =
        ReadReference(ReferenceFolder() / ("Edge_" + view + "_t1.txt"));
    const auto edges =
        DetectLikeReference(ReferenceFolder() / (view + "_colors.png"));
    ASSERT_GT(reference.size(), 3000u);
    const double found = ShareFound(reference, edges, 0.01, 90);
    const double found_with_angle = ShareFound(reference, edges, 0.01, 0.1);
    const double extra = 1 - ShareFound(edges, reference, 0.01, 90);
    RecordProperty("found_" + view, std::to_string(found));
    RecordProperty("found_with_angle_" + view,
                   std::to_string(found_with_angle));
    EXPECT_EQ(found, 1) << "view " << view;
    EXPECT_GE(found_with_angle, 0.999) << "view " << view;
    EXPECT_LE(extra, 0.001) << "view " << view;
  }
}

// Each row is an edge and three others of its contour, in order, 0-based.
TEST_F(ReferenceEdges, HaveTheirNeighborsAmongTheReferenceCurvelets) {
  const auto reference = ReadReference(ReferenceFolder() / "Edge_0_t1.txt");
  std::ifstream stream(ReferenceFolder() / "Curvelets_0_t1.txt");
  std::set<std::pair<std::int32_t, std::int32_t>> adjacent;
  std::int32_t anchor, first, second, third;
  while (stream >> anchor >> first >> second >> third) {
    adjacent.insert({anchor, first});
    adjacent.insert({first, anchor});
  }
  ASSERT_GT(adjacent.size(), 4000u);
  const auto links = LinkNeighbors(reference, EdgeDetectionOptions());
  int num_links = 0, num_agreeing = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (const auto& other : {links[i].previous, links[i].next}) {
      if (!other) continue;
      ++num_links;
      const auto self = static_cast<std::int32_t>(i);
      num_agreeing += static_cast<int>(adjacent.count({self, *other}));
    }
  }
  RecordProperty("links", num_links);
  RecordProperty("agreeing", num_agreeing);
  EXPECT_GT(num_links, 7500);
  EXPECT_GT(num_agreeing, 0.95 * num_links);
}

}  // namespace
}  // namespace curvix

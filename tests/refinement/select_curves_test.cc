// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/select_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/refinement/drawn_curves.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kOptions = {
    .min_evidence = 12, .sigma_scale_px = 0.08, .max_blurred_share = 0.2};
constexpr double kGoodScatterPx = 0.1;

struct Drawn {
  double evidence = 40;
  double sigma_px = 0.05;
  double scatter_px = kGoodScatterPx;
  double blurred_share = 0;
};

// Curves in two views, in which edges as sharp as all others support them but
// for the share that is blurred.
class Scene {
 public:
  Scene() : views_(2, FrontalViews().front()), edge_maps_(2) {
    for (int k = 0; k < 1000; ++k) {  // what else the views show
      for (EdgeMap& map : edge_maps_) {
        map.edges.push_back(
            {{0.5 * k, 5}, 0, 20, static_cast<float>(kSharpness)});
      }
    }
  }

  // A line of 200 samples, the blurred ones of which are seen in view 1.
  void Add(const Drawn& drawn) {
    Curve curve = Line(InPlane(0, 0), InPlane(199, 0));
    const std::size_t count = curve.samples.size();
    for (std::size_t k = 0; k < count; ++k) {
      CurveSample& sample = curve.samples[k];
      sample.evidence = drawn.evidence;
      sample.sigma = drawn.sigma_px * kPixel;
      const bool is_blurred = static_cast<double>(k) + 0.5 <
                              drawn.blurred_share * static_cast<double>(count);
      sample.support = {
          AddEdge(sample,
                  is_blurred,
                  drawn.scatter_px / 1.4826 * (k % 2 == 0 ? 1 : -1))};
    }
    curves_.push_back(std::move(curve));
  }

  SelectedCurves Select(const CurveRefinementOptions& options = kOptions,
                        double unit = 1) const {
    return SelectCurves(
        Scaled(curves_, unit), Scaled(views_, unit), edge_maps_, options, 1);
  }

 private:
  static constexpr double kSharpness = 0.7;

  // An edge `offset_px` beside the sample.
  EdgeRef AddEdge(const CurveSample& sample,
                  bool is_blurred,
                  double offset_px) {
    const std::int32_t view_idx = is_blurred ? 1 : 0;
    const PosedView& view = views_[static_cast<std::size_t>(view_idx)];
    Edge2d edge;
    edge.position = view.Pixel(view.InCamera(sample.position)) +
                    Eigen::Vector2d(0, offset_px);
    edge.strength = 10;
    edge.sharpness =
        static_cast<float>(is_blurred ? kSharpness / 2 : kSharpness);
    auto& edges = edge_maps_[static_cast<std::size_t>(view_idx)].edges;
    edges.push_back(edge);
    return {view_idx, static_cast<std::int32_t>(edges.size() - 1)};
  }

  std::vector<PosedView> views_;
  std::vector<EdgeMap> edge_maps_;
  std::vector<Curve> curves_;
};

enum class Kind { kEdge, kOccludingContour, kNone };

// What becomes of a curve in a scene with a good and longer one.
Kind KindOf(const Drawn& drawn) {
  Scene scene;
  scene.Add({});
  scene.Add({});
  scene.Add(drawn);
  const SelectedCurves selected = scene.Select();
  if (selected.edges.size() == 3) return Kind::kEdge;
  return selected.occluding_contours.size() == 1 ? Kind::kOccludingContour
                                                 : Kind::kNone;
}

TEST(SelectCurves, AsksForEvidence) {
  EXPECT_EQ(KindOf({.evidence = 12.001}), Kind::kEdge);
  EXPECT_EQ(KindOf({.evidence = 11.999}), Kind::kNone);
}

TEST(SelectCurves, AsksForMoreWhereEdgesScatterMoreThanInThisScene) {
  for (const double ratio : {1.0, 1.5, 3.0}) {
    const double scatter = 3 * kGoodScatterPx * ratio;
    const double needed = 12 * ratio * ratio;
    EXPECT_EQ(KindOf({.evidence = 1.001 * needed, .scatter_px = scatter}),
              Kind::kEdge);
    EXPECT_NE(KindOf({.evidence = 0.999 * needed, .scatter_px = scatter}),
              Kind::kEdge);
  }
}

TEST(SelectCurves, AsksForMoreWherePositionsAreLessSure) {
  for (const double ratio : {1.0, 1.5, 3.0}) {
    const double needed = 12 * ratio * ratio;
    // Sigmas assume a scatter of 0.15 px, and the edges scatter less.
    const double sigma = ratio * 0.08 * 0.15 / kGoodScatterPx;
    EXPECT_EQ(KindOf({.evidence = 1.001 * needed, .sigma_px = sigma}),
              Kind::kEdge);
    EXPECT_NE(KindOf({.evidence = 0.999 * needed, .sigma_px = sigma}),
              Kind::kEdge);
  }
}

TEST(SelectCurves, TakesConfirmedCurvesThatScatterForOccludingContours) {
  EXPECT_EQ(KindOf({.evidence = 20, .scatter_px = 0.5}),
            Kind::kOccludingContour);
  EXPECT_EQ(KindOf({.evidence = 20, .sigma_px = 0.3}), Kind::kOccludingContour);
}

TEST(SelectCurves, LeavesBordersOfShadingOut) {
  EXPECT_EQ(KindOf({.evidence = 100, .blurred_share = 0.1}), Kind::kEdge);
  EXPECT_EQ(KindOf({.evidence = 100, .blurred_share = 0.3}), Kind::kNone);
}

TEST(SelectCurves, KeepsCurvesOfUnknownSigma) {
  EXPECT_EQ(KindOf({.evidence = 0, .sigma_px = 0}), Kind::kEdge);
}

TEST(SelectCurves, KeepsTheOrderAndLabelsContours) {
  Scene scene;
  for (const double evidence : {30, 5, 40, 50, 6}) {
    scene.Add({.evidence = evidence});
    scene.Add({.evidence = evidence, .sigma_px = 1});
  }
  const SelectedCurves selected = scene.Select();
  std::vector<double> edges, contours;
  for (const Curve& curve : selected.edges) {
    edges.push_back(curve.samples.front().evidence);
    EXPECT_FALSE(curve.is_occluding_contour);
  }
  for (const Curve& curve : selected.occluding_contours) {
    contours.push_back(curve.samples.front().evidence);
    EXPECT_TRUE(curve.is_occluding_contour);
  }
  EXPECT_EQ(edges, (std::vector<double>{30, 40, 50}));
  EXPECT_EQ(contours, (std::vector<double>{30, 40, 50}));
}

TEST(SelectCurves, DoesNotDependOnTheUnit) {
  Scene scene;
  scene.Add({});
  for (const double evidence : {26.9, 27.1}) {  // 12 * 1.5^2
    scene.Add({.evidence = evidence, .sigma_px = 0.12 * 1.5});
  }
  EXPECT_EQ(scene.Select(kOptions, 1000).edges.size(),
            scene.Select(kOptions, 1).edges.size());
  EXPECT_EQ(scene.Select().edges.size(), 2u);
}

}  // namespace
}  // namespace curvix

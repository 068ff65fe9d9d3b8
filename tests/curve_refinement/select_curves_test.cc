// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kSelectOptions = {.max_dilution = 2.5,
                                                   .max_blurred_share = 0.2};
constexpr double kGoodScatterPx = 0.1;
constexpr double kSceneSigmaPx = 0.2;

struct Drawn {
  double dilution = 1;
  double scatter_px = kGoodScatterPx;
  double blurred_share = 0;
};

// Cameras all around the x axis.
std::vector<PosedView> Around(int num_views) {
  std::vector<PosedView> views;
  for (int i = 0; i < num_views; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.25) / num_views;
    views.push_back(
        LookAt({0, -8 * std::cos(angle), 8 * std::sin(angle)}, {0, 0, 0}));
  }
  return views;
}

// Curves in two views at a right angle, in which edges as sharp as all others
// support them; blurred ones come from a third view, or, if they are half of
// all or all, from one of the two or both. If all n views supported a curve,
// its dilution would be sqrt(2 / n).
class DrawnScene {
 public:
  explicit DrawnScene(int num_views = 16)
      : views_(Around(num_views)), edge_maps_(views_.size()) {
    for (int k = 0; k < 4000; ++k) {  // what else the views show
      for (EdgeMap& map : edge_maps_) {
        map.edges.push_back(
            {{0.1 * k, 5}, 0, 20, static_cast<float>(kSharpness)});
      }
    }
  }

  // A line of 200 samples. How many there were before, which its evidence
  // tells, too.
  double Add(const Drawn& drawn) {
    const auto idx = static_cast<double>(curves_.size());
    Curve curve = Line(InPlane(-100, 0), InPlane(99, 0));
    const std::size_t count = curve.samples.size();
    const double share = drawn.blurred_share;
    const double num_blurred_beside =
        share < 0.5 ? share / (1 - share) * 2 * static_cast<double>(count) : 0;
    for (std::size_t k = 0; k < count; ++k) {
      CurveSample& sample = curve.samples[k];
      sample.evidence = idx;
      sample.sigma = kSceneSigmaPx * drawn.dilution * kPixel;
      const double offset_px =
          drawn.scatter_px / 1.4826 * (k % 2 == 0 ? 1 : -1);
      sample.support = {AddEdge(sample, 0, share >= 0.5, offset_px)};
      if (static_cast<double>(k) + 0.5 < num_blurred_beside) {
        sample.support.push_back(AddEdge(sample, 1, true, offset_px));
      }
      const std::size_t at_right_angle = views_.size() / 4;
      if (at_right_angle > 0) {
        sample.support.push_back(
            AddEdge(sample, at_right_angle, share == 1, offset_px));
      }
    }
    curves_.push_back(std::move(curve));
    return idx;
  }

  SelectedCurves Select(const CurveRefinementOptions& options = kSelectOptions,
                        double unit = 1) const {
    const std::vector<PosedView> views = Scaled(views_, unit);
    return SelectCurves(Scaled(curves_, unit),
                        {views, edge_maps_, kSceneSigmaPx, options, 1},
                        ImageSupport(views, edge_maps_, 1));
  }

 private:
  static constexpr double kSharpness = 0.7;

  // An edge `offset_px` beside the sample.
  EdgeRef AddEdge(const CurveSample& sample,
                  std::size_t view_idx,
                  bool is_blurred,
                  double offset_px) {
    const PosedView& view = views_[view_idx];
    Edge2d edge;
    edge.position = view.Pixel(view.InCamera(sample.position)) +
                    Eigen::Vector2d(0, offset_px);
    edge.strength = 10;
    edge.sharpness =
        static_cast<float>(is_blurred ? kSharpness / 2 : kSharpness);
    auto& edges = edge_maps_[view_idx].edges;
    edges.push_back(edge);
    return {static_cast<std::int32_t>(view_idx),
            static_cast<std::int32_t>(edges.size() - 1)};
  }

  std::vector<PosedView> views_;
  std::vector<EdgeMap> edge_maps_;
  std::vector<Curve> curves_;
};

enum class Kind { kEdge, kOccludingContour, kNone };

// What becomes of a curve in a scene with two good ones.
Kind KindOf(const Drawn& drawn, DrawnScene scene = DrawnScene()) {
  scene.Add({});
  scene.Add({});
  const double idx = scene.Add(drawn);
  const SelectedCurves selected = scene.Select();
  const auto holds_it = [&](const std::vector<Curve>& curves) {
    return std::any_of(curves.begin(), curves.end(), [&](const Curve& curve) {
      return curve.samples.front().evidence == idx;
    });
  };
  if (holds_it(selected.edges)) return Kind::kEdge;
  return holds_it(selected.occluding_contours) ? Kind::kOccludingContour
                                               : Kind::kNone;
}

// Curves of this scatter and blur are edges up to this dilution, and `beyond`
// above it.
void ExpectLimit(double dilution,
                 const Drawn& drawn,
                 const DrawnScene& scene = DrawnScene(),
                 Kind beyond = Kind::kOccludingContour) {
  Drawn at_limit = drawn;
  at_limit.dilution = 0.999 * dilution;
  EXPECT_EQ(KindOf(at_limit, scene), Kind::kEdge);
  at_limit.dilution = 1.001 * dilution;
  EXPECT_EQ(KindOf(at_limit, scene), beyond);
}

TEST(SelectCurves, AsksThatPlacesAreKnownSurely) { ExpectLimit(2.5, {}); }

TEST(SelectCurves, AsksForMoreWhereEdgesScatterMoreThanInThisScene) {
  ExpectLimit(2.5, {.scatter_px = 0.5 * kGoodScatterPx});
  for (const double ratio : {1.5, 3.0}) {
    ExpectLimit(2.5 / ratio, {.scatter_px = ratio * kGoodScatterPx});
  }
}

TEST(SelectCurves, AsksForLessWhereTheViewsCannotTellMore) {
  ExpectLimit(6 * std::sqrt(2.0 / 8), {}, DrawnScene(8));
  ExpectLimit(1.6 * 2.5, {}, DrawnScene(4));
  ExpectLimit(
      1.6 * 2.5, {}, DrawnScene(2));  // both in one plane with the curve
}

// The two sharp views alone have a dilution of 1.
TEST(SelectCurves, AsksForMoreOfBlurredCurves) {
  constexpr double kLimit = 0.2 * (1 - 1 / 2.5);
  EXPECT_EQ(KindOf({.blurred_share = kLimit - 0.005}), Kind::kEdge);
  EXPECT_EQ(KindOf({.blurred_share = kLimit + 0.005}), Kind::kNone);
}

TEST(SelectCurves, AsksThatSharpViewsAloneTellThePlace) {
  CurveRefinementOptions options = kSelectOptions;
  options.max_blurred_share = 0.9;
  for (const double share : {0.3, 0.5}) {
    DrawnScene scene;
    scene.Add({});
    scene.Add({.dilution = 0.1, .blurred_share = share});
    EXPECT_EQ(scene.Select(options).edges.size(), share < 0.5 ? 2u : 1u);
  }
}

TEST(SelectCurves, LeavesShadingEdgesOut) {
  EXPECT_EQ(KindOf({.dilution = 0.1, .blurred_share = 0.195}), Kind::kNone);
  EXPECT_EQ(KindOf({.dilution = 0.01, .blurred_share = 0.25}), Kind::kNone);
  EXPECT_EQ(KindOf({.dilution = 3, .blurred_share = 0.25}),
            Kind::kOccludingContour);
}

TEST(SelectCurves, KeepsBlurredCurvesIfAsked) {
  DrawnScene scene;
  scene.Add({});
  scene.Add({.dilution = 2.4, .blurred_share = 1});
  scene.Add({.dilution = 2.6, .blurred_share = 1});
  CurveRefinementOptions options = kSelectOptions;
  options.max_blurred_share = 1;
  EXPECT_EQ(scene.Select(options).edges.size(), 2u);
}

TEST(SelectCurves, LearnsTheScatterFromCurvesThatAreSharpAndWellKnown) {
  DrawnScene scene;
  for (int i = 0; i < 5; ++i) {
    scene.Add({.dilution = 5, .scatter_px = 0.5});
    scene.Add({.scatter_px = 0.5, .blurred_share = 0.1});
  }
  ExpectLimit(1.25, {.scatter_px = 2 * kGoodScatterPx}, scene);
}

TEST(SelectCurves, LearnsTheScatterFromSoftCurvesIfNoneIsSharp) {
  DrawnScene scene;
  for (const double dilution : {0.5, 2.4, 2.6}) {
    scene.Add({.dilution = dilution,
               .scatter_px = 5 * kGoodScatterPx,
               .blurred_share = 0.1});
  }
  EXPECT_EQ(scene.Select().edges.size(), 2u);
}

TEST(SelectCurves, KeepsCurvesOfUnknownSigma) {
  EXPECT_EQ(KindOf({.dilution = 0}), Kind::kEdge);
}

TEST(SelectCurves, KeepsAllIfAsked) {
  DrawnScene scene;
  scene.Add({.dilution = 1000, .blurred_share = 1});
  CurveRefinementOptions options = kSelectOptions;
  options.max_dilution = 0;
  EXPECT_EQ(scene.Select(options).edges.size(), 1u);
}

TEST(SelectCurves, KeepsTheOrderAndLabelsContours) {
  DrawnScene scene;
  for (const double dilution : {1, 5, 2, 1, 6}) {
    scene.Add({.dilution = dilution});
    scene.Add({.dilution = 1, .blurred_share = 0.5});
  }
  const SelectedCurves selected = scene.Select();
  std::vector<double> edges, contours;
  for (const Curve& curve : selected.edges) {
    edges.push_back(curve.samples.front().evidence);
    EXPECT_EQ(MainKind(curve), CurveKind::kUnknown);
  }
  for (const Curve& curve : selected.occluding_contours) {
    contours.push_back(curve.samples.front().evidence);
    EXPECT_EQ(MainKind(curve), CurveKind::kOccludingContour);
  }
  EXPECT_EQ(edges, (std::vector<double>{0, 4, 6}));
  EXPECT_EQ(contours, (std::vector<double>{2, 8}));
}

TEST(SelectCurves, DoesNotDependOnTheUnit) {
  DrawnScene scene;
  for (const double dilution : {1.0, 2.49, 2.51}) {
    scene.Add({.dilution = dilution});
  }
  EXPECT_EQ(scene.Select(kSelectOptions, 1000).edges.size(), 2u);
  EXPECT_EQ(scene.Select(kSelectOptions, 1).edges.size(), 2u);
}

}  // namespace
}  // namespace curvix

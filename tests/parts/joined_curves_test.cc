// SPDX-License-Identifier: BSD-3-Clause
#include "parts/joined_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "model/curve_chains.h"
#include "parts/scene_parts.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using Curves = std::vector<Curve>;

const Scene& RingScene() {
  static const Scene scene = SceneOf(RingOfViews(8));
  return scene;
}

// Two parts, divided at x = 0.
ScenePartition Halves() {
  ScenePartition partition;
  partition.overlap = 25 * kPx;
  partition.cuts = {{Eigen::Vector3d::UnitX(), 0, -1, -2}};
  partition.parts.resize(2);
  return partition;
}

// A sample every pixel from `from` to `to`, in pixels; `shift` moves the first
// one along, as two parts never draw the same samples.
Curve Line(const Eigen::Vector3d& from,
           const Eigen::Vector3d& to,
           double shift = 0) {
  Curve curve;
  const Eigen::Vector3d tangent = (to - from).normalized();
  for (double s = shift; s <= (to - from).norm(); ++s) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = kPx * (from + s * tangent);
    sample.tangent = tangent;
  }
  return curve;
}

Curve Circle(double center_x, double radius, double first_rad) {
  Curve curve;
  curve.closed = true;
  const int num_samples = static_cast<int>(2 * kPi * radius);
  for (int i = 0; i < num_samples; ++i) {
    const double a = first_rad + 2 * kPi * i / num_samples;
    CurveSample& sample = curve.samples.emplace_back();
    sample.position =
        kPx * Eigen::Vector3d(
                  center_x + radius * std::cos(a), radius * std::sin(a), 0);
    sample.tangent = {-std::sin(a), std::cos(a), 0};
  }
  return curve;
}

// Results of parts in memory.
class PartsInMemory : public PartResults {
 public:
  explicit PartsInMemory(std::vector<std::vector<TracedCurve>> curves)
      : curves_(std::move(curves)) {}

  std::size_t NumCurves(int part_idx) const override {
    return curves_[static_cast<std::size_t>(part_idx)].size();
  }
  Result<TracedCurve> Read(int part_idx, std::size_t curve_idx) override {
    if (num_reads_left-- == 0) return Status::DataLoss("gone");
    return curves_[static_cast<std::size_t>(part_idx)][curve_idx];
  }

  int num_reads_left = -1;  // without end

 private:
  std::vector<std::vector<TracedCurve>> curves_;
};

// What each part has drawn, cut to what it gives, without support.
PartsInMemory Parts(const Curves& below, const Curves& above) {
  const ScenePartition partition = Halves();
  const auto cores = CoresOf(partition);
  std::vector<std::vector<TracedCurve>> parts(2);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Curve& curve :
         CutCurves(i == 0 ? below : above, cores[i], partition.overlap)) {
      parts[i].push_back({curve, {}});
    }
  }
  return PartsInMemory(std::move(parts));
}

Curves Join(const Curves& below, const Curves& above) {
  const ScenePartition partition = Halves();
  PartsInMemory parts = Parts(below, above);
  const JoinedCurves joined(partition, parts, RingScene(), Options());
  EXPECT_TRUE(joined.status().ok());
  Curves curves;
  joined.ForEach([&](std::size_t id, const Curve& curve) {
    EXPECT_EQ(id, curves.size());
    curves.push_back(curve);
  });
  EXPECT_EQ(joined.size(), curves.size());
  return curves;
}

void ExpectEvenSteps(const Curve& curve) {
  for (std::size_t k = 1; k < curve.samples.size(); ++k) {
    const Eigen::Vector3d step =
        curve.samples[k].position - curve.samples[k - 1].position;
    EXPECT_GT(step.norm(), 0.4 * kPx);
    EXPECT_LT(step.norm(), 2.1 * kPx);
    EXPECT_GT(step.dot(curve.samples[k].tangent), 0) << "sample " << k;
  }
}

TEST(JoinedCurves, MakesALineAcrossTheBorderWhole) {
  for (const double shift : {0.0, 0.3, 0.7}) {
    for (const bool is_reversed : {false, true}) {
      const Curve above = is_reversed
                              ? Line({90, 0.2, 0}, {-60, 0.2, 0}, shift)
                              : Line({-60, 0.2, 0}, {90, 0.2, 0}, shift);
      const Curves joined = Join({Line({-100, 0, 0}, {70, 0, 0})}, {above});
      ASSERT_EQ(joined.size(), 1u);
      EXPECT_NEAR(Length(joined[0]), 190 * kPx, 2 * kPx);
      ExpectEvenSteps(joined[0]);
    }
  }
}

TEST(JoinedCurves, DrawsALineAlongTheBorderOnce) {
  for (const double x : {-0.4, 0.0, 0.4}) {
    // Each part sees it a little on the other's side, or on its own.
    for (const double error : {-0.2, 0.2}) {
      const Curves joined =
          Join({Line({x + error, -50, 0}, {x + error, 50, 0})},
               {Line({x - error, -50, 0}, {x - error, 50, 0}, 0.4)});
      ASSERT_EQ(joined.size(), 1u) << x << " " << error;
      EXPECT_NEAR(Length(joined[0]), 100 * kPx, 2 * kPx);
      ExpectEvenSteps(joined[0]);
    }
  }
}

TEST(JoinedCurves, FollowsALineThatHugsTheBorder) {
  const Curves joined = Join({Line({-2, -80, 0}, {2, 80, 0})},
                             {Line({-2.1, -80, 0}, {2.1, 80, 0}, 0.5)});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_NEAR(Length(joined[0]), 160 * kPx, 2.5 * kPx);
}

TEST(JoinedCurves, ClosesARingAcrossTheBorder) {
  for (const double center_x : {0.0, 25.0}) {
    const Curves joined =
        Join({Circle(center_x, 40, 0.1)}, {Circle(center_x, 40, 2.5)});
    ASSERT_EQ(joined.size(), 1u);
    EXPECT_TRUE(joined[0].closed);
    EXPECT_NEAR(Length(joined[0]), 2 * kPi * 40 * kPx, 3 * kPx);
  }
}

TEST(JoinedCurves, LeavesWhatLiesInOneCoreAsItIs) {
  const Curve line = Line({-90, 0, 0}, {-40, 0, 0});
  const Curve circle = Circle(70, 20, 0);
  const Curves joined = Join({line}, {circle});
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_EQ(joined[0].samples.size(), line.samples.size());
  EXPECT_EQ(joined[0].samples[7].position, line.samples[7].position);
  EXPECT_TRUE(joined[1].closed);
  EXPECT_EQ(joined[1].samples[9].position, circle.samples[9].position);
}

TEST(JoinedCurves, KeepsWhatOnlyOnePartHasDrawnNearTheBorder) {
  const Curves joined = Join({Line({-40, 0, 0}, {15, 0, 0})}, {});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_NEAR(Length(joined[0]), 55 * kPx, kPx);
}

TEST(JoinedCurves, DropsAStubThatGoesOnNowhere) {
  EXPECT_TRUE(Join({Line({20, 0, 0}, {60, 0, 0})}, {}).empty());
}

TEST(JoinedCurves, LeavesParallelLinesApart) {
  const Curves both = {Line({-50, 0, 0}, {50, 0, 0}),
                       Line({-50, 4, 0}, {50, 4, 0})};
  const Curves joined = Join(both, both);
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_NEAR(Length(joined[0]), 100 * kPx, 2 * kPx);
  EXPECT_NEAR(Length(joined[1]), 100 * kPx, 2 * kPx);
}

TEST(JoinedCurves, LeavesCurvesThatCrossOnTheBorderApart) {
  const Curves both = {Line({-50, -50, 0}, {50, 50, 0}),
                       Line({-50, 50, 0}, {50, -50, 0})};
  const Curves joined = Join(both, both);
  ASSERT_EQ(joined.size(), 2u);
  for (const Curve& curve : joined) ExpectEvenSteps(curve);
}

// Every sample of a line names one edge, which lies where it is.
TracedCurve Traced(const Curve& line, int view_idx) {
  TracedCurve traced{line, {}};
  for (CurveSample& sample : traced.curve.samples) {
    sample.support = {
        {view_idx, static_cast<std::int32_t>(traced.edges.size())}};
    traced.edges.emplace_back().position = sample.position.head<2>();
  }
  return traced;
}

TEST(JoinedCurves, NameTheViewsOfTheSceneAndTheirOwnEdges) {
  ScenePartition partition = Halves();
  partition.parts[0].view_idxs = {0, 2, 3};
  partition.parts[1].view_idxs = {2, 4, 7};
  const auto cores = CoresOf(partition);
  const Curve line = Line({-60, 0, 0}, {60, 0, 0});
  const Curve below = CutCurves({line}, cores[0], partition.overlap).front();
  const Curve above =
      CutCurves({Reversed(line)}, cores[1], partition.overlap).front();
  PartsInMemory parts({{Traced(below, 0)}, {Traced(above, 2)}});
  const JoinedCurves joined(partition, parts, RingScene(), Options());
  ASSERT_EQ(joined.size(), 1u);
  joined.ForEach([&](std::size_t, const Curve& curve) {
    EXPECT_NEAR(Length(curve), 120 * kPx, 2 * kPx);
    for (const CurveSample& sample : curve.samples) {
      ASSERT_EQ(sample.support.size(), 1u);
      const EdgeRef& ref = sample.support.front();
      EXPECT_EQ(ref.view_idx, sample.position.x() < 0 ? 0 : 7);
      EXPECT_EQ(joined.EdgeOf(ref).position, sample.position.head<2>());
    }
  });
}

TEST(JoinedCurves, RefuseViewsAndEdgesThatAreNotThere) {
  ScenePartition partition = Halves();
  partition.parts[0].view_idxs = {0, 2};
  for (const EdgeRef& ref : {EdgeRef{2, 0}, {-1, 0}, {1, 91}, {1, -1}}) {
    TracedCurve broken = Traced(Line({-100, 0, 0}, {-10, 0, 0}), 1);
    broken.curve.samples.back().support = {ref};
    PartsInMemory parts({{broken}, {}});
    const JoinedCurves joined(partition, parts, RingScene(), Options());
    EXPECT_EQ(joined.status().code(), StatusCode::kDataLoss);
    EXPECT_EQ(joined.size(), 0u);
  }
}

TEST(JoinedCurves, ShowNothingMoreAfterOneThatCannotBeRead) {
  const ScenePartition partition = Halves();
  PartsInMemory parts = Parts(
      {Line({-90, 0, 0}, {-40, 0, 0}), Line({-90, 9, 0}, {-40, 9, 0})}, {});
  const JoinedCurves joined(partition, parts, RingScene(), Options());
  ASSERT_EQ(joined.size(), 2u);
  parts.num_reads_left = 1;
  int num_shown = 0;
  for (int round = 0; round < 2; ++round) {
    joined.ForEach([&](std::size_t, const Curve&) { ++num_shown; });
    EXPECT_EQ(num_shown, 1);
    EXPECT_EQ(joined.status().message(), "gone");
  }
}

}  // namespace
}  // namespace curvix

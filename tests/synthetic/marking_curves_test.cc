// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/synthetic_truth.h"

#include "base/angles.h"
#include "synthetic/camera_rig.h"
#include "synthetic/primitive.h"
#include "synthetic/scenes.h"
#include "synthetic/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Where the slope of the image across an edge at `pixel` is steepest, pixels
// along the unit `across`: with a Gaussian of 0.7 px, within 1 px.
double SteepestOffset(const GrayImage& image,
                      const Vector2d& pixel,
                      const Vector2d& across) {
  constexpr double kSigma = 0.7;
  double best = 0;
  double steepest = -1;
  for (double offset = -1; offset <= 1; offset += 0.05) {
    double slope = 0;
    for (double d = -2; d <= 2.01; d += 0.1) {
      slope += d * std::exp(-d * d / (2 * kSigma * kSigma)) *
               Bilinear(image, pixel + (offset + d) * across);
    }
    if (std::abs(slope) > steepest) {
      steepest = std::abs(slope);
      best = offset;
    }
  }
  return best;
}

// Whether a sample is the first or last of its curve, where others may meet it.
bool IsEnd(const std::vector<TrueSample>& samples, std::size_t i) {
  return i == 0 || i + 1 == samples.size() ||
         samples[i - 1].curve_id != samples[i].curve_id ||
         samples[i + 1].curve_id != samples[i].curve_id;
}

// Cameras above the plane z = 0, which look down at most half a right angle
// aslant.
std::vector<Rigid3> FromAbove() {
  std::vector<Rigid3> poses;
  for (const double tilt : {0.0, 0.4, 0.75}) {
    Rigid3 pose;
    pose.rotation =
        Eigen::AngleAxisd(kPi - tilt, Vector3d(1, 0.3, 0.1).normalized());
    pose.translation.z() = 1.8;
    poses.push_back(pose);
  }
  return poses;
}

// The share of the samples that are edges of an image whose steepest place is
// within 0.3 px of where they are.
double ShareOnImageEdges(const Solid& solid,
                         const Surfaces& surfaces,
                         const std::vector<Rigid3>& poses,
                         const std::vector<TrueSample>& samples) {
  SyntheticOptions options;
  options.width = options.height = 800;
  const Camera camera = *MakeCamera(options);
  int num_edges = 0;
  int num_near = 0;
  for (const Rigid3& pose : poses) {
    const GrayImage image = Render(solid, surfaces, camera, pose);
    const auto looks = LookAtSamples(samples, solid, camera, pose, image);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!looks[i].is_edge || IsEnd(samples, i)) continue;
      const auto pixel = [&](const Vector3d& x) {
        return ImageFromIdeal(camera, (pose * x).hnormalized());
      };
      const Vector2d at = pixel(samples[i].position);
      const Vector2d along =
          pixel(samples[i].position + 1e-5 * samples[i].tangent) - at;
      const Vector2d across = Vector2d(-along.y(), along.x()).normalized();
      ++num_edges;
      num_near += std::abs(SteepestOffset(image, at, across)) <= 0.3;
    }
  }
  EXPECT_GT(num_edges, 100);
  return num_near / std::max(1.0, 1.0 * num_edges);
}

class EveryPatternOnAPlate : public ::testing::TestWithParam<SurfacePattern> {};

TEST_P(EveryPatternOnAPlate, IsOnEdgesOfItsImages) {
  const Solid solid(
      {Painted(GetParam(), Box({-0.5, -0.4, -0.05}, {0.5, 0.4, 0}))});
  const Surfaces surfaces(solid, {.seed = 2});
  const std::vector<TrueCurve> markings = MarkingCurves(solid, surfaces);
  const auto samples = SampleCurves(markings, 0.02);
  for (const TrueSample& sample : samples) {
    EXPECT_EQ(sample.kind, CurveKind::kMarking);
  }
  EXPECT_GT(ShareOnImageEdges(solid, surfaces, FromAbove(), samples), 0.99);
}

INSTANTIATE_TEST_SUITE_P(Patterns,
                         EveryPatternOnAPlate,
                         ::testing::Values(SurfacePattern::kBrick,
                                           SurfacePattern::kWood,
                                           SurfacePattern::kPrint));

// The share of the samples in sight beside which rays see different things. Of
// sheets, what is in the shade is not looked at: its other side has the
// shadows.
double ShareOfJumps(const Solid& solid,
                    const Surfaces& surfaces,
                    const std::vector<Rigid3>& poses,
                    const std::vector<TrueSample>& samples) {
  int num_seen = 0;
  int num_jumps = 0;
  for (const Rigid3& pose : poses) {
    const Vector3d eye = pose.Inverse().translation;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vector3d ahead = samples[i].position - eye;
      const auto hit = solid.Trace({eye, ahead});
      if (!hit || hit->t < 1 - 1e-5 || IsEnd(samples, i)) continue;
      const SolidPrimitive& primitive = solid.primitives()[hit->primitive_idx];
      if (primitive.shape == PrimitiveShape::kSheet &&
          hit->normal.dot(Surfaces::SunDirection()) <= 0) {
        continue;
      }
      const Vector3d aside =
          2e-4 * hit->normal.cross(samples[i].tangent).normalized();
      const auto look = [&](const Vector3d& direction) {
        const auto beside = solid.Trace({eye, direction});
        return beside ? surfaces.At({eye, direction}, *beside).id : 0;
      };
      ++num_seen;
      num_jumps += look(ahead + aside) != look(ahead - aside);
    }
  }
  EXPECT_GT(num_seen, 100);
  return num_jumps / std::max(1.0, 1.0 * num_seen);
}

class EveryScene : public ::testing::TestWithParam<SyntheticSolid> {};

TEST_P(EveryScene, JumpsAcrossItsMarkingsAndShadows) {
  const Solid solid = MakeSolid(GetParam(), 1, 3, SurfacePattern::kMixed);
  const Surfaces surfaces(solid, {.shadows = true, .seed = 0});
  const auto poses = GetParam() == SyntheticSolid::kRoom
                         ? MakeRoomPoses(8, 1, 3)
                         : MakePoses(8, solid.radius(), 3);
  const auto markings = SampleCurves(MarkingCurves(solid, surfaces), 0.02);
  EXPECT_GT(ShareOfJumps(solid, surfaces, poses, markings), 0.99);
  const auto shadows =
      SampleShadowEdges(solid, surfaces, CreaseCurves(solid), 0.01, 0);
  EXPECT_GT(ShareOfJumps(solid, surfaces, poses, shadows), 0.99);
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         EveryScene,
                         ::testing::Values(SyntheticSolid::kPart,
                                           SyntheticSolid::kHouse,
                                           SyntheticSolid::kTable,
                                           SyntheticSolid::kKnobs,
                                           SyntheticSolid::kRoom));

TEST(SampleShadowEdgesTest, AreOnEdgesOfTheImages) {
  const Solid solid({Box({-0.5, -0.4, -0.05}, {0.5, 0.4, 0}),
                     Box({0.05, -0.2, -0.01}, {0.2, -0.1, 0.2}),
                     Sphere({-0.1, 0.1, 0.1}, 0.08),
                     Cylinder({0.3, 0.1, -0.01}, {0, 0, 0.2}, 0.04),
                     FlatSheet({-0.3, -0.3, 0}, {0.15, 0.05, 0}, {0, 0, 0.2})});
  const Surfaces surfaces(solid, {.shadows = true});
  const auto samples =
      SampleShadowEdges(solid, surfaces, CreaseCurves(solid), 0.01, 7);
  ASSERT_FALSE(samples.empty());
  EXPECT_EQ(samples[0].curve_id, 7);
  for (const TrueSample& sample : samples) {
    EXPECT_EQ(sample.kind, CurveKind::kMarking);
    EXPECT_NEAR(sample.tangent.norm(), 1, 1e-9);
  }
  EXPECT_GT(ShareOnImageEdges(solid, surfaces, FromAbove(), samples), 0.97);
}

// Distance of x from the ray of the sun through `centre`.
double FromSunRay(const Vector3d& x, const Vector3d& centre) {
  return (x - centre).cross(Surfaces::SunDirection()).norm();
}

TEST(SampleShadowEdgesTest, ABallCastsAnEllipse) {
  const Vector3d centre(0, 0, 0.4);
  const double radius = 0.15;
  const Solid solid({Box({-1, -1, -0.1}, {1, 1, 0}), Sphere(centre, radius)});
  const Surfaces surfaces(solid, {.shadows = true});
  const auto samples = SampleShadowEdges(solid, surfaces, {}, 0.01, 0);
  ASSERT_GT(samples.size(), 50u);
  double length = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].position.z(), 0, 1e-12);
    EXPECT_NEAR(FromSunRay(samples[i].position, centre), radius, 1e-9);
    EXPECT_NEAR(samples[i].tangent.z(), 0, 1e-6);
    if (i > 0) {
      length += (samples[i].position - samples[i - 1].position).norm();
    }
  }
  // Half axes r and r / sin of the sun's height; Ramanujan's length.
  const double a = radius / Surfaces::SunDirection().z();
  const double b = radius;
  const double h = std::pow((a - b) / (a + b), 2);
  const double exact =
      kPi * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
  EXPECT_NEAR(length, exact, 0.01 * exact);
}

TEST(SampleShadowEdgesTest, WithoutShadowsThereAreNone) {
  const Solid solid = MakeSolid(SyntheticSolid::kPart, 1);
  EXPECT_TRUE(SampleShadowEdges(
                  solid, Surfaces(solid, {}), CreaseCurves(solid), 0.01, 0)
                  .empty());
}

TEST(MarkingCurvesTest, EndWhereAnotherBodyStands) {
  // A printed plate of which a block hides the right half.
  const SolidPrimitive plate =
      Painted(SurfacePattern::kPrint, Box({-0.5, -0.5, -0.1}, {0.5, 0.5, 0}));
  const SolidPrimitive block = Box({0, -0.6, -0.2}, {0.6, 0.6, 0.1});
  const auto length_left = [](const Solid& solid) {
    double length = 0;
    const Surfaces surfaces(solid, {.seed = 0});
    for (const TrueCurve& curve : MarkingCurves(solid, surfaces)) {
      for (int i = 0; i < 500; ++i) {
        const Vector3d x = curve.Position(curve.length * (i + 0.5) / 500);
        if (std::abs(x.z()) > 1e-9) continue;  // of the plate's top
        if (x.x() < 0) length += curve.length / 500;
      }
    }
    return length;
  };
  const Solid hidden({plate, block});
  EXPECT_NEAR(length_left(hidden), length_left(Solid({plate})), 0.02);
  const Surfaces surfaces(hidden, {.seed = 0});
  for (const TrueCurve& curve : MarkingCurves(hidden, surfaces)) {
    if (std::abs(curve.Position(0).z()) > 1e-9) continue;
    EXPECT_LT(curve.Position(0).x(), 1e-6);
    EXPECT_LT(curve.Position(curve.length).x(), 1e-6);
  }
}

}  // namespace
}  // namespace curvix

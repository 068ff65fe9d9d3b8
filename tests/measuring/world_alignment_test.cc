// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/world_alignment.h"

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::HasSubstr;

Similarity3 RandomSimilarity(Random& random) {
  Similarity3 s;
  s.scale = random.Uniform(0.2, 30);
  s.rotation = Quaterniond(random.Rotation());
  s.translation = 5 * random.NormalVector();
  return s;
}

// (s, w, t) between the estimate and the truth, as the covariance has them.
Eigen::Matrix<double, 7, 1> ErrorOf(const Similarity3& estimate,
                                    const Similarity3& truth) {
  const Eigen::AngleAxisd turn(truth.rotation * estimate.rotation.conjugate());
  Eigen::Matrix<double, 7, 1> error;
  error << std::log(truth.scale / estimate.scale), turn.angle() * turn.axis(),
      truth.translation - estimate.translation;
  return error;
}

KnownDistance DistanceOf(const Vector3d& a, const Vector3d& b, double length) {
  KnownDistance d;
  d.a = a;
  d.b = b;
  d.length = length;
  return d;
}

TEST(EstimateAlignment, ExactPositionsGiveTheSimilarity) {
  Random random(1);
  const Similarity3 truth = RandomSimilarity(random);
  AlignmentInput input;
  for (int i = 0; i < 5; ++i) {
    const Vector3d x = random.NormalVector();
    input.positions.push_back({"", x, truth * x, 0});
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_LT(ErrorOf(result->alignment.world_from_model, truth).norm(), 1e-9);
  EXPECT_TRUE(result->alignment.has_translation);
}

// The axes of most lines need not be east and north.
TEST(EstimateAlignment, PositionsThatFixTheRotationDecideIt) {
  Random random(7);
  const Similarity3 truth = RandomSimilarity(random);
  AlignmentInput input;
  for (int i = 0; i < 5; ++i) {
    const Vector3d x = random.NormalVector();
    input.positions.push_back(
        {"", x, truth * x + 0.1 * random.NormalVector(), 0});
  }
  const auto without = EstimateAlignment(input);
  input.axes.emplace();
  input.axes->world_from_model = Quaterniond(random.Rotation());
  input.axes->covariance = 1e-6 * Matrix3d::Identity();
  const auto with = EstimateAlignment(input);
  ASSERT_TRUE(without.ok() && with.ok());
  EXPECT_TRUE(with->has_rotation_of_positions);
  EXPECT_EQ(ErrorOf(with->alignment.world_from_model,
                    without->alignment.world_from_model)
                .norm(),
            0);
}

// Errors in their own standard deviations: the mean square over many seeds of a
// normal vector of seven is seven.
TEST(EstimateAlignment, PositionErrorsAreAsLargeAsStated) {
  constexpr int kNumSeeds = 200;
  double sum = 0;
  for (int seed = 0; seed < kNumSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Similarity3 truth = RandomSimilarity(random);
    const double sigma = 0.001 * truth.scale;
    AlignmentInput input;
    for (int i = 0; i < 12; ++i) {
      const Vector3d x = random.NormalVector();
      input.positions.push_back(
          {"", x, truth * x + sigma * random.NormalVector(), sigma});
    }
    const auto result = EstimateAlignment(input);
    ASSERT_TRUE(result.ok());
    const auto error = ErrorOf(result->alignment.world_from_model, truth);
    const double square =
        error.dot(result->alignment.covariance.ldlt().solve(error));
    // The chance of more is 1e-6 for each of the seeds.
    EXPECT_LT(square, 40) << seed;
    sum += square;
  }
  // Estimates of sigmas that are too small are raised, never lowered.
  EXPECT_GT(sum / kNumSeeds, 5);
  EXPECT_LT(sum / kNumSeeds, 8);
}

TEST(EstimateAlignment, PositionsWithoutSigmasTellTheirOwn) {
  Random random(3);
  const Similarity3 truth = RandomSimilarity(random);
  const double sigma = 0.01 * truth.scale;
  AlignmentInput input;
  for (int i = 0; i < 200; ++i) {
    const Vector3d x = random.NormalVector();
    input.positions.push_back(
        {"", x, truth * x + sigma * random.NormalVector(), 0});
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(result->position_sigma, sigma, 0.1 * sigma);
  EXPECT_EQ(result->position_residuals.size(), 200u);
}

// One that may be anywhere would be met exactly, and outweigh the others.
TEST(EstimateAlignment, SigmasAreGivenForAllPositionsOrEstimatedOfMany) {
  Random random(3);
  AlignmentInput input;
  for (int i = 0; i < 5; ++i) {
    const Vector3d x = random.NormalVector();
    input.positions.push_back(
        {"", x, 2 * x + 0.01 * random.NormalVector(), i > 0 ? 0.01 : 0});
  }
  EXPECT_THAT(EstimateAlignment(input).status().message(),
              HasSubstr("for all or for none"));
  for (KnownPosition& p : input.positions) p.sigma = 0;
  EXPECT_TRUE(EstimateAlignment(input).ok());
  input.positions.resize(2);
  input.axes.emplace();
  EXPECT_THAT(EstimateAlignment(input).status().message(),
              HasSubstr("fewer than three positions"));
}

TEST(EstimateAlignment, TellsWhetherPositionsKnowTheHeading) {
  AlignmentInput input;
  input.axes.emplace();
  input.axes->covariance = 1e-6 * Matrix3d::Identity();
  input.positions = {{"", {0, 0, 0}, {0, 0, 0}, 0.1},
                     {"", {0, 0, 1}, {0, 0, 2}, 0.1}};
  const auto upright = EstimateAlignment(input);
  ASSERT_TRUE(upright.ok());
  EXPECT_FALSE(upright->has_heading);
  input.positions.back() = {"", {1, 0, 0}, {0, 2, 0}, 0.1};
  const auto level = EstimateAlignment(input);
  ASSERT_TRUE(level.ok());
  EXPECT_TRUE(level->has_heading);
}

TEST(EstimateAlignment, DistanceErrorsAreAsLargeAsStated) {
  constexpr int kNumSeeds = 300;
  double sum = 0;
  for (int seed = 0; seed < kNumSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const double scale = random.Uniform(0.5, 20);
    AlignmentInput input;
    for (int i = 0; i < 3; ++i) {
      const Vector3d a = random.NormalVector(), b = 3 * random.NormalVector();
      KnownDistance d = DistanceOf(a + 0.001 * random.NormalVector(),
                                   b + 0.002 * random.NormalVector(),
                                   scale * (b - a).norm());
      d.covariance_a = 1e-6 * Matrix3d::Identity();
      d.covariance_b = 4e-6 * Matrix3d::Identity();
      d.sigma = 0.001 * scale;
      d.length += d.sigma * random.Normal();
      input.distances.push_back(d);
    }
    const auto result = EstimateAlignment(input);
    ASSERT_TRUE(result.ok());
    const double error =
        std::log(result->alignment.world_from_model.scale / scale);
    sum += std::pow(error / result->alignment.scale_sigma(), 2);
  }
  EXPECT_GT(sum / kNumSeeds, 0.5);
  EXPECT_LT(sum / kNumSeeds, 1.2);
}

TEST(EstimateAlignment, WhatIsNotObservedStays) {
  AlignmentInput input;
  input.distances.push_back(DistanceOf({0, 0, 0}, {2, 0, 0}, 5));
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  const WorldAlignment& a = result->alignment;
  EXPECT_DOUBLE_EQ(a.world_from_model.scale, 2.5);
  EXPECT_TRUE(a.world_from_model.rotation.isApprox(Quaterniond::Identity()));
  EXPECT_TRUE(a.world_from_model.translation.isZero(0));
  EXPECT_TRUE(a.has_scale);
  EXPECT_FALSE(a.has_rotation || a.has_translation);
  EXPECT_TRUE((a.covariance.bottomRightCorner<6, 6>().isZero(0)));
}

TEST(EstimateAlignment, AxesTurnAndDistancesScaleTogether) {
  Random random(4);
  AlignmentInput input;
  input.axes.emplace();
  input.axes->world_from_model = Quaterniond(random.Rotation());
  input.axes->covariance = 1e-6 * Matrix3d::Identity();
  input.distances.push_back(DistanceOf({0, 0, 0}, {0, 3, 4}, 10));
  input.positions.push_back({"a", {1, 2, 3}, {100, 200, 300}, 0.1});
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  const Similarity3& s = result->alignment.world_from_model;
  EXPECT_NEAR(s.scale, 2, 1e-9);
  EXPECT_LT(s.rotation.angularDistance(input.axes->world_from_model), 1e-9);
  EXPECT_LT((s * Vector3d(1, 2, 3) - Vector3d(100, 200, 300)).norm(), 1e-6);
  EXPECT_NEAR(result->alignment.covariance(1, 1), 1e-6, 1e-9);
}

// Which way is north, the lines of a building do not tell.
TEST(EstimateAlignment, PositionsOnALineTellTheHeadingAndAxesTheTilt) {
  Random random(6);
  const Similarity3 truth = RandomSimilarity(random);
  AlignmentInput input;
  input.axes.emplace();
  input.axes->world_from_model =
      Eigen::AngleAxisd(2.1, Vector3d::UnitZ()) * truth.rotation;
  input.axes->covariance = 1e-6 * Matrix3d::Identity();
  const Vector3d along = truth.rotation.conjugate() * Vector3d(3, -1, 0.5);
  for (const double share : {0.0, 0.3, 1.0}) {
    const Vector3d x = Vector3d(1, 2, 3) + share * along;
    input.positions.push_back({"", x, truth * x, 0.01});
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_LT(ErrorOf(result->alignment.world_from_model, truth).norm(), 1e-6);
}

TEST(EstimateAlignment, DistancesThatDisagreeRaiseTheSigma) {
  AlignmentInput input;
  for (const double length : {1.0, 1.1}) {
    input.distances.push_back(DistanceOf({0, 0, 0}, {1, 0, 0}, length));
    input.distances.back().sigma = 1e-4;
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(result->alignment.scale_sigma(), 0.05, 0.01);
  EXPECT_NEAR(result->misfit, 0.05 * std::sqrt(2) / 1e-4, 50);
}

TEST(EstimateAlignment, DistancesThatDisagreeTellNothingOfAxes) {
  AlignmentInput input;
  input.axes.emplace();
  input.axes->covariance = 1e-6 * Matrix3d::Identity();
  for (const double length : {1.0, 2.0}) {
    input.distances.push_back(DistanceOf({0, 0, 0}, {1, 0, 0}, length));
    input.distances.back().sigma = 1e-4;
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  EXPECT_GT(result->misfit, 100);
  EXPECT_NEAR(result->alignment.covariance(3, 3), 1e-6, 1e-9);
}

TEST(EstimateAlignment, LargeCoordinatesGetAnOffset) {
  Random random(5);
  AlignmentInput input;
  const Vector3d far(690123, 5335678, 512);
  for (int i = 0; i < 6; ++i) {
    const Vector3d x = random.NormalVector();
    input.positions.push_back({"", x, 3 * x + far, 0.01});
  }
  const auto result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  const WorldAlignment& a = result->alignment;
  EXPECT_NEAR(a.offset.x(), far.x(), 100);
  EXPECT_EQ(std::fmod(a.offset.y(), 100), 0);
  EXPECT_EQ(a.offset.z(), 0) << "small";
  EXPECT_LT((a.world_from_model.translation + a.offset - far).norm(), 1e-6);
}

TEST(EstimateAlignment, SaysWhatIsMissing) {
  EXPECT_THAT(EstimateAlignment({}).status().message(),
              HasSubstr("Nothing is given"));
  AlignmentInput on_a_line;
  for (int i = 0; i < 4; ++i) {
    on_a_line.positions.push_back(
        {"", Vector3d(i, 0, 0), Vector3d(0, 2 * i, 0), 0.1});
  }
  EXPECT_THAT(EstimateAlignment(on_a_line).status().message(),
              HasSubstr("not on a line"));
  AlignmentInput same;
  same.distances.push_back(DistanceOf({1, 1, 1}, {1, 1, 1}, 2));
  EXPECT_THAT(EstimateAlignment(same).status().message(),
              HasSubstr("same point"));
  AlignmentInput one;
  one.axes.emplace();
  one.positions.push_back({"", {1, 2, 3}, {4, 5, 6}, 0});
  EXPECT_THAT(EstimateAlignment(one).status().message(),
              HasSubstr("standard deviation"));
  AlignmentInput one_place;
  for (int i = 0; i < 3; ++i) {
    one_place.positions.push_back(
        {"", Vector3d(i, i * i, 0), Vector3d(1, 1, 1), 0.1});
  }
  EXPECT_FALSE(EstimateAlignment(one_place).ok());
}

TEST(EstimateAlignment, RefusesAbsurdScales) {
  for (const double length : {1e300, 1e-300, 5e-324, 1e26, 1e-26}) {
    AlignmentInput input;
    input.distances.push_back(DistanceOf({1, 1, 1}, {1, 1, 2}, length));
    const Status status = EstimateAlignment(input).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << length;
    EXPECT_THAT(status.message(), HasSubstr("wrong distance")) << length;
  }
  AlignmentInput far;
  far.distances.push_back(DistanceOf({1e300, 0, 0}, {0, 0, 0}, 1));
  EXPECT_THAT(EstimateAlignment(far).status().message(),
              HasSubstr("does not fix the scale: look"));
  for (const double length : {1e20, 1e-20}) {
    AlignmentInput input;
    input.distances.push_back(DistanceOf({1, 1, 1}, {1, 1, 2}, length));
    EXPECT_TRUE(EstimateAlignment(input).ok()) << length;
  }
}

}  // namespace
}  // namespace curvix

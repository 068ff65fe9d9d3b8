// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "synthetic/synthetic_scene.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

SyntheticOptions SmallOptions() {
  SyntheticOptions options;
  options.num_views = 6;
  options.width = 160;
  options.height = 120;
  return options;
}

SyntheticScene Make(const SyntheticOptions& options) {
  Result<SyntheticScene> scene = MakeSyntheticScene(options);
  EXPECT_TRUE(scene.ok()) << scene.status().message();
  return std::move(scene).value();
}

Eigen::Vector2d Project(const Scene& scene,
                        std::size_t view,
                        const Eigen::Vector3d& x) {
  const Eigen::Vector3d in_cam = scene.views[view].cam_from_world * x;
  return ImageFromIdeal(scene.cameras[0], in_cam.hnormalized());
}

int PixelAt(const SyntheticImage& image, const Eigen::Vector2d& pixel) {
  const int x = std::clamp(static_cast<int>(pixel.x()), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(pixel.y()), 0, image.height - 1);
  return image.pixels[static_cast<std::size_t>(y * image.width + x)];
}

// Mean grey difference 2 px to both sides of the projected samples, all views,
// hidden ones included.
double MeanContrast(const SyntheticScene& scene) {
  double sum = 0;
  int count = 0;
  for (std::size_t view = 0; view < scene.images.size(); ++view) {
    for (const TrueSample& sample : scene.truth) {
      const Eigen::Vector2d at = Project(scene.scene, view, sample.position);
      const Eigen::Vector2d ahead =
          Project(scene.scene, view, sample.position + 1e-4 * sample.tangent);
      const Eigen::Vector2d along = (ahead - at).normalized();
      const Eigen::Vector2d across(-2 * along.y(), 2 * along.x());
      sum += std::abs(PixelAt(scene.images[view], at + across) -
                      PixelAt(scene.images[view], at - across));
      ++count;
    }
  }
  return sum / count;
}

TEST(SyntheticSceneTest, IsTheSameForAnyNumberOfThreads) {
  SyntheticOptions options = SmallOptions();
  options.noise = 3;
  options.texture = 30;
  options.pattern = SurfacePattern::kMixed;
  options.shadows = true;
  options.reflections = true;
  options.pose_error_px = 1;
  options.num_threads = 1;
  const SyntheticScene one = Make(options);
  options.num_threads = 3;
  const SyntheticScene three = Make(options);
  ASSERT_EQ(one.images.size(), 6u);
  for (std::size_t i = 0; i < one.images.size(); ++i) {
    EXPECT_EQ(one.images[i].pixels, three.images[i].pixels);
    EXPECT_EQ(one.scene.views[i].cam_from_world.translation,
              three.scene.views[i].cam_from_world.translation);
  }
  for (std::size_t i = 0; i < one.truth.size(); ++i) {
    EXPECT_EQ(one.truth[i].num_views_edge, three.truth[i].num_views_edge);
  }
  options.seed = 2;
  EXPECT_NE(Make(options).images[0].pixels, one.images[0].pixels);
}

TEST(SyntheticSceneTest, SamplesCurvesAtEqualStepsWithIdsWithoutGaps) {
  SyntheticOptions options = SmallOptions();
  options.scale = 20;
  const std::vector<TrueSample> truth = Make(options).truth;
  EXPECT_EQ(truth.front().curve_id, 0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const int step = truth[i].curve_id - truth[i - 1].curve_id;
    EXPECT_TRUE(step == 0 || step == 1);
    EXPECT_NEAR(truth[i].tangent.norm(), 1, 1e-12);
    if (step > 0) continue;
    const Eigen::Vector3d chord = truth[i].position - truth[i - 1].position;
    EXPECT_NEAR(chord.norm(), 20.0 / 500, 0.05 * 20 / 500);
    EXPECT_GT(chord.normalized().dot(truth[i].tangent), 0.99);
  }
}

TEST(SyntheticSceneTest, PatternsAndShadowsAddMarkingsAndLampsAddNothing) {
  SyntheticOptions options = SmallOptions();
  const std::size_t num_plain = Make(options).truth.size();
  options.pattern = SurfacePattern::kBrick;
  const std::vector<TrueSample> painted = Make(options).truth;
  options.shadows = true;
  const SyntheticScene sunny = Make(options);
  options.reflections = true;
  const SyntheticScene shiny = Make(options);
  ASSERT_GT(painted.size(), num_plain);
  ASSERT_GT(sunny.truth.size(), painted.size());
  for (std::size_t i = 0; i < sunny.truth.size(); ++i) {
    EXPECT_EQ(sunny.truth[i].kind,
              i < num_plain ? CurveKind::kCrease : CurveKind::kMarking);
  }
  ASSERT_EQ(shiny.truth.size(), sunny.truth.size());
  EXPECT_EQ(shiny.truth.back().position, sunny.truth.back().position);
  EXPECT_NE(shiny.images[0].pixels, sunny.images[0].pixels);
}

TEST(SyntheticSceneTest, EverySampleIsAnEdgeOnlyWhereItIsSeen) {
  const SyntheticScene scene = Make(SmallOptions());
  int num_seen = 0;
  int num_edge = 0;
  for (const TrueSample& sample : scene.truth) {
    EXPECT_LE(sample.num_views_edge, sample.num_views_seen);
    EXPECT_LE(sample.num_views_seen, 6);
    num_seen += sample.num_views_seen;
    num_edge += sample.num_views_edge;
  }
  EXPECT_GT(num_edge, 0.85 * num_seen);
  const auto num_samples = static_cast<double>(scene.truth.size());
  EXPECT_LT(num_seen, 0.8 * 6 * num_samples);  // a solid hides its back
  EXPECT_GT(num_seen, 0.3 * 6 * num_samples);
}

TEST(SyntheticSceneTest, BoxCornersAreSeenFromTheSidesTheyFace) {
  SyntheticOptions options = SmallOptions();
  options.solid = SyntheticSolid::kBlock;
  options.num_views = 24;
  const SyntheticScene scene = Make(options);
  // The lower edge at y = -0.35: from y < -0.35, or from below.
  int num_expected = 0;
  for (const View& view : scene.scene.views) {
    const Eigen::Vector3d eye = view.cam_from_world.Inverse().translation;
    num_expected += eye.y() < -0.35 || eye.z() < -0.275;
  }
  int num_checked = 0;
  for (const TrueSample& sample : scene.truth) {
    if (std::abs(sample.position.y() + 0.35) > 1e-9 ||
        std::abs(sample.position.z() + 0.275) > 1e-9 ||
        std::abs(sample.position.x()) > 0.45) {
      continue;
    }
    ++num_checked;
    EXPECT_EQ(sample.num_views_seen, num_expected);
  }
  EXPECT_GT(num_checked, 400);
}

TEST(SyntheticSceneTest, PointsAreWhereTheirViewsSeeThem) {
  SyntheticOptions options = SmallOptions();
  options.points_per_view = 50;
  const SyntheticScene scene = Make(options);
  ASSERT_GT(scene.scene.points.size(), 20u);
  ASSERT_LE(scene.scene.points.size(), 300u);
  for (const ScenePoint& point : scene.scene.points) {
    EXPECT_GE(point.view_idxs.size(), 2u);
    ASSERT_EQ(point.view_idxs.size(), point.pixels.size());
    int last = -1;
    for (std::size_t i = 0; i < point.view_idxs.size(); ++i) {
      EXPECT_LT(last, point.view_idxs[i]);
      last = point.view_idxs[i];
      const auto view = static_cast<std::size_t>(last);
      EXPECT_LT(
          (Project(scene.scene, view, point.position) - point.pixels[i]).norm(),
          1e-6);
    }
  }
}

TEST(SyntheticSceneTest, AFacadeGrowsWithItsViewsWhichSeeAPartOfIt) {
  SyntheticOptions options = SmallOptions();
  options.solid = SyntheticSolid::kFacade;
  options.points_per_view = 10;
  for (const int num_views : {20, 60}) {
    options.num_views = num_views;
    const SyntheticScene scene = Make(options);
    Eigen::AlignedBox3d box;
    for (const TrueSample& sample : scene.truth) box.extend(sample.position);
    EXPECT_NEAR(box.sizes().x(), 0.06 * num_views, 0.3);
    EXPECT_NEAR(box.sizes().z(), 1, 1e-9);
    double num_sights = 0;
    for (const ScenePoint& point : scene.scene.points) {
      num_sights += static_cast<double>(point.view_idxs.size());
    }
    const double mean =
        num_sights / static_cast<double>(scene.scene.points.size());
    EXPECT_GT(mean, 10);
    EXPECT_LT(mean, 30);
  }
}

TEST(SyntheticSceneTest, NoiseHasTheStandardDeviationAskedFor) {
  SyntheticOptions options = SmallOptions();
  const SyntheticScene clean = Make(options);
  options.noise = 6;
  const SyntheticScene noisy = Make(options);
  double sum = 0;
  double sum_squared = 0;
  double count = 0;
  for (std::size_t i = 0; i < clean.images[3].pixels.size(); ++i) {
    const int grey = clean.images[3].pixels[i];
    if (grey < 40 || grey > 215) continue;  // not clipped
    const double difference = noisy.images[3].pixels[i] - grey;
    sum += difference;
    sum_squared += difference * difference;
    count += 1;
  }
  ASSERT_GT(count, 2000);
  EXPECT_NEAR(sum / count, 0, 0.5);
  EXPECT_NEAR(std::sqrt(sum_squared / count), 6, 0.4);
}

TEST(SyntheticSceneTest, PoseErrorMovesProjectionsByWhatWasAsked) {
  SyntheticOptions options = SmallOptions();
  const SyntheticScene exact = Make(options);
  options.pose_error_px = 1.5;
  const SyntheticScene disturbed = Make(options);
  for (std::size_t view = 0; view < exact.images.size(); ++view) {
    EXPECT_EQ(exact.images[view].pixels, disturbed.images[view].pixels);
    double sum = 0;
    for (const TrueSample& sample : exact.truth) {
      sum += (Project(exact.scene, view, sample.position) -
              Project(disturbed.scene, view, sample.position))
                 .squaredNorm();
    }
    const auto num_samples = static_cast<double>(exact.truth.size());
    EXPECT_NEAR(std::sqrt(sum / num_samples), 1.5, 0.1);
  }
}

TEST(SyntheticSceneTest, DistortionBendsThePicturesAsTheCameraSays) {
  for (const CameraModel model : {CameraModel::kSimpleRadial,
                                  CameraModel::kOpenCVFisheye,
                                  CameraModel::kFov}) {
    SyntheticOptions options = SmallOptions();
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 3;
    options.width = options.height = 320;
    const double straight = MeanContrast(Make(options));
    options.camera_model = model;
    options.distortion = model == CameraModel::kFov ? 0.8 : -0.4;
    SyntheticScene scene = Make(options);
    EXPECT_NEAR(MeanContrast(scene), straight, 0.15 * straight);
    double& coefficient =
        scene.scene.cameras[0]
            .params[model == CameraModel::kSimpleRadial ? 3 : 4];
    EXPECT_EQ(coefficient, options.distortion);
    coefficient = 0;
    EXPECT_LT(MeanContrast(scene), 0.8 * straight);
  }
}

TEST(SyntheticSceneTest, ViewsSurroundTheSolidAndHoldAllOfIt) {
  SyntheticOptions options = SmallOptions();
  options.num_views = 24;
  const SyntheticScene scene = Make(options);
  std::vector<Eigen::Vector3d> directions;
  for (const View& view : scene.scene.views) {
    directions.push_back(
        view.cam_from_world.Inverse().translation.normalized());
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    double nearest = 180;
    for (std::size_t j = 0; j < directions.size(); ++j) {
      if (i == j) continue;
      const double cosine = directions[i].dot(directions[j]);
      nearest = std::min(nearest, RadToDeg(std::acos(cosine)));
    }
    EXPECT_GT(nearest, 10);
    EXPECT_LT(nearest, 40);
    for (const TrueSample& sample : scene.truth) {
      const Eigen::Vector2d pixel = Project(scene.scene, i, sample.position);
      EXPECT_TRUE(pixel.x() > 0 && pixel.x() < 160 && pixel.y() > 0 &&
                  pixel.y() < 120);
    }
  }
}

TEST(SyntheticSceneTest, WorksWithEveryCameraModel) {
  for (int id = 0; id <= static_cast<int>(CameraModel::kEucm); ++id) {
    SyntheticOptions options = SmallOptions();
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 3;
    options.camera_model = static_cast<CameraModel>(id);
    const SyntheticScene scene = Make(options);
    EXPECT_TRUE(Validate(scene.scene.cameras[0]).ok());
    EXPECT_GT(MeanContrast(scene), 20) << ModelName(options.camera_model);
  }
}

TEST(SyntheticSceneTest, RefusesOptionsOutOfRangeByName) {
  const auto message = [](const auto& change) {
    SyntheticOptions options;
    change(options);
    const Result<SyntheticScene> scene = MakeSyntheticScene(options);
    EXPECT_EQ(scene.status().code(), StatusCode::kInvalidArgument);
    return scene.status().message();
  };
  using Options = SyntheticOptions;
  EXPECT_THAT(message([](Options& o) { o.num_views = 2; }),
              HasSubstr("num_views is 2; it must be >= 3 and"));
  EXPECT_THAT(message([](Options& o) { o.width = 15; }), HasSubstr("width"));
  EXPECT_THAT(message([](Options& o) { o.height = 1 << 30; }),
              HasSubstr("height"));
  EXPECT_THAT(message([](Options& o) { o.noise = -1; }), HasSubstr("noise"));
  EXPECT_THAT(message([](Options& o) { o.noise = std::nan(""); }),
              HasSubstr("noise"));
  EXPECT_THAT(message([](Options& o) { o.texture = -1; }),
              HasSubstr("texture"));
  EXPECT_THAT(message([](Options& o) { o.scale = 0; }), HasSubstr("scale"));
  EXPECT_THAT(message([](Options& o) { o.pose_error_px = -1; }),
              HasSubstr("pose_error_px"));
  EXPECT_THAT(message([](Options& o) { o.distortion = 0.1; }),
              HasSubstr("PINHOLE has no radial coefficient"));
  EXPECT_THAT(message([](Options& o) {
                o.camera_model = CameraModel::kSimpleRadial;
                o.distortion = 2;
              }),
              HasSubstr("with SIMPLE_RADIAL it must be between"));
}

}  // namespace
}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "base/parallel.h"
#include "synthetic/camera_rig.h"
#include "synthetic/counter_random.h"
#include "synthetic/render.h"
#include "synthetic/solid.h"
#include "synthetic/surfaces.h"
#include "synthetic/synthetic_truth.h"
#include "synthetic/walks.h"

namespace curvix {
namespace {

// Independent streams of random numbers out of one seed.
enum Stream : std::uint64_t { kPoses, kTexture, kNoise, kPoseError, kPoints };

// "noise is -1; it must be >= 0" unless min <= value <= max.
Status CheckRange(const char* name, double value, double min, double max) {
  if (value >= min && value <= max) return {};
  std::ostringstream text;
  text << name << " is " << value << "; it must be between " << min << " and "
       << max;
  return {StatusCode::kInvalidArgument, text.str()};
}

Status Check(const SyntheticOptions& options) {
  constexpr int kMaxSide = 8192;      // pixels
  constexpr double kMaxPixels = 1e9;  // of all images
  const double num_pixels =
      1.0 * options.num_views * options.width * options.height;
  for (const Status& status :
       {CheckRange("num_views", options.num_views, 3, 999),
        CheckRange("width", options.width, 16, kMaxSide),
        CheckRange("height", options.height, 16, kMaxSide),
        CheckRange("noise", options.noise, 0, 255),
        CheckRange("texture", options.texture, 0, 255),
        CheckRange("pose_error_px", options.pose_error_px, 0, 100),
        CheckRange("scale", options.scale, 1e-6, 1e6),
        CheckRange("points_per_view", options.points_per_view, 0, 10000),
        CheckRange("num_views * width * height", num_pixels, 0, kMaxPixels)}) {
    if (!status.ok()) return status;
  }
  return {};
}

std::string ViewName(std::size_t i) {
  std::string number = std::to_string(i);
  number.insert(0, 3 - std::min<std::size_t>(3, number.size()), '0');
  return "view_" + number + ".png";
}

RgbImage WithNoise(const RenderedImage& rendered,
                   double sigma,
                   std::uint64_t seed) {
  RgbImage image{rendered.width, rendered.height, {}};
  image.pixels.reserve(3 * rendered.grey.size());
  for (std::size_t i = 0; i < rendered.grey.size(); ++i) {
    double grey = static_cast<double>(rendered.grey[i]);
    if (sigma > 0) grey += sigma * Gaussian(seed, i);
    const auto level =
        static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
    image.pixels.insert(image.pixels.end(), 3, level);
  }
  return image;
}

// A few points all over the solid, to measure disturbances on.
std::vector<Eigen::Vector3d> EveryFiftieth(
    const std::vector<TrueSample>& samples) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < samples.size(); i += 50) {
    points.push_back(samples[i].position);
  }
  return points;
}

std::vector<Rigid3> Poses(const SyntheticOptions& options, const Solid& solid) {
  const std::uint64_t seed = Mix(options.seed, kPoses);
  switch (options.solid) {
    case SyntheticSolid::kFacade:
      return MakeStreetPoses(options.num_views, options.scale, seed);
    case SyntheticSolid::kRoom:
      return MakeRoomPoses(options.num_views, options.scale, seed);
    default:
      return MakePoses(options.num_views, solid.radius(), seed);
  }
}

// All that is known, with a kind each.
std::vector<TrueSample> SampleTruth(const Solid& solid,
                                    const Surfaces& surfaces,
                                    double step) {
  const std::vector<TrueCurve> creases = CreaseCurves(solid);
  std::vector<TrueCurve> curves = creases;
  for (const TrueCurve& marking : MarkingCurves(solid, surfaces)) {
    curves.push_back(marking);
  }
  std::vector<TrueSample> samples = SampleCurves(curves, step);
  for (const TrueSample& sample : SampleShadowEdges(
           solid, surfaces, creases, step, static_cast<int>(curves.size()))) {
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace

Result<SyntheticScene> MakeSyntheticScene(const SyntheticOptions& options) {
  if (Status status = Check(options); !status.ok()) return status;
  Result<Camera> camera = MakeCamera(options);
  if (!camera.ok()) return camera.status();

  const Solid solid = MakeSolid(
      options.solid, options.scale, options.num_views, options.pattern);
  const Surfaces surfaces(solid,
                          {options.scale,
                           options.texture,
                           options.shadows,
                           options.reflections,
                           Mix(options.seed, kTexture)});
  const std::vector<Rigid3> poses = Poses(options, solid);

  SyntheticScene scene;
  scene.scene.cameras = {*camera};
  scene.truth = SampleTruth(solid, surfaces, options.scale / 500);
  scene.scene.points = FindPoints(solid,
                                  *camera,
                                  poses,
                                  options.points_per_view,
                                  Mix(options.seed, kPoints),
                                  options.num_threads);
  const auto places = EveryFiftieth(scene.truth);
  scene.scene.views.resize(poses.size());
  scene.images.resize(poses.size());
  std::vector<std::vector<SampleInView>> looks(poses.size());
  ParallelFor(poses.size(), options.num_threads, [&](std::size_t i) {
    const RenderedImage image = Render(solid, surfaces, *camera, poses[i]);
    looks[i] = LookAtSamples(scene.truth, solid, *camera, poses[i], image);
    scene.images[i] =
        WithNoise(image, options.noise, Mix(Mix(options.seed, kNoise), i));
    View& view = scene.scene.views[i];
    view.name = ViewName(i);
    view.image_id = static_cast<std::uint32_t>(i + 1);
    view.cam_from_world = Disturbed(poses[i],
                                    *camera,
                                    places,
                                    options.pose_error_px,
                                    Mix(Mix(options.seed, kPoseError), i));
  });
  for (const std::vector<SampleInView>& view_looks : looks) {
    for (std::size_t i = 0; i < view_looks.size(); ++i) {
      scene.truth[i].num_views_seen += view_looks[i].is_seen;
      scene.truth[i].num_views_edge += view_looks[i].is_edge;
    }
  }
  return scene;
}

}  // namespace curvix

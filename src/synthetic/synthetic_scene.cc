// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "base/cancelled.h"
#include "base/parallel.h"
#include "synthetic/camera_rig.h"
#include "synthetic/counter_random.h"
#include "synthetic/scenes.h"
#include "synthetic/surfaces.h"
#include "synthetic/synthetic_truth.h"

namespace curvix {
namespace {

// Independent streams of random numbers out of one seed.
enum Stream : std::uint64_t { kPoses, kTexture, kNoise, kPoseError, kPoints };

std::string ViewName(std::size_t i) {
  std::string number = std::to_string(i);
  number.insert(0, 3 - std::min<std::size_t>(3, number.size()), '0');
  return "view_" + number + ".png";
}

SyntheticImage WithNoise(const GrayImage& rendered,
                         double sigma,
                         std::uint64_t seed) {
  SyntheticImage image{rendered.width, rendered.height, {}};
  image.pixels.reserve(rendered.pixels.size());
  for (std::size_t i = 0; i < rendered.pixels.size(); ++i) {
    double grey = static_cast<double>(rendered.pixels[i]);
    if (sigma > 0) grey += sigma * Gaussian(seed, i);
    image.pixels.push_back(
        static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0))));
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
  std::ranges::copy(MarkingCurves(solid, surfaces), std::back_inserter(curves));
  std::vector<TrueSample> samples = SampleCurves(curves, step);
  std::ranges::copy(
      SampleShadowEdges(
          solid, surfaces, creases, step, static_cast<int>(curves.size())),
      std::back_inserter(samples));
  return samples;
}

}  // namespace

std::vector<OptionRow> OptionTable(SyntheticOptions& options) {
  return {{.name = "shadows",
           .field = &options.shadows,
           .help = "1: the sun casts shadows"},
          {.name = "reflections",
           .field = &options.reflections,
           .help = "1: lamps are mirrored in the surfaces"},
          {.name = "num_views",
           .field = &options.num_views,
           .min = 3,
           .max = 999,
           .help = "images: all around, along a facade, or in a room"},
          {.name = "width",
           .field = &options.width,
           .min = 16,
           .max = 8192,
           .unit = "px",
           .help = "width of an image"},
          {.name = "height",
           .field = &options.height,
           .min = 16,
           .max = 8192,
           .unit = "px",
           .help = "height of an image"},
          {.name = "noise",
           .field = &options.noise,
           .max = 255,
           .unit = "grey levels",
           .help = "standard deviation of the image noise"},
          {.name = "texture",
           .field = &options.texture,
           .max = 255,
           .unit = "grey levels",
           .help = "contrast of the texture on the surfaces"},
          {.name = "pose_error_px",
           .field = &options.pose_error_px,
           .max = 100,
           .unit = "px",
           .help = "disturbs the poses that are written"},
          {.name = "scale",
           .field = &options.scale,
           .min = 1e-6,
           .max = 1e6,
           .help = "longest side of the solid, height of a facade; world "
                   "units"},
          {.name = "points_per_view",
           .field = &options.points_per_view,
           .max = 10000,
           .help = "sparse points that each image finds"},
          {.name = "num_threads",
           .field = &options.num_threads,
           .min = -1,
           .max = 4096,
           .help = "threads; -1 or 0 means one per core"}};
}

Status Validate(const SyntheticOptions& options) {
  SyntheticOptions copy = options;
  for (const OptionRow& row : OptionTable(copy)) {
    CURVIX_RETURN_IF_ERROR(CheckRange(row));
  }
  constexpr double kMaxPixels = 1e9;
  if (1.0 * options.num_views * options.width * options.height > kMaxPixels) {
    return Status::InvalidArgument(
        "num_views * width * height is more than 1e9");
  }
  return MakeCamera(options).status();
}

Result<SyntheticScene> MakeSyntheticScene(
    const SyntheticOptions& options, const std::function<bool()>& keep_going) {
  CURVIX_RETURN_IF_ERROR(Validate(options));
  const Result<Camera> camera = MakeCamera(options);

  const Solid solid = MakeSolid(
      options.solid, options.scale, options.num_views, options.pattern);
  SyntheticOptions of_surfaces = options;
  of_surfaces.seed = Mix(options.seed, kTexture);
  const Surfaces surfaces(solid, of_surfaces);
  const std::vector<Rigid3> poses = Poses(options, solid);

  bool is_cancelled = false;
  const auto goes_on = [&](std::size_t) {
    is_cancelled = is_cancelled || (keep_going && !keep_going());
    return !is_cancelled;
  };
  SyntheticScene scene;
  scene.scene.cameras = {*camera};
  scene.truth = SampleTruth(solid, surfaces, options.scale / 500);
  scene.scene.points = FindPoints(solid,
                                  *camera,
                                  poses,
                                  options.points_per_view,
                                  Mix(options.seed, kPoints),
                                  options.num_threads,
                                  goes_on);
  if (is_cancelled) return CancelledStatus();
  const auto places = EveryFiftieth(scene.truth);
  scene.scene.views.resize(poses.size());
  scene.images.resize(poses.size());
  std::vector<std::vector<SampleInView>> looks(poses.size());
  const auto make_view = [&](std::size_t i) {
    const GrayImage image = Render(solid, surfaces, *camera, poses[i]);
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
    return true;
  };
  ParallelForWhile(poses.size(), options.num_threads, make_view, goes_on);
  if (is_cancelled) return CancelledStatus();
  for (const std::vector<SampleInView>& view_looks : looks) {
    for (std::size_t i = 0; i < view_looks.size(); ++i) {
      scene.truth[i].num_views_seen += view_looks[i].is_seen;
      scene.truth[i].num_views_edge += view_looks[i].is_edge;
    }
  }
  return scene;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Synthetic scenes with exact curves: for tests, for
// the quick start, and for trying the tool. Nothing here knows how curves are
// reconstructed.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/option_table.h"
#include "synthetic/primitive.h"

namespace curvix {

enum class SyntheticSolid {
  kBlock,     // a box with a step: straight edges only
  kCylinder,  // an upright cylinder on a plate: circles and occluding contours
  kCone,      // a truncated cone on a plate
  kSphere,    // a sphere cut by a plane: one circle, and an occluding contour
  kPart,      // a bracket with a hole, a boss and a cone: all of the above
  kFacade,    // the front of a row of houses, as long as the views need
  kHouse,     // a house with windows, ledges, an awning and a sign
  kTable,     // boxes, cards, a ball, a cup and a bottle on a table
  kKnobs,     // rounded blocks with knobs and a bottle
  kRoom,      // a room from within: door, window, desk, shelf, pictures
};

struct SyntheticOptions {
  SyntheticSolid solid = SyntheticSolid::kPart;
  int num_views = 24;
  int width = 480;     // pixels
  int height = 480;    // pixels
  double noise = 0;    // standard deviation, grey levels
  double texture = 0;  // contrast of surface texture, grey levels: spots,
                       // whose outlines are not part of the truth
  // Painted on the surfaces; its outlines are part of the truth.
  SurfacePattern pattern = SurfacePattern::kNone;
  bool shadows = false;      // the sun casts shadows, with hard edges
  bool reflections = false;  // bright lamps are mirrored in the surfaces
  CameraModel camera_model = CameraModel::kPinhole;
  // The first radial coefficient, -0.5 to 0.5; FOV's omega and EUCM's alpha, 0
  // to 0.9; 0 for models that have none.
  double distortion = 0;
  // Root mean square by which the projections of the truth move when the
  // written poses replace those that the images were rendered with.
  double pose_error_px = 0;
  // Longest side of the solid, height of the facade; world units.
  double scale = 1;
  int points_per_view = 0;  // sparse points found by each view
  std::uint64_t seed = 1;
  int num_threads = 0;  // 0: all cores; the result does not depend on it
};

// Grey levels, row-major.
struct SyntheticImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

// One exact sample of a sharp edge, or of a marking.
struct TrueSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit
  int curve_id = 0;
  int num_views_seen = 0;  // views in which nothing hides it
  int num_views_edge = 0;  // of these, with a difference of 8 grey levels
                           // across (1.5 px to both sides, without noise)
  CurveKind kind = CurveKind::kUnknown;
};

struct SyntheticScene {
  // Poses as written, views named view_000.png ..., along the facade in order;
  // points of the surface that two exact cameras or more see.
  Scene scene;
  // One per view, rendered with the exact poses.
  std::vector<SyntheticImage> images;
  std::vector<TrueSample> truth;  // every scale/500 along each sharp edge
};

// The numbers with their ranges, but for the seed and for `distortion`, whose
// range depends on the camera model. The pointers lead into `options`.
std::vector<OptionRow> OptionTable(SyntheticOptions& options);

// kInvalidArgument if an option is out of range.
Status Validate(const SyntheticOptions& options);

// Deterministic for equal options. Errors of Validate; kCancelled if
// keep_going, which is asked after each point and view, returns false.
Result<SyntheticScene> MakeSyntheticScene(
    const SyntheticOptions& options,
    const std::function<bool()>& keep_going = {});

}  // namespace curvix

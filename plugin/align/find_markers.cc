// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/find_markers.h"

#include <curvix/reconstruct.h>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/camera_of.h"
#include "geometry/fit_point.h"
#include "geometry/lens.h"
#include "plugin/align/marker_corners.h"
#include "plugin/align/marker_detector.h"
#include "plugin/base/image_file.h"

namespace curvix {
namespace {

constexpr std::size_t kMinViews = 3;
// Corners that miss their projections by more are of two markers with one
// number, or badly seen.
constexpr double kMaxErrorPx = 3;
constexpr double kLeastSigmaPx = 0.02;

// Where the corners of a marker are seen.
using Sightings = std::array<std::vector<PointInImage>, 4>;

struct Corner {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;  // for 1 px
};

// The point nearest to all rays. nullopt: they are parallel.
std::optional<Eigen::Vector3d> NearestToRays(
    const std::vector<PointInImage>& seen) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const PointInImage& point : seen) {
    const auto uv = IdealFromImage(*point.camera, point.pixel);
    if (!uv) continue;
    const Rigid3 world_from_cam = point.cam_from_world.Inverse();
    const Eigen::Vector3d ray =
        world_from_cam.rotation * uv->homogeneous().normalized();
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - ray * ray.transpose();
    normal += across;
    right += across * world_from_cam.translation;
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible()) return std::nullopt;
  return solver.solve(right);
}

// Adds to `errors` the distances from the projections, in pixels.
std::optional<Corner> Triangulate(const std::vector<PointInImage>& seen,
                                  std::vector<double>& errors) {
  const std::optional<Eigen::Vector3d> start = NearestToRays(seen);
  if (!start) return std::nullopt;
  Corner corner;
  corner.position = FitPoint(*start, seen);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const PointInImage& point : seen) {
    const auto pixel =
        Project(*point.camera, point.cam_from_world, corner.position);
    if (!pixel) return std::nullopt;
    const Eigen::Matrix<double, 2, 3> jacobian =
        PixelJacobian(*point.camera, point.cam_from_world * corner.position) *
        point.cam_from_world.rotation.toRotationMatrix();
    information += jacobian.transpose() * jacobian;
    errors.push_back((*pixel - point.pixel).norm());
  }
  corner.covariance = information.inverse();
  return corner;
}

// The side of the square nearest to the corners, and its variance for corners
// seen to 1 px.
std::pair<double, double> FitSquare(const std::array<Corner, 4>& corners) {
  Eigen::Matrix<double, 3, 4> square, seen;
  square << -0.5, 0.5, 0.5, -0.5,  //
      -0.5, -0.5, 0.5, 0.5,        //
      0, 0, 0, 0;
  for (int i = 0; i < 4; ++i) {
    seen.col(i) = corners[static_cast<std::size_t>(i)].position;
  }
  const Eigen::Matrix4d fit = Eigen::umeyama(square, seen, true);
  const Eigen::Matrix3d turned = fit.block<3, 3>(0, 0);
  const double side = turned.col(0).norm();
  // The side is the mean of the corners along the half diagonals.
  const double sum = square.squaredNorm();
  double variance = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d gradient = turned / side * square.col(i) / sum;
    variance += gradient.dot(corners[static_cast<std::size_t>(i)].covariance *
                             gradient);
  }
  return {side, variance};
}

// Of each view.
Result<std::vector<std::vector<SeenMarker>>> DetectInViews(
    const Scene& scene, const std::string& dictionary, int num_threads) {
  std::vector<std::vector<SeenMarker>> seen(scene.views.size());
  std::vector<Status> statuses(scene.views.size());
  ParallelFor(scene.views.size(), num_threads, [&](std::size_t i) {
    const View& view = scene.views[i];
    const Result<cv::Mat> image =
        ReadImage(view.image_path, cv::IMREAD_GRAYSCALE);
    if (!image.ok()) {
      statuses[i] = image.status();
      return;
    }
    seen[i] = DetectMarkers(*image, dictionary);
  });
  for (const Status& status : statuses) {
    if (!status.ok()) return status;
  }
  return seen;
}

// The views that show markers, without masks, which may hide them.
Scene ViewsWithMarkers(const Scene& scene,
                       std::vector<std::vector<SeenMarker>>& seen) {
  Scene chosen;
  chosen.cameras = scene.cameras;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (seen[i].empty()) continue;
    chosen.views.push_back(scene.views[i]);
    chosen.views.back().mask_path.clear();
  }
  std::erase_if(seen, [](const auto& markers) { return markers.empty(); });
  return chosen;
}

using SightingsById = std::map<int, Sightings>;

// Of all views, by the number of the marker.
Result<SightingsById> Detect(const Scene& scene,
                             const std::string& dictionary,
                             const RuntimeOptions& runtime) {
  auto seen = DetectInViews(scene, dictionary, runtime.num_threads);
  if (!seen.ok()) return seen.status();
  const Scene chosen = ViewsWithMarkers(scene, *seen);
  if (chosen.views.size() < kMinViews) return SightingsById();
  Options options;
  options.runtime = runtime;
  const Result<std::vector<EdgeMap>> edges = DetectEdges(chosen, options);
  if (!edges.ok()) return edges.status();
  SightingsById by_id;
  for (std::size_t i = 0; i < chosen.views.size(); ++i) {
    const View& view = chosen.views[i];
    const Camera& camera = CameraOf(scene, view);
    for (const SeenMarker& marker : (*seen)[i]) {
      const std::optional<SeenMarker> refined =
          CornersFromSides(marker, camera, (*edges)[i].edges);
      if (!refined) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        by_id[marker.id][k].push_back(
            {&camera, view.cam_from_world, refined->corners[k]});
      }
    }
  }
  return by_id;
}

// A marker with the variance of its logarithmic scale for 1 px, and what its
// corners leave; or why it is left out.
struct Triangulated {
  std::optional<FoundMarker> marker;
  double variance = 0;
  std::vector<double> errors;
  std::string problem;
};

Triangulated TriangulateMarker(int id,
                               const Sightings& sightings,
                               double size) {
  Triangulated result;
  result.problem = "marker " + std::to_string(id) + " is left out: ";
  if (sightings[0].size() < kMinViews) {
    result.problem +=
        "fewer than " + std::to_string(kMinViews) + " images show it";
    return result;
  }
  std::array<Corner, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto corner = Triangulate(sightings[k], result.errors);
    if (!corner) {
      result.problem += "its corners have no place in space";
      return result;
    }
    corners[k] = *corner;
  }
  if (Median(result.errors) > kMaxErrorPx) {
    result.problem +=
        "images disagree about its place; is there another "
        "with this number?";
    return result;
  }
  const auto [side, variance] = FitSquare(corners);
  result.marker = FoundMarker{
      id, static_cast<int>(sightings[0].size()), side, {size / side, 0}};
  result.variance = variance / (side * side);
  return result;
}

}  // namespace

Result<FoundMarkers> FindMarkers(const Scene& scene,
                                 const std::string& dictionary,
                                 double size,
                                 const RuntimeOptions& runtime) {
  const Result<SightingsById> by_id = Detect(scene, dictionary, runtime);
  if (!by_id.ok()) return by_id.status();
  FoundMarkers found;
  std::vector<double> errors, variances;
  for (const auto& [id, sightings] : *by_id) {
    Triangulated t = TriangulateMarker(id, sightings, size);
    if (!t.marker) {
      found.notes.push_back(t.problem);
      continue;
    }
    found.markers.push_back(*t.marker);
    variances.push_back(t.variance);
    errors.insert(errors.end(), t.errors.begin(), t.errors.end());
  }
  if (found.markers.empty()) {
    return Status::NotFound(
        "no marker of " + dictionary + " is seen by " +
        std::to_string(kMinViews) + " images or more" +
        (found.notes.empty() ? "" : " (" + found.notes[0] + ")") +
        "; check the dictionary that --markers names");
  }
  // The median of the length of a normal vector of two is 1.177 of its sigma.
  found.corner_sigma_px = std::max(Median(errors) / 1.177, kLeastSigmaPx);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    found.markers[i].scale.sigma =
        found.corner_sigma_px * std::sqrt(variances[i]);
  }
  return found;
}

}  // namespace curvix

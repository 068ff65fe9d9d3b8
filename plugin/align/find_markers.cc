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

#include "base/angles.h"
#include "base/median.h"
#include "base/parallel.h"
#include "geometry/fit_point.h"
#include "geometry/lens.h"
#include "geometry/similarity.h"
#include "plugin/align/marker_detector.h"
#include "plugin/base/image_file.h"

namespace curvix {
namespace {

constexpr std::size_t kMinViews = 3;
// Corners that miss their projections by more are of two markers with one
// number, or badly seen.
constexpr double kMaxErrorPx = 3;
constexpr double kLeastSigmaPx = 0.02;
// Of a side, in all images alike: the response curve of the camera, blur and
// compression make dark squares larger or smaller, which no view tells.
constexpr double kCommonSideSigmaPx = 0.02;

// Where the corners of a marker are seen.
using Sightings = std::array<std::vector<PointInImage>, 4>;

struct Corner {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;  // for 1 px
};

// Of edges from the side of a marker.
constexpr double kSideReachPx = 2;
constexpr double kSideAngleDeg = 15;
constexpr double kLeftOut = 0.1;  // of a side, at either end
constexpr std::size_t kMinEdges = 5;
constexpr double kOutlierPx = 0.5;

struct ImageLine {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;  // unit

  double DistanceOf(const Eigen::Vector2d& p) const {
    return normal.dot(p - point);
  }
};

ImageLine FitLineTo(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) {
    scatter += (p - mean) * (p - mean).transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(scatter);
  return {mean, eigen.eigenvectors().col(0)};
}

// Through the edges along a side, twice: the second time without outliers.
std::optional<ImageLine> LineOfSide(const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& to,
                                    const std::vector<Edge2d>& edges) {
  const Eigen::Vector2d side = to - from;
  const double angle = std::atan2(side.y(), side.x());
  const Eigen::Vector2d along = side / side.squaredNorm();
  const Eigen::Vector2d normal =
      Eigen::Vector2d(-side.y(), side.x()).normalized();
  std::vector<Eigen::Vector2d> points;
  for (const Edge2d& edge : edges) {
    const Eigen::Vector2d offset = edge.position - from;
    const double at = along.dot(offset);
    if (std::abs(normal.dot(offset)) < kSideReachPx && at > kLeftOut &&
        at < 1 - kLeftOut &&
        UndirectedDifference(edge.angle, angle) < DegToRad(kSideAngleDeg)) {
      points.push_back(edge.position);
    }
  }
  if (points.size() < kMinEdges) return std::nullopt;
  const ImageLine first = FitLineTo(points);
  std::erase_if(points, [&](const Eigen::Vector2d& p) {
    return std::abs(first.DistanceOf(p)) > kOutlierPx;
  });
  if (points.size() < kMinEdges) return std::nullopt;
  return FitLineTo(points);
}

// The corners in which lines through the edges of the four sides meet.
// Detectors that look at a corner itself find it a tenth of a pixel inside,
// where blur has rounded it off; edges within a tenth of a side from a corner
// do not count. `edges` are those of the view in its ideal pinhole. nullopt: a
// side has too few edges.
std::optional<SeenMarker> CornersFromSides(const SeenMarker& marker,
                                           const Camera& camera,
                                           const std::vector<Edge2d>& edges) {
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Matrix3d inverse = calibration.inverse();
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto uv = IdealFromImage(camera, marker.corners[k]);
    if (!uv) return std::nullopt;
    corners[k] = (calibration * uv->homogeneous()).hnormalized();
  }
  std::array<std::optional<ImageLine>, 4> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    sides[k] = LineOfSide(corners[k], corners[(k + 1) % 4], edges);
    if (!sides[k]) return std::nullopt;
  }
  SeenMarker refined = marker;
  for (std::size_t k = 0; k < 4; ++k) {
    const ImageLine& before = *sides[(k + 3) % 4];
    const ImageLine& after = *sides[k];
    Eigen::Matrix2d normals;
    normals << before.normal.transpose(), after.normal.transpose();
    const Eigen::Vector2d corner =
        normals.inverse() * Eigen::Vector2d(before.normal.dot(before.point),
                                            after.normal.dot(after.point));
    const Eigen::Vector3d ray = inverse * corner.homogeneous();
    refined.corners[k] = ImageFromIdeal(camera, ray.hnormalized());
    if (!refined.corners[k].allFinite()) return std::nullopt;
  }
  return refined;
}

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

// Adds to `errors` the distances from the projections, as large as they would
// be from the true place, in pixels. Of two views or more.
std::optional<Corner> Triangulate(const std::vector<PointInImage>& seen,
                                  std::vector<double>& errors) {
  const std::optional<Eigen::Vector3d> start = NearestToRays(seen);
  if (!start) return std::nullopt;
  Corner corner;
  corner.position = FitPoint(*start, seen);
  // The fit takes up three of the two coordinates of each view.
  const double num_coordinates = 2 * static_cast<double>(seen.size());
  const double correction = std::sqrt(num_coordinates / (num_coordinates - 3));
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const PointInImage& point : seen) {
    const auto pixel =
        Project(*point.camera, point.cam_from_world, corner.position);
    if (!pixel) return std::nullopt;
    const Eigen::Matrix<double, 2, 3> jacobian =
        PixelJacobian(*point.camera, point.cam_from_world * corner.position) *
        point.cam_from_world.rotation.toRotationMatrix();
    information += jacobian.transpose() * jacobian;
    errors.push_back(correction * (*pixel - point.pixel).norm());
  }
  corner.covariance = information.inverse();
  return corner;
}

// The side of the square nearest to the corners, and its variance for corners
// seen to 1 px.
std::pair<double, double> FitSquare(const std::array<Corner, 4>& corners) {
  Eigen::Matrix3Xd square(3, 4), seen(3, 4);
  square << -0.5, 0.5, 0.5, -0.5,  //
      -0.5, -0.5, 0.5, 0.5,        //
      0, 0, 0, 0;
  for (int i = 0; i < 4; ++i) {
    seen.col(i) = corners[static_cast<std::size_t>(i)].position;
  }
  const Similarity3 fit = AlignPoints(square, seen);
  // The side is the mean of the corners along the half diagonals.
  const double sum = square.squaredNorm();
  double variance = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d gradient = fit.rotation * square.col(i) / sum;
    variance += gradient.dot(corners[static_cast<std::size_t>(i)].covariance *
                             gradient);
  }
  return {fit.scale, variance};
}

// The median length of a side in the images. Pixels.
double SideInImages(const Sightings& sightings) {
  std::vector<double> sides;
  for (std::size_t v = 0; v < sightings[0].size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      sides.push_back(
          (sightings[(k + 1) % 4][v].pixel - sightings[k][v].pixel).norm());
    }
  }
  return Median(std::move(sides));
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
  CURVIX_ASSIGN_OR_RETURN(
      auto seen, DetectInViews(scene, dictionary, runtime.num_threads));
  const Scene chosen = ViewsWithMarkers(scene, seen);
  if (chosen.views.size() < kMinViews) return SightingsById();
  Options options;
  options.runtime = runtime;
  CURVIX_ASSIGN_OR_RETURN(const std::vector<EdgeMap> edges,
                          DetectEdges(chosen, options));
  SightingsById by_id;
  for (std::size_t i = 0; i < chosen.views.size(); ++i) {
    const View& view = chosen.views[i];
    const Camera& camera = CameraOf(scene, view);
    for (const SeenMarker& marker : seen[i]) {
      const std::optional<SeenMarker> refined =
          CornersFromSides(marker, camera, edges[i].edges);
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
  result.marker = FoundMarker{id,
                              static_cast<int>(sightings[0].size()),
                              side,
                              {size / side, 0},
                              kCommonSideSigmaPx / SideInImages(sightings)};
  result.variance = variance / (side * side);
  return result;
}

}  // namespace

Result<FoundMarkers> FindMarkers(const Scene& scene,
                                 const std::string& dictionary,
                                 double size,
                                 const RuntimeOptions& runtime) {
  CURVIX_ASSIGN_OR_RETURN(const SightingsById by_id,
                          Detect(scene, dictionary, runtime));
  FoundMarkers found;
  std::vector<double> errors, variances;
  for (const auto& [id, sightings] : by_id) {
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
        "No marker of " + dictionary + " is seen by " +
        std::to_string(kMinViews) + " images or more" +
        (found.notes.empty() ? "" : " (" + found.notes[0] + ")") +
        "; check the dictionary that --markers names");
  }
  // The median of the length of a normal vector of two is 1.177 of its sigma.
  found.corner_sigma_px = std::max(Median(errors) / 1.177, kLeastSigmaPx);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    FoundMarker& marker = found.markers[i];
    marker.scale.sigma = std::hypot(
        found.corner_sigma_px * std::sqrt(variances[i]), marker.common_sigma);
  }
  return found;
}

}  // namespace curvix

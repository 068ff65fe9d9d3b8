// SPDX-License-Identifier: BSD-3-Clause
#include "poses/posed_edges.h"

#include <curvix/refine_poses.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/count_text.h"
#include "base/infinity.h"
#include "base/parallel.h"
#include "edge_detection/undistort_edges.h"
#include "edge_sketch/sketch_by_views.h"
#include "geometry/detected_edge.h"
#include "geometry/lens.h"
#include "geometry/nearest_edge.h"
#include "model/check_input.h"
#include "model/posed_view.h"

namespace curvix {
namespace {

// Of a place, whose unknowns are two of its axis and a radius; the larger where
// there are many such places.
constexpr std::size_t kFewSupports = 5;
constexpr std::size_t kUsualSupports = 6;
constexpr std::ptrdiff_t kManyPlaces = 1000;
// Query edges in all views. About half of them lead to a place, and a view sees
// about half of the places.
constexpr std::size_t kNumQueryEdges = 2500;
constexpr std::size_t kNumQueryEdgesPerView = 50;
constexpr double kEdgeGateSigmas = 4;
// More views add little, and the cost grows with the square of their number.
constexpr std::size_t kMaxViewsOfPlace = 40;
// Edges along one contour are one.
constexpr double kSameContourPx = 0.2;

}  // namespace

PosedEdges::PosedEdges(const Scene& scene,
                       const std::vector<EdgeMap>& edge_maps,
                       const Options& options)
    : scene_(scene),
      edge_maps_(edge_maps),
      options_(options),
      input_views_(MakePosedViews(scene)),
      views_(input_views_),
      distinct_(FindDistinctViews(views_, edge_maps, scene.points, options)),
      indices_(IndexViews(
          views_, edge_maps, distinct_, options.runtime.num_threads)),
      depths_(FindDepthRanges(
          views_, scene.points, options.hypotheses.depth_margin)),
      neighbors_(NeighborsInDirection(FindOverlaps(views_, scene.points),
                                      distinct_.stations)),
      moved_(Unmoved()) {}

std::size_t PosedEdges::NumMoved() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const Rigid3& increment = moved_.new_cam_from_cam[i];
    const bool stays =
        increment.translation.isZero(0) &&
        increment.rotation.coeffs() == Rigid3().rotation.coeffs() &&
        PresentCameraOf(i) == InputCameraOf(i);
    if (!stays) ++count;
  }
  return count;
}

const Camera& PosedEdges::PresentCameraOf(std::size_t view_idx) const {
  return moved_
      .cameras[static_cast<std::size_t>(scene_.views[view_idx].camera_idx)];
}

Rigid3 PosedEdges::PoseOf(std::size_t view_idx) const {
  return moved_.new_cam_from_cam[view_idx] *
         scene_.views[view_idx].cam_from_world;
}

void PosedEdges::Move(const MovedCameras& moved) {
  const std::vector<Camera> cameras = std::exchange(moved_, moved).cameras;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const auto k = static_cast<std::size_t>(scene_.views[i].camera_idx);
    if (moved_.cameras[k] == cameras[k]) {
      SetPose(PoseOf(i), &views_[i]);
    } else {
      views_[i] = MakePosedView(moved_.cameras[k], PoseOf(i));
    }
  }
}

const Camera& PosedEdges::InputCameraOf(std::size_t view_idx) const {
  return CameraOf(scene_, scene_.views[view_idx]);
}

std::optional<ImageEdge> PosedEdges::Seen(const OccludingContour& contour,
                                          std::size_t view_idx) const {
  const PosedView& view = views_[view_idx];
  const auto seen = ProjectInto(view, SeenFrom(contour, view.center));
  if (!seen) return std::nullopt;
  return CarryEdge(*seen, PresentCameraOf(view_idx), InputCameraOf(view_idx));
}

std::vector<EdgeMap> PosedEdges::CarriedMaps() const {
  std::vector<EdgeMap> carried(views_.size());
  ParallelFor(views_.size(), num_threads(), [&](std::size_t i) {
    auto edges =
        CarryEdges(edge_maps_[i], InputCameraOf(i), PresentCameraOf(i));
    if (edges) carried[i] = *std::move(edges);
  });
  return carried;
}

PlaceSketch PosedEdges::Sketch(double sigma_px, const StepDone& step_done) {
  std::size_t num_edges = 0;
  for (const EdgeMap& map : edge_maps_) num_edges += map.edges.size();
  const std::size_t num_asked =
      std::max(kNumQueryEdges, kNumQueryEdgesPerView * views_.size());
  Options options = options_;
  options.hypotheses.location_tolerance_px = 2 * sigma_px;
  options.validation.max_distance_px =
      std::max(options.validation.max_distance_px, kEdgeGateSigmas * sigma_px);
  const bool is_as_input = moved_.cameras == scene_.cameras;
  std::vector<EdgeMap> carried;
  std::vector<ViewIndex> carried_indices;
  if (!is_as_input) {
    carried = CarriedMaps();
    carried_indices = IndexViews(views_, carried, distinct_, num_threads());
  }
  std::vector<ViewIndex>& indices = is_as_input ? indices_ : carried_indices;
  const double reach_px = options.validation.max_distance_px;
  if (!is_as_input || presence_reach_px_ != reach_px) {
    AddPresence(options.validation, num_threads(), indices);
    if (is_as_input) presence_reach_px_ = reach_px;
  }
  const EdgeSketch sketch =
      SketchByViews({views_,
                     is_as_input ? edge_maps_ : carried,
                     indices,
                     distinct_,
                     depths_,
                     options,
                     sigma_px,
                     std::max<std::size_t>(1, num_edges / num_asked)},
                    step_done);
  const auto num_usual = std::ranges::count_if(
      sketch.edges,
      [](const Edge3d& edge) { return edge.support.size() >= kUsualSupports; });
  PlaceSketch result;
  result.min_supports =
      num_usual >= kManyPlaces ? kUsualSupports : kFewSupports;
  for (const Edge3d& edge : sketch.edges) {
    if (edge.support.size() < result.min_supports) continue;
    CurvePlace& place = result.places.emplace_back();
    place.contour.axis = {edge.position, edge.tangent};
    place.support = edge.support;
    place.contour = Adjusted(place, sigma_px);
  }
  return result;
}

std::vector<std::size_t> PosedEdges::QueryViews(const CurvePlace& place) const {
  std::vector<std::size_t> views, next_to_them;
  for (const EdgeRef& ref : place.support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    views.push_back(view_idx);
    for (const ViewNeighbor& neighbor : neighbors_[view_idx]) {
      next_to_them.push_back(static_cast<std::size_t>(neighbor.view_idx));
    }
  }
  if (views.size() >= kMaxViewsOfPlace) return SpreadViews(place, {}, views);
  std::ranges::sort(next_to_them);
  next_to_them.erase(std::unique(next_to_them.begin(), next_to_them.end()),
                     next_to_them.end());
  std::vector<std::size_t> others;
  std::ranges::set_difference(next_to_them, views, std::back_inserter(others));
  return SpreadViews(place, views, others);
}

std::vector<std::size_t> PosedEdges::SpreadViews(
    const CurvePlace& place,
    std::vector<std::size_t> taken,
    const std::vector<std::size_t>& others) const {
  const auto direction_of = [&](std::size_t view_idx) -> Eigen::Vector3d {
    return (input_views_[view_idx].center - place.contour.axis.position)
        .normalized();
  };
  std::vector<Eigen::Vector3d> directions;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t i : others) {
    directions.push_back(direction_of(i));
    sum += directions.back();
  }
  // Of each view, how near it is to the nearest that is taken, as a cosine.
  std::vector<double> nearness(others.size(), -1);
  const auto take = [&](const Eigen::Vector3d& direction) {
    for (std::size_t k = 0; k < others.size(); ++k) {
      nearness[k] = std::max(nearness[k], direction.dot(directions[k]));
    }
  };
  for (const std::size_t i : taken) take(direction_of(i));
  if (taken.empty()) take(sum.normalized());
  constexpr double kTaken = 2;
  for (std::size_t n = 0; n < others.size(); ++n) {
    if (taken.size() >= kMaxViewsOfPlace) break;
    const auto k = static_cast<std::size_t>(std::ranges::min_element(nearness) -
                                            nearness.begin());
    taken.push_back(others[k]);
    nearness[k] = kTaken;
    take(directions[k]);
  }
  std::ranges::sort(taken);
  return taken;
}

std::vector<EdgeRef> PosedEdges::FindEdges(
    const OccludingContour& contour,
    const std::vector<std::size_t>& views,
    const std::vector<double>& gates_px) const {
  std::vector<EdgeRef> found;
  for (const std::size_t i : views) {
    const auto projected = Seen(contour, i);
    if (!projected) continue;
    const auto nearest =
        NearestEdge(indices_[i].grid, *projected, Gate{gates_px[i]});
    if (nearest) found.push_back({static_cast<std::int32_t>(i), *nearest});
  }
  return found;
}

std::vector<std::vector<const CurvePlace*>> PosedEdges::PlacesByView(
    const std::vector<CurvePlace>& places) const {
  std::vector<std::vector<const CurvePlace*>> by_view(views_.size());
  for (const CurvePlace& place : places) {
    for (const std::size_t i : QueryViews(place)) by_view[i].push_back(&place);
  }
  return by_view;
}

std::vector<EdgesAround> PosedEdges::LookAround(
    const std::vector<const CurvePlace*>& places,
    std::size_t view_idx,
    double reach_px) const {
  std::vector<EdgesAround> result;
  for (const CurvePlace* place : places) {
    const auto projected = Seen(place->contour, view_idx);
    if (!projected) continue;
    const Eigen::Vector2d& tangent = projected->tangent;
    const Gate gate{reach_px};
    EdgesAround around;
    around.normal = projected->Normal();
    const auto look = [&](const IndexedEdge& edge) {
      const Eigen::Vector2d offset =
          edge.position.cast<double>() - projected->position;
      const double distance = around.normal.dot(offset);
      const auto is_same = [&](double other) {
        return std::abs(other - distance) < kSameContourPx;
      };
      if (std::abs(edge.tangent.cast<double>().dot(tangent)) >=
              gate.min_cosine &&
          std::abs(offset.dot(tangent)) <= gate.tangential_px &&
          std::abs(distance) <= gate.normal_px &&
          std::ranges::none_of(around.distances_px, is_same)) {
        around.distances_px.push_back(distance);
      }
    };
    indices_[view_idx].grid.VisitAround(projected->position, reach_px, look);
    if (!around.distances_px.empty()) result.push_back(std::move(around));
  }
  return result;
}

ImageEdge PosedEdges::InputEdge(const EdgeRef& ref) const {
  return ToImageEdge(EdgeOf(ref, edge_maps_));
}

ImageEdge PosedEdges::DistortedEdge(const EdgeRef& ref) const {
  const auto i = static_cast<std::size_t>(ref.view_idx);
  return EdgeInImage(InputEdge(ref), InputCameraOf(i));
}

double PosedEdges::Distance(const OccludingContour& contour,
                            const EdgeRef& ref) const {
  const auto seen = Seen(contour, static_cast<std::size_t>(ref.view_idx));
  if (!seen) return kInfinity;
  const ImageEdge edge = InputEdge(ref);
  return std::abs(edge.Normal().dot(seen->position - edge.position));
}

std::vector<PointInImage> PosedEdges::Observed(const PointSample& point) const {
  std::vector<PointInImage> seen;
  for (const PointSample::Observation& at : point.observations) {
    const auto i = static_cast<std::size_t>(at.view_idx);
    seen.push_back({&PresentCameraOf(i), PoseOf(i), at.pixel});
  }
  return seen;
}

std::optional<Eigen::Vector2d> PosedEdges::PixelByInputCamera(
    std::size_t view_idx, const Eigen::Vector3d& x) const {
  const auto seen = Project(PresentCameraOf(view_idx), PoseOf(view_idx), x);
  if (!seen) return std::nullopt;
  const auto ideal = IdealFromImage(InputCameraOf(view_idx), *seen);
  if (!ideal) return std::nullopt;
  return (input_views_[view_idx].calibration * ideal->homogeneous()).head<2>();
}

std::optional<double> PosedEdges::ShiftIn(std::size_t view_idx,
                                          const Eigen::Vector3d& x,
                                          const MovedCameras& before) const {
  const View& view = scene_.views[view_idx];
  const auto from =
      Project(before.cameras[static_cast<std::size_t>(view.camera_idx)],
              before.new_cam_from_cam[view_idx] * view.cam_from_world,
              x);
  const auto to = Project(PresentCameraOf(view_idx), PoseOf(view_idx), x);
  if (!from || !to) return std::nullopt;
  return (*to - *from).norm();
}

OccludingContour PosedEdges::Adjusted(const CurvePlace& place,
                                      double sigma_px) const {
  if (place.support.size() < 2) return place.contour;
  std::vector<PlaneMeasurement> measurements;
  for (const EdgeRef& ref : place.support) {
    const auto i = static_cast<std::size_t>(ref.view_idx);
    const auto edge =
        CarryEdge(InputEdge(ref), InputCameraOf(i), PresentCameraOf(i));
    if (edge) measurements.push_back(MeasurePlane(views_[i], *edge));
  }
  return AdjustOccludingContour(place.contour, measurements, sigma_px);
}

Result<std::vector<EdgeMap>> EdgesWithCameras(
    const Scene& scene,
    std::vector<EdgeMap> edge_maps,
    const std::vector<Camera>& cameras) {
  CURVIX_RETURN_IF_ERROR(CheckEdgeMaps(scene, edge_maps));
  if (cameras.size() < scene.cameras.size()) {
    return Status::InvalidArgument(
        "there " + OneOrMore(cameras.size(), "is ", "are ") +
        Plural(cameras.size(), "camera") + " for the " +
        std::to_string(scene.cameras.size()) + " of the scene");
  }
  for (const auto* all : {&scene.cameras, &cameras}) {
    for (const Camera& camera : *all) {
      CURVIX_RETURN_IF_ERROR(Validate(camera));
    }
  }
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    const View& view = scene.views[i];
    const auto k = static_cast<std::size_t>(view.camera_idx);
    auto carried = CarryEdges(edge_maps[i], scene.cameras[k], cameras[k]);
    if (!carried) {
      return Status::InvalidArgument("the camera of " + view.name +
                                     " cannot be inverted at an edge");
    }
    edge_maps[i] = *std::move(carried);
  }
  return edge_maps;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "pipeline/posed_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "geometry/image_edge.h"
#include "geometry/posed_views.h"

namespace curvix {
namespace {

// Edges that ask for hypotheses, in all views: some half of them lead to a
// place, and a view sees some half of the places.
constexpr std::size_t kNumEdgesToAsk = 2500;
constexpr std::size_t kNumEdgesToAskPerView = 50;
constexpr double kGateSigmas = 4;
constexpr double kMaxTangentialPx = 1;
constexpr double kMinCosine = 0.9659258;  // 15 degrees
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
      indices_(IndexViews(views_, edge_maps, options.runtime.num_threads)),
      overlaps_(FindOverlaps(views_, scene.points)),
      depths_(FindDepthRanges(
          views_, scene.points, options.hypotheses.depth_margin)),
      neighbors_(NeighborsInDirection(overlaps_)),
      motions_(views_.size()) {}

void PosedEdges::SetMotions(std::vector<Rigid3> new_cam_from_cam) {
  motions_ = std::move(new_cam_from_cam);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const Rigid3 pose = motions_[i] * scene_.views[i].cam_from_world;
    PosedView& view = views_[i];
    view.rotation = pose.rotation.toRotationMatrix();
    view.translation = pose.translation;
    view.center = -(view.rotation.transpose() * view.translation);
  }
}

std::vector<CurvePlace> PosedEdges::Sketch(double sigma_px,
                                           const StepDone& step_done) const {
  std::size_t num_edges = 0;
  for (const EdgeMap& map : edge_maps_) num_edges += map.edges.size();
  const std::size_t num_asked =
      std::max(kNumEdgesToAsk, kNumEdgesToAskPerView * views_.size());
  Options options = options_;
  options.hypotheses.location_tolerance_px = 2 * sigma_px;
  options.validation.max_distance_px =
      std::max(options.validation.max_distance_px, kGateSigmas * sigma_px);
  const EdgeSketch sketch =
      SketchByViews({views_,
                     edge_maps_,
                     overlaps_,
                     depths_,
                     options,
                     sigma_px,
                     std::max<std::size_t>(1, num_edges / num_asked)},
                    step_done);
  std::vector<CurvePlace> places;
  for (const Edge3d& edge : sketch.edges) {
    if (edge.support.size() < kMinSupportsOfPlace) continue;
    CurvePlace& place = places.emplace_back();
    place.rim.axis = {edge.position, edge.tangent};
    place.support = edge.support;
    place.rim = Adjusted(place, sigma_px);
  }
  return places;
}

std::vector<std::size_t> PosedEdges::ViewsToAsk(const CurvePlace& place) const {
  std::vector<std::size_t> views;
  for (const EdgeRef& ref : place.support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    views.push_back(view_idx);
    for (const ViewNeighbor& neighbor : neighbors_[view_idx]) {
      views.push_back(static_cast<std::size_t>(neighbor.view_idx));
    }
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

std::vector<EdgeRef> PosedEdges::FindEdges(
    const Rim& rim,
    const std::vector<std::size_t>& views,
    const std::vector<double>& gates_px) const {
  std::vector<EdgeRef> found;
  for (const std::size_t i : views) {
    const auto projected =
        ProjectEdge(views_[i], SeenFrom(rim, views_[i].center));
    if (!projected || !views_[i].Contains(projected->position)) continue;
    const Gate gate{gates_px[i], kMaxTangentialPx, kMinCosine};
    const auto nearest = NearestEdge(indices_[i], *projected, gate);
    if (nearest) found.push_back({static_cast<std::int32_t>(i), *nearest});
  }
  return found;
}

std::vector<std::vector<const CurvePlace*>> PosedEdges::PlacesByView(
    const std::vector<CurvePlace>& places) const {
  std::vector<std::vector<const CurvePlace*>> by_view(views_.size());
  for (const CurvePlace& place : places) {
    for (const std::size_t i : ViewsToAsk(place)) by_view[i].push_back(&place);
  }
  return by_view;
}

std::vector<EdgesAround> PosedEdges::LookAround(
    const std::vector<const CurvePlace*>& places,
    std::size_t view_idx,
    double reach_px) const {
  std::vector<EdgesAround> result;
  for (const CurvePlace* place : places) {
    const auto projected = ProjectEdge(
        views_[view_idx], SeenFrom(place->rim, views_[view_idx].center));
    if (!projected || !views_[view_idx].Contains(projected->position)) continue;
    const Eigen::Vector2d& tangent = projected->tangent;
    EdgesAround around;
    around.normal = {-tangent.y(), tangent.x()};
    const auto look = [&](const IndexedEdge& edge) {
      const Eigen::Vector2d offset =
          edge.position.cast<double>() - projected->position;
      const double distance = around.normal.dot(offset);
      const auto is_same = [&](double other) {
        return std::abs(other - distance) < kSameContourPx;
      };
      if (std::abs(edge.tangent.cast<double>().dot(tangent)) >= kMinCosine &&
          std::abs(offset.dot(tangent)) <= kMaxTangentialPx &&
          std::abs(distance) <= reach_px &&
          std::none_of(around.distances_px.begin(),
                       around.distances_px.end(),
                       is_same)) {
        around.distances_px.push_back(distance);
      }
    };
    indices_[view_idx].grid.VisitAround(projected->position, reach_px, look);
    if (!around.distances_px.empty()) result.push_back(std::move(around));
  }
  return result;
}

ImageEdge PosedEdges::EdgeOf(const EdgeRef& ref) const {
  return ToImageEdge(edge_maps_[static_cast<std::size_t>(ref.view_idx)]
                         .edges[static_cast<std::size_t>(ref.edge_idx)]);
}

double PosedEdges::Distance(const Rim& rim, const EdgeRef& ref) const {
  const PosedView& view = views_[static_cast<std::size_t>(ref.view_idx)];
  const ImageEdge edge = EdgeOf(ref);
  const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
  const Eigen::Vector2d pixel =
      view.Pixel(view.InCamera(SeenFrom(rim, view.center).position));
  return std::abs(normal.dot(pixel - edge.position));
}

std::vector<std::vector<double>> PosedEdges::ShiftsByView(
    const std::vector<CurvePlace>& places) const {
  std::vector<std::vector<double>> shifts(views_.size());
  for (const CurvePlace& place : places) {
    const Eigen::Vector3d x = MiddleOf(place.rim);
    for (const EdgeRef& ref : place.support) {
      const auto i = static_cast<std::size_t>(ref.view_idx);
      const PosedView& from = input_views_[i];
      const PosedView& to = views_[i];
      shifts[i].push_back(
          (to.Pixel(to.InCamera(x)) - from.Pixel(from.InCamera(x))).norm());
    }
  }
  return shifts;
}

Rim PosedEdges::Adjusted(const CurvePlace& place, double sigma_px) const {
  if (place.support.size() < 2) return place.rim;
  std::vector<PlaneMeasurement> measurements;
  for (const EdgeRef& ref : place.support) {
    measurements.push_back(MeasurePlane(
        views_[static_cast<std::size_t>(ref.view_idx)], EdgeOf(ref)));
  }
  return AdjustRim(place.rim, measurements, sigma_px);
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/directions.h"
#include "geometry/fit_point.h"
#include "poses/pose_search_estimates.h"

namespace curvix {
namespace {

constexpr int kMaxNumTurns = 6;
constexpr double kMinGainOfTurn = 0.03;
// Sketches expect larger errors until they find so many places.
constexpr std::size_t kMinPlaces = 100;
constexpr double kMaxSketchSigmaPx = 1.2;
constexpr std::size_t kMinDistancesPerView = 12;
constexpr double kReachPx = 6;  // of the search for shifts
// Standard deviations of edges around projections.
constexpr double kFirstSigmaPx = 0.5;
constexpr double kMinSigmaPx = 0.15;
constexpr double kMaxSigmaPx = 1.5;
constexpr double kSigmaPerSpread = 1.5;
constexpr double kGateSigmas = 4;
constexpr double kPlaceSigmaPx = 0.3;
constexpr double kFirstPriorPx = 10;
constexpr double kMinPriorPx = 0.02;
// If cameras are free: a shift of the principal point and a rotation of all
// views compensate each other.
constexpr double kPriorOfFreeLensesPx = 50;

// The standard deviation of a pixel of a point, in x and in y.
double PointSigma(const Scene& scene) {
  std::vector<double> residuals;
  for (const PointSample& point : UsablePoints(scene)) {
    for (const PointSample::Observation& seen : point.observations) {
      const View& view = scene.views[static_cast<std::size_t>(seen.view_idx)];
      const auto pixel =
          Project(CameraOf(scene, view), view.cam_from_world, point.position);
      residuals.push_back(std::abs(pixel->x() - seen.pixel.x()));
      residuals.push_back(std::abs(pixel->y() - seen.pixel.y()));
    }
  }
  return std::max(kMinSigmaPx,
                  kSigmasPerMedian * MedianOr(1, std::move(residuals)));
}

}  // namespace

PoseSearch::PoseSearch(const Scene& scene,
                       const std::vector<EdgeMap>& edge_maps,
                       const Options& options,
                       StepDone step_done)
    : scene_(scene),
      edge_sigma_px_(options.hypotheses.EdgeSigmaPx()),
      step_done_([this, step = std::move(step_done)](auto done, auto all) {
        is_stopped_ = is_stopped_ || !step(done, all);
        return !is_stopped_;
      }),
      point_sigma_px_(PointSigma(scene)),
      edges_(scene, edge_maps, options),
      sigmas_px_(scene.views.size(), kFirstSigmaPx),
      prior_px_(kFirstPriorPx) {}

PoseSearch::State PoseSearch::state() const {
  return {edges_.moved(), sigmas_px_, prior_px_, free_lenses_, min_supports_};
}

void PoseSearch::SetState(const State& state) {
  edges_.Move(state.moved);
  sigmas_px_ = state.sigmas_px;
  prior_px_ = state.prior_px;
  free_lenses_ = state.free_lenses;
  min_supports_ = state.min_supports;
}

std::vector<CurvePlace> PoseSearch::Sketch() {
  double sigma_px = edge_sigma_px_;
  PlaceSketch sketch = edges_.Sketch(sigma_px, step_done_);
  while (sketch.places.size() < kMinPlaces &&
         2 * sigma_px <= kMaxSketchSigmaPx && !is_stopped_) {
    sigma_px *= 2;
    sketch = edges_.Sketch(sigma_px, step_done_);
  }
  min_supports_ = sketch.min_supports;
  return std::move(sketch.places);
}

bool PoseSearch::ShiftViews(const std::vector<CurvePlace>& places) {
  const std::size_t num_views = scene_.views.size();
  MovedCameras moved = edges_.moved();
  std::vector<Eigen::Vector2d> shifts(num_views, Eigen::Vector2d::Zero());
  const auto by_view = edges_.PlacesByView(places);
  ParallelFor(num_views, edges_.num_threads(), [&](std::size_t i) {
    shifts[i] = FindShift(edges_.LookAround(by_view[i], i, kReachPx), kReachPx);
    const Eigen::Vector2d& shift = shifts[i];
    if (shift.isZero(0)) return;
    const Eigen::Matrix3d& calibration = edges_.views()[i].calibration;
    const Eigen::Vector3d turn(
        -shift.y() / calibration(1, 1), shift.x() / calibration(0, 0), 0);
    const Rigid3 increment = {RotationBy(turn), {0, 0, 0}};
    moved.new_cam_from_cam[i] = increment * moved.new_cam_from_cam[i];
  });
  edges_.Move(moved);
  sigmas_px_.assign(num_views, kFirstSigmaPx);
  return std::ranges::any_of(
      shifts, [](const auto& shift) { return !shift.isZero(0); });
}

void PoseSearch::FindEdges(std::vector<CurvePlace>* places) const {
  std::vector<double> gates_px;
  for (const double sigma : sigmas_px_) gates_px.push_back(kGateSigmas * sigma);
  ParallelFor(places->size(), edges_.num_threads(), [&](std::size_t i) {
    CurvePlace& place = (*places)[i];
    place.support =
        edges_.FindEdges(place.contour, edges_.QueryViews(place), gates_px);
  });
  std::erase_if(*places, [&](const CurvePlace& place) {
    return place.support.size() < min_supports_;
  });
}

std::vector<std::vector<double>> PoseSearch::DistancesByView(
    const std::vector<CurvePlace>& places) const {
  std::vector<std::vector<double>> distances(scene_.views.size());
  for (const CurvePlace& place : places) {
    for (const EdgeRef& ref : place.support) {
      distances[static_cast<std::size_t>(ref.view_idx)].push_back(
          edges_.Distance(place.contour, ref));
    }
  }
  return distances;
}

// Where few edges are found, the search becomes wider.
void PoseSearch::UpdateSigmas(const std::vector<CurvePlace>& places) {
  const std::vector<std::vector<double>> distances = DistancesByView(places);
  ParallelFor(sigmas_px_.size(), edges_.num_threads(), [&](std::size_t i) {
    const double sigma_px =
        distances[i].size() < kMinDistancesPerView
            ? 2 * sigmas_px_[i]
            : kSigmaPerSpread *
                  FitSpread(distances[i], kGateSigmas * sigmas_px_[i]);
    sigmas_px_[i] = std::clamp(sigma_px, kMinSigmaPx, kMaxSigmaPx);
  });
}

void PoseSearch::AdjustInTurns(PoseObservationSet* observations) {
  double error_px = kMaxSigmaPx;
  for (int turn = 0; turn < kMaxNumTurns && !is_stopped_; ++turn) {
    FindEdges(&observations->places);
    UpdateSigmas(observations->places);
    Adjust(observations);
    if (turn == 0) continue;
    const double previous = std::exchange(
        error_px,
        MedianOr(0, Concatenate(DistancesByView(observations->places))));
    if (turn > 1 && error_px > previous * (1 - kMinGainOfTurn)) break;
  }
}

AdjustedPoses PoseSearch::Solve(const PoseObservationSet& observations,
                                double prior_px,
                                const std::vector<bool>& free_lenses) {
  std::vector<PoseSample> samples;
  for (const CurvePlace& place : observations.places) {
    PoseSample& sample = samples.emplace_back();
    sample.contour = place.contour;
    for (const EdgeRef& ref : place.support) {
      sample.observations.push_back({ref.view_idx, edges_.DistortedEdge(ref)});
    }
  }
  return AdjustPoses({scene_,
                      samples,
                      observations.points,
                      sigmas_px_,
                      point_sigma_px_,
                      prior_px,
                      free_lenses},
                     edges_.moved(),
                     edges_.num_threads(),
                     [this] { return step_done_(0, 0); });
}

// Points constrain poses better than a narrow prior, which would keep a common
// drift.
double PoseSearch::PriorFor(const PoseObservationSet& observations) const {
  if (!free_lenses_.empty()) return kPriorOfFreeLensesPx;
  return observations.points.empty() ? prior_px_ : kFirstPriorPx;
}

AdjustedPoses PoseSearch::AdjustCameras(
    const PoseObservationSet& observations) {
  AdjustedPoses adjusted =
      Solve(observations, PriorFor(observations), free_lenses_);
  edges_.Move(adjusted.moved);
  return adjusted;
}

void PoseSearch::Adjust(PoseObservationSet* observations) {
  const AdjustedPoses adjusted = AdjustCameras(*observations);
  for (std::size_t i = 0; i < observations->points.size(); ++i) {
    observations->points[i].position = adjusted.points[i];
  }
  ParallelFor(
      observations->places.size(), edges_.num_threads(), [&](std::size_t i) {
        CurvePlace& place = observations->places[i];
        place.contour = adjusted.contours[i];
        place.contour = edges_.Adjusted(place, kPlaceSigmaPx);
      });
  // Only used without free cameras and points, see PriorFor().
  if (!free_lenses_.empty() || !observations->points.empty()) return;
  prior_px_ = std::clamp(
      MedianShift(*observations, edges_.Unmoved()), kMinPriorPx, kFirstPriorPx);
}

void PoseSearch::Fit(PoseObservationSet* observations) const {
  ParallelFor(
      observations->places.size(), edges_.num_threads(), [&](std::size_t i) {
        CurvePlace& place = observations->places[i];
        place.contour = edges_.Adjusted(place, kPlaceSigmaPx);
      });
  ParallelFor(
      observations->points.size(), edges_.num_threads(), [&](std::size_t i) {
        PointSample& point = observations->points[i];
        point.position = FitPoint(point.position, edges_.Observed(point));
      });
}

std::vector<double> PoseSearch::LossesOf(
    const PoseObservationSet& observations) {
  PoseObservationSet fitted = observations;
  Fit(&fitted);
  return Solve(fitted, kFirstPriorPx, {}).costs;
}

std::vector<std::optional<double>> PoseSearch::Shifts(
    const PoseObservationSet& observations, const MovedCameras& before) const {
  std::vector<std::vector<double>> shifts(scene_.views.size());
  VisitSeen(observations, [&](std::size_t i, const Eigen::Vector3d& x) {
    if (const auto shift = edges_.ShiftIn(i, x, before)) {
      shifts[i].push_back(*shift);
    }
  });
  std::vector<std::optional<double>> medians(shifts.size());
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (shifts[i].size() >= kMinDistancesPerView) {
      medians[i] = Median(std::move(shifts[i]));
    }
  }
  return medians;
}

double PoseSearch::MedianShift(const PoseObservationSet& observations,
                               const MovedCameras& before) const {
  std::vector<double> medians;
  for (const std::optional<double>& shift : Shifts(observations, before)) {
    if (shift) medians.push_back(*shift);
  }
  return MedianOr(0, std::move(medians));
}

void PoseSearch::RestoreGauge(PoseObservationSet* observations) {
  std::vector<SeenPlace> seen;
  std::vector<bool> is_observed(scene_.views.size());
  VisitSeen(*observations, [&](std::size_t i, const Eigen::Vector3d& x) {
    is_observed[i] = true;
    if (const auto pixel = edges_.PixelByInputCamera(i, x)) {
      seen.push_back({i, x, *pixel});
    }
  });
  const Similarity3 old_from_new = FixGauge(edges_.input_views(), seen);
  MovedCameras moved = edges_.moved();
  for (std::size_t i = 0; i < scene_.views.size(); ++i) {
    if (!is_observed[i]) continue;  // has not moved
    moved.new_cam_from_cam[i] = MovePose(old_from_new, edges_.PoseOf(i)) *
                                scene_.views[i].cam_from_world.Inverse();
  }
  edges_.Move(moved);
  for (CurvePlace& place : observations->places) {
    OccludingContour& contour = place.contour;
    contour.axis.position = old_from_new * contour.axis.position;
    contour.axis.tangent = old_from_new.rotation * contour.axis.tangent;
    contour.outward = old_from_new.rotation * contour.outward;
    contour.radius *= old_from_new.scale;
  }
  for (PointSample& point : observations->points) {
    point.position = old_from_new * point.position;
  }
}

}  // namespace curvix

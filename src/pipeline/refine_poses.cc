// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Sketch, shift, and in turns find edges and adjust;
// see docs/stages/poses.md.
#include <curvix/option_table.h>
#include <curvix/refine_poses.h>

#include <algorithm>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"
#include "pipeline/check_input.h"
#include "pipeline/judge_poses.h"
#include "pipeline/posed_edges.h"
#include "pipeline/run_recorder.h"
#include "poses/adjust_poses.h"
#include "poses/find_shift.h"
#include "poses/hold_world.h"
#include "poses/residual_spread.h"

namespace curvix {
namespace {

constexpr int kNumSketches = 2;  // the second with poses that are nearly right
constexpr double kSmallShiftPx = 0.1;  // asks for no second sketch
// Edges of exact poses are half as far off; poses a quarter of a pixel off make
// it twice as much.
constexpr double kGoodEnoughPx = 0.06;
constexpr int kNumRounds = 6;
constexpr double kMinGainOfRound = 0.01;
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

class Refiner {
 public:
  Refiner(const Scene& scene,
          const std::vector<EdgeMap>& edge_maps,
          const Options& options,
          RunRecorder* run)
      : scene_(scene),
        options_(options),
        run_(*run),
        edges_(scene, edge_maps, options) {}

  CurvePoses Run() {
    for (int i = 0; i < kNumSketches && !run_.cancelled(); ++i) {
      places_ = Sketch();
      std::vector<CurvePlace> check_places = TakeCheckPlaces(&places_);
      const bool has_shifted = ShiftViews();
      if (i == 0) check_places_ = std::move(check_places);
      if (i == 0 && !has_shifted) {
        CurvePoses as_they_are = Judge();
        if (IsGoodEnough(as_they_are)) {
          as_they_are.reason = "the edges are where the poses put them";
          return as_they_are;
        }
      }
      Adjust();
      if (prior_px_ < kSmallShiftPx) break;
    }
    HoldTheWorld();
    return Judge();
  }

 private:
  CurvePoses Judge() {
    CurvePoses result = JudgeMotions(
        check_places_, scene_, options_.runtime.num_threads, &edges_);
    result.num_samples = places_.size() + check_places_.size();
    return result;
  }

  // Brings the world back to where the input poses show it.
  void HoldTheWorld() {
    std::vector<SeenPlace> seen;
    for (const CurvePlace& place : places_) {
      for (const EdgeRef& ref : place.support) {
        const auto i = static_cast<std::size_t>(ref.view_idx);
        const PosedView& view = edges_.views()[i];
        const Eigen::Vector3d x = MiddleOf(place.rim);
        seen.push_back({i, x, view.Pixel(view.InCamera(x))});
      }
    }
    const Rigid3 new_from_old = HoldWorld(edges_.input_views(), seen).Inverse();
    std::vector<Rigid3> motions = edges_.motions();
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const Rigid3& pose = scene_.views[i].cam_from_world;
      motions[i] = motions[i] * pose * new_from_old * pose.Inverse();
    }
    edges_.SetMotions(std::move(motions));
  }

  // Saves the time of looking for what cannot be found.
  static bool IsGoodEnough(const CurvePoses& as_they_are) {
    return as_they_are.num_check_observations > 0 &&
           as_they_are.before.median_px < kGoodEnoughPx;
  }

  std::vector<CurvePlace> Sketch() {
    double sigma_px = options_.hypotheses.EdgeSigmaPx();
    std::vector<CurvePlace> places = edges_.Sketch(sigma_px, run_.Steps());
    while (places.size() < kMinPlaces && 2 * sigma_px <= kMaxSketchSigmaPx &&
           !run_.cancelled()) {
      sigma_px *= 2;
      places = edges_.Sketch(sigma_px, run_.Steps());
    }
    return places;
  }

  // Turns each camera such that its picture shifts to where most places agree.
  // Whether any did.
  bool ShiftViews() {
    const std::size_t num_views = edges_.views().size();
    std::vector<Rigid3> motions = edges_.motions();
    std::vector<Eigen::Vector2d> shifts(num_views, Eigen::Vector2d::Zero());
    const auto places = edges_.PlacesByView(places_);
    ParallelFor(num_views, options_.runtime.num_threads, [&](std::size_t i) {
      shifts[i] =
          FindShift(edges_.LookAround(places[i], i, kReachPx), kReachPx);
      const Eigen::Vector2d& shift = shifts[i];
      if (shift.isZero(0)) return;
      const Eigen::Matrix3d& calibration = edges_.views()[i].calibration;
      const Eigen::Vector3d turn(
          -shift.y() / calibration(1, 1), shift.x() / calibration(0, 0), 0);
      Rigid3 motion;
      motion.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
      motions[i] = motion * motions[i];
    });
    edges_.SetMotions(std::move(motions));
    sigmas_px_.assign(num_views, kFirstSigmaPx);
    return std::any_of(shifts.begin(), shifts.end(), [](const auto& shift) {
      return !shift.isZero(0);
    });
  }

  // Finds edges and adjusts poses in turns, until edges come no nearer.
  void Adjust() {
    double error_px = kMaxSigmaPx;
    for (int round = 0; round < kNumRounds && !run_.cancelled(); ++round) {
      FindEdges();
      UpdateSigmas();
      AdjustOnce();
      const double previous = std::exchange(error_px, MedianOr(0, Distances()));
      if (round > 1 && error_px > previous * (1 - kMinGainOfRound)) break;
    }
  }

  void FindEdges() {
    std::vector<double> gates_px;
    for (const double sigma : sigmas_px_) {
      gates_px.push_back(kGateSigmas * sigma);
    }
    ParallelFor(
        places_.size(), options_.runtime.num_threads, [&](std::size_t i) {
          CurvePlace& place = places_[i];
          place.support =
              edges_.FindEdges(place.rim, edges_.ViewsToAsk(place), gates_px);
        });
    std::erase_if(places_, [](const CurvePlace& place) {
      return place.support.size() < kMinSupportsOfPlace;
    });
  }

  std::vector<std::vector<double>> DistancesByView() const {
    std::vector<std::vector<double>> distances(edges_.views().size());
    for (const CurvePlace& place : places_) {
      for (const EdgeRef& ref : place.support) {
        distances[static_cast<std::size_t>(ref.view_idx)].push_back(
            edges_.Distance(place.rim, ref));
      }
    }
    return distances;
  }

  std::vector<double> Distances() const {
    return Concatenate(DistancesByView());
  }

  // Where few edges are found, the search becomes wider.
  void UpdateSigmas() {
    const std::vector<std::vector<double>> distances = DistancesByView();
    ParallelFor(
        sigmas_px_.size(), options_.runtime.num_threads, [&](std::size_t i) {
          const double sigma_px =
              distances[i].size() < kMinDistancesPerView
                  ? 2 * sigmas_px_[i]
                  : kSigmaPerSpread *
                        FitSpread(distances[i], kGateSigmas * sigmas_px_[i]);
          sigmas_px_[i] = std::clamp(sigma_px, kMinSigmaPx, kMaxSigmaPx);
        });
  }

  void AdjustOnce() {
    std::vector<PoseSample> samples;
    for (const CurvePlace& place : places_) {
      PoseSample& sample = samples.emplace_back();
      sample.rim = place.rim;
      for (const EdgeRef& ref : place.support) {
        sample.observations.push_back({ref.view_idx, edges_.EdgeOf(ref)});
      }
    }
    AdjustedPoses adjusted =
        AdjustPoses({edges_.input_views(), sigmas_px_, samples, prior_px_},
                    edges_.motions(),
                    options_.runtime.num_threads,
                    [this] { return run_.Steps()(0, 0); });
    edges_.SetMotions(std::move(adjusted.new_cam_from_cam));
    ParallelFor(
        places_.size(), options_.runtime.num_threads, [&](std::size_t i) {
          places_[i].rim = adjusted.rims[i];
          places_[i].rim = edges_.Adjusted(places_[i], kPlaceSigmaPx);
        });
    prior_px_ = std::max(kMinPriorPx, MedianShift());
  }

  // How far pictures have shifted so far: what the typical pose is off by.
  double MedianShift() const {
    std::vector<double> medians;
    for (std::vector<double>& shifts : edges_.ShiftsByView(places_)) {
      if (shifts.size() >= kMinDistancesPerView) {
        medians.push_back(Median(std::move(shifts)));
      }
    }
    return MedianOr(0, std::move(medians));
  }

  const Scene& scene_;
  const Options& options_;
  RunRecorder& run_;
  PosedEdges edges_;
  std::vector<CurvePlace> places_;
  std::vector<CurvePlace> check_places_;
  std::vector<double> sigmas_px_;
  double prior_px_ = kFirstPriorPx;
};

}  // namespace

Result<CurvePoses> RefinePosesWithCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress) {
  if (Status status = CheckScene(scene); !status.ok()) return status;
  if (Status status = CheckEdgeMaps(scene, edge_maps); !status.ok()) {
    return status;
  }
  if (Status status = Validate(options); !status.ok()) return status;
  RunRecorder run(progress);
  run.Begin("refine_poses_with_curves");
  CurvePoses result = Refiner(scene, edge_maps, options, &run).Run();
  if (run.cancelled()) return run.CancelledStatus();
  return result;
}

}  // namespace curvix

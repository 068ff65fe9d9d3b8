// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/classify_curves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/parallel.h"
#include "base/point_tree.h"
#include "curve_kinds/blurred_images.h"
#include "curve_kinds/judge_kind.h"
#include "curve_kinds/strips.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// Places along a curve, in pixels, and how many to either side are taken
// together.
constexpr double kStepPx = 8;
constexpr std::size_t kReach = 5;

// Other curves and COLMAP's points as near as this are looked at, too.
constexpr double kNearbyCurvePx = 40;
constexpr double kNearbyPointPx = 60;

// A vector across `tangent` that is as `normal` as can be.
Vector3d Across(const Vector3d& tangent, const Vector3d& normal) {
  const Vector3d across = normal - normal.dot(tangent) * tangent;
  if (across.norm() > 0.1) return across.normalized();
  int axis = 0;
  tangent.cwiseAbs().minCoeff(&axis);
  return tangent.cross(Vector3d::Unit(axis)).normalized();
}

// Of `size` places along a curve those within kReach of one.
std::vector<std::size_t> PlacesAround(std::size_t at,
                                      std::size_t size,
                                      bool is_closed) {
  std::vector<std::size_t> around;
  if (is_closed && size > 2 * kReach + 1) {
    for (std::size_t k = 0; k <= 2 * kReach; ++k) {
      around.push_back((at + size - kReach + k) % size);
    }
    return around;
  }
  const std::size_t first = at < kReach || is_closed ? 0 : at - kReach;
  const std::size_t last =
      is_closed ? size - 1 : std::min(size - 1, at + kReach);
  for (std::size_t i = first; i <= last; ++i) around.push_back(i);
  return around;
}

// Where strips are compared, on all curves.
struct Places {
  // Per curve, of images of reduced size; world units.
  std::vector<double> pixels;
  std::vector<std::vector<std::size_t>> samples;  // per curve
  std::vector<std::size_t> first;  // per curve, the index of its first place
  // Of all curves, one after the other.
  std::vector<std::size_t> curves;
  std::vector<StripPlace> all;
  std::vector<StripViews> strip_views;
};

// The views of a place.
class ViewSet {
 public:
  ViewSet(const std::vector<int>& views, std::size_t num_views)
      : size_(views.size()), holds_(num_views) {
    for (const int view : views) holds_[static_cast<std::size_t>(view)] = 1;
  }

  // Whether a point nearby is on what these views see: of the views of either,
  // at least a third of the fewer see both. Other points may be behind a
  // surface.
  bool Sees(const std::vector<int>& of_point) const {
    std::size_t num_common = 0;
    for (const int view : of_point) {
      num_common += holds_[static_cast<std::size_t>(view)];
    }
    return 3 * num_common >= std::min(size_, of_point.size());
  }

 private:
  std::size_t size_;
  std::vector<std::uint8_t> holds_;  // per view of the scene: 1 or 0
};

// The points within `radius` that the `views` of a place see. `views_of(i)` are
// those of point i.
template <typename F>
std::vector<std::size_t> SeenNear(const PointTree& points,
                                  const F& views_of,
                                  const Vector3d& position,
                                  const ViewSet& views,
                                  double radius) {
  std::vector<std::size_t> seen = points.Within(position, radius);
  std::erase_if(seen, [&](std::size_t i) { return !views.Sees(views_of(i)); });
  return seen;
}

// The mean direction to the views that support a sample; zero without any.
Vector3d TowardsViews(const CurveSample& sample,
                      const std::vector<PosedView>& views) {
  Vector3d sum = Vector3d::Zero();
  for (const EdgeRef& ref : sample.support) {
    const PosedView& view = views[static_cast<std::size_t>(ref.view_idx)];
    sum += (view.center - sample.position).normalized();
  }
  return sum.normalized();
}

// The places of a curve, at some samples of it. Normals depend on what is seen,
// not on the axes of the world.
std::vector<StripPlace> PlacesOn(const Curve& curve,
                                 const std::vector<PosedView>& views,
                                 const std::vector<std::size_t>& samples) {
  std::vector<StripPlace> places;
  Vector3d tangent = Vector3d::Zero();
  Vector3d normal = TowardsViews(curve.samples[samples.front()], views);
  for (const std::size_t i : samples) {
    const CurveSample& sample = curve.samples[i];
    // A frame that turns no more than the curve does.
    if (!places.empty()) {
      normal = ShortestRotation(tangent, sample.tangent) * normal;
    }
    normal = Across(sample.tangent, normal);
    tangent = sample.tangent;
    places.push_back({sample.position, tangent, normal, {}});
    for (const EdgeRef& ref : sample.support) {
      places.back().views.push_back(ref.view_idx);
    }
  }
  return places;
}

// `scale`: that of the images.
Places ChoosePlaces(const std::vector<Curve>& curves,
                    const std::vector<PosedView>& views,
                    double scale) {
  Places places;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    places.pixels.push_back(PixelSize(curves[i], views) / scale);
    places.samples.emplace_back();
    places.first.push_back(places.all.size());
    if (!(places.pixels.back() > 0)) continue;
    places.samples.back() =
        SamplesAlong(curves[i], kStepPx * places.pixels.back());
    for (StripPlace& place :
         PlacesOn(curves[i], views, places.samples.back())) {
      places.curves.push_back(i);
      places.all.push_back(std::move(place));
    }
  }
  return places;
}

// Chooses the views of places on curves to classify, and reads the tiles of the
// `images` that their strips need.
void ReadTilesOfPlaces(const Scene& scene,
                       const std::vector<PosedView>& views,
                       const std::vector<Curve>& curves,
                       int num_threads,
                       Places* places,
                       std::vector<BlurredImage>* images) {
  places->strip_views.resize(places->all.size());
  ParallelFor(curves.size(), num_threads, [&](std::size_t i) {
    if (MainKind(curves[i]) == CurveKind::kOccludingContour) return;
    const std::size_t end = places->first[i] + places->samples[i].size();
    for (std::size_t k = places->first[i]; k < end; ++k) {
      places->strip_views[k] =
          ChooseStripViews(places->all[k], scene, views, *images);
    }
  });
  for (StripViews& chosen : places->strip_views) {
    for (std::size_t i = 0; i < chosen.views.size(); ++i) {
      (*images)[static_cast<std::size_t>(chosen.views[i])].AskFor(
          chosen.boxes[i]);
    }
    chosen.boxes = {};
  }
  ReadTiles(scene, num_threads, images);
}

class Classifier {
 public:
  Classifier(const Scene& scene,
             const std::vector<PosedView>& views,
             const std::vector<BlurredImage>& images,
             const Places& places)
      : scene_(scene),
        views_(views),
        images_(images),
        places_(places),
        places_tree_(places.all, &StripPlace::position),
        points_tree_(scene.points, &ScenePoint::position) {}

  void Classify(std::size_t curve_idx, Curve* curve) const {
    const std::vector<std::size_t>& chosen = places_.samples[curve_idx];
    if (chosen.empty()) return;
    const std::vector<Surroundings> surroundings = SurroundingsOf(curve_idx);
    std::vector<DepthEvidence> evidence(chosen.size());
    LookAt(0, DirectionSet().set(), curve_idx, surroundings, &evidence);
    const auto sum_at = [&](std::size_t at) {
      return SumOver(PlacesAround(at, evidence.size(), curve->closed),
                     evidence);
    };
    // Steps look like markings; only there are surfaces behind looked for.
    DirectionSet may_be_steps;
    for (std::size_t at = 0; at < evidence.size(); ++at) {
      const DepthEvidence sum = sum_at(at);
      if (JudgeKind(sum).kind != CurveKind::kMarking) continue;
      may_be_steps |= DirectionsOfMarkings(sum.front());
    }
    for (std::size_t depth = 1; depth < kNumDepths; ++depth) {
      LookAt(depth, may_be_steps, curve_idx, surroundings, &evidence);
    }
    const auto judge = [&](std::size_t at) { return JudgeKind(sum_at(at)); };
    std::size_t nearest = 0;
    KindProbability kind = judge(nearest);
    for (std::size_t i = 0; i < curve->samples.size(); ++i) {
      while (nearest + 1 < chosen.size() &&
             2 * i > chosen[nearest] + chosen[nearest + 1]) {
        kind = judge(++nearest);
      }
      curve->samples[i].kind = kind.kind;
      curve->samples[i].kind_probability = static_cast<float>(kind.probability);
    }
  }

 private:
  // What is near a place.
  struct Surroundings {
    CurveDistances other_curves = {};
    std::vector<Vector3d> points;  // on other curves, and COLMAP's
  };

  // Of the places on a curve.
  std::vector<Surroundings> SurroundingsOf(std::size_t curve_idx) const {
    const auto views_of_point = [&](std::size_t k) -> const std::vector<int>& {
      return scene_.points[k].view_idxs;
    };
    const double pixel = places_.pixels[curve_idx];
    std::vector<Surroundings> surroundings;
    for (std::size_t k = 0; k < places_.samples[curve_idx].size(); ++k) {
      const StripPlace& place = places_.all[places_.first[curve_idx] + k];
      const ViewSet views(place.views, views_.size());
      Surroundings around;
      around.points = CurvesNearby(curve_idx, place.position, views);
      around.other_curves = DistancesByDirection(place, pixel, around.points);
      for (std::size_t i : SeenNear(points_tree_,
                                    views_of_point,
                                    place.position,
                                    views,
                                    kNearbyPointPx * pixel)) {
        around.points.push_back(scene_.points[i].position);
      }
      surroundings.push_back(std::move(around));
    }
    return surroundings;
  }

  // Looks for surfaces at one of kDepthsPx in these directions.
  void LookAt(std::size_t depth_idx,
              const DirectionSet& directions,
              std::size_t curve_idx,
              const std::vector<Surroundings>& surroundings,
              std::vector<DepthEvidence>* evidence) const {
    if (directions.none()) return;
    for (std::size_t k = 0; k < surroundings.size(); ++k) {
      const std::size_t at = places_.first[curve_idx] + k;
      const StripPlace& place = places_.all[at];
      const double depth = kDepthsPx[depth_idx] * places_.strip_views[at].step;
      SurfaceEvidence& at_depth = (*evidence)[k][depth_idx];
      at_depth = CompareStrips(place,
                               places_.strip_views[at],
                               surroundings[k].other_curves,
                               directions,
                               depth,
                               scene_,
                               views_,
                               images_);
      AddNearbyPoints(place,
                      places_.pixels[curve_idx],
                      views_,
                      surroundings[k].points,
                      depth,
                      &at_depth);
    }
  }

  // Places on other curves that the views of a place on this one see.
  std::vector<Vector3d> CurvesNearby(std::size_t curve_idx,
                                     const Vector3d& position,
                                     const ViewSet& views) const {
    const auto views_of = [&](std::size_t i) -> const std::vector<int>& {
      return places_.all[i].views;
    };
    const double radius = kNearbyCurvePx * places_.pixels[curve_idx];
    std::vector<Vector3d> nearby;
    for (std::size_t i :
         SeenNear(places_tree_, views_of, position, views, radius)) {
      if (places_.curves[i] != curve_idx) {
        nearby.push_back(places_.all[i].position);
      }
    }
    return nearby;
  }

  const Scene& scene_;
  const std::vector<PosedView>& views_;
  const std::vector<BlurredImage>& images_;
  const Places& places_;
  PointTree places_tree_;
  PointTree points_tree_;
};

}  // namespace

void ClassifyCurves(const Scene& scene,
                    const std::vector<PosedView>& views,
                    int num_threads,
                    std::vector<Curve>* curves,
                    const StepDone& step_done) {
  const std::size_t num_curves = curves->size();
  const auto keep_going = [&](std::size_t done) {
    return !step_done ||
           step_done(static_cast<int>(done), static_cast<int>(num_curves));
  };
  if (!keep_going(0) || curves->empty()) return;
  std::vector<BlurredImage> images = PlanBlurredImages(scene, num_threads);
  if (images.empty()) return;
  Places places = ChoosePlaces(*curves, views, images.front().scale());
  ReadTilesOfPlaces(scene, views, *curves, num_threads, &places, &images);
  const Classifier classifier(scene, views, images, places);
  const auto classify = [&](std::size_t i) {
    Curve& curve = (*curves)[i];
    if (MainKind(curve) != CurveKind::kOccludingContour) {
      classifier.Classify(i, &curve);
    }
    return true;
  };
  ParallelForWhile(num_curves, num_threads, classify, keep_going);
}

}  // namespace curvix

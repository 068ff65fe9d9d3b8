// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/synthetic_truth.h"

#include "synthetic/face_pattern.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace curvix {
namespace {

using Eigen::Vector3d;

// Whether a face's point x is where a ray from outside meets the surface.
bool IsOnSurface(const Solid& solid,
                 std::size_t primitive_idx,
                 int face_idx,
                 const Vector3d& x) {
  const SolidPrimitive& primitive = solid.primitives()[primitive_idx];
  const Vector3d own = OwnFromWorld(primitive, x);
  const double clear = (primitive.is_added ? 1e-5 : -1e-5) * solid.detail();
  const Vector3d out = clear * (primitive.world_from_own.rotation *
                                OwnNormal(primitive, face_idx, own));
  if (solid.Contains(x + out)) return false;
  const auto hit = solid.Trace({x + out, -out});
  return hit && hit->primitive_idx == primitive_idx &&
         hit->face_idx == face_idx && std::abs(hit->t - 1) < 1e-3;
}

// Where a body of the solid turns away from the sun.
void AppendTerminators(const SolidPrimitive& primitive,
                       std::vector<TrueCurve>& casters) {
  const Rigid3& pose = primitive.world_from_own;
  const Vector3d& size = primitive.size;
  const Vector3d sun = pose.rotation.conjugate() * Surfaces::SunDirection();
  if (!primitive.is_added) return;
  if (primitive.shape == PrimitiveShape::kSphere) {
    casters.push_back(Circle(pose.translation,
                             Surfaces::SunDirection(),
                             size.x(),
                             CurveKind::kOccludingContour));
  }
  if (primitive.shape != PrimitiveShape::kFrustum) return;
  // The normal (cos a, sin a, -slope) is at right angles to the sun.
  const double slope = (size.y() - size.x()) / size.z();
  const double share = slope * sun.z() / sun.head<2>().norm();
  if (!(std::abs(share) < 1)) return;
  for (const double side : {-1, 1}) {
    const double angle = std::atan2(sun.y(), sun.x()) + side * std::acos(share);
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    casters.push_back(
        Segment(pose * (size.x() * out),
                pose * (size.y() * out + size.z() * Vector3d::UnitZ()),
                CurveKind::kOccludingContour));
  }
}

// The shadow of one edge.
class EdgeShadow {
 public:
  EdgeShadow(const Solid& solid,
             const Surfaces& surfaces,
             const TrueCurve& caster)
      : solid_(solid), surfaces_(surfaces), caster_(caster) {}

  // The parts of `caster` that cast an edge on one face each, as samples.
  std::vector<std::vector<TrueSample>> Sample(double step) const {
    std::vector<int> faces;  // that anything is cast on
    const int num_steps =
        std::max(50, static_cast<int>(caster_.length / solid_.detail() * 200));
    for (int i = 0; i <= num_steps; ++i) {
      const int face = EdgeAt(caster_.length * i / num_steps);
      if (face >= 0) faces.push_back(face);
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::vector<std::vector<TrueSample>> shadows;
    for (const int face : faces) {
      const auto on_face = [&](double s) { return EdgeAt(s) == face; };
      for (const auto& [begin, end] : IntervalsWhere(
               caster_.length, caster_.length / num_steps, on_face)) {
        std::vector<TrueSample> samples = Sample(begin, end, step);
        if (samples.size() > 1) shadows.push_back(std::move(samples));
      }
    }
    return shadows;
  }

 private:
  struct Place {
    Vector3d position;
    Vector3d normal;
    int face_key = -1;  // of the face that it lies on
  };

  // Where the sun's ray that grazes the caster ends.
  std::optional<Place> At(double s) const {
    const Vector3d away = -Surfaces::SunDirection();
    const double clear = 1e-6 * solid_.detail();
    const Ray ray{caster_.Position(s) + clear * away, away};
    if (solid_.Contains(ray.origin)) return std::nullopt;
    const std::optional<Hit> hit = solid_.Trace(ray);
    if (!hit) return std::nullopt;
    return Place{ray.origin + hit->t * away,
                 hit->normal,
                 static_cast<int>(8 * hit->primitive_idx) + hit->face_idx};
  }

  // The key of the face where the shadow ends across; -1: it does not.
  int EdgeAt(double s) const {
    const auto place = At(s);
    if (!place) return -1;
    const Vector3d tangent = Tangent(s);
    if (tangent.isZero()) return -1;
    const Vector3d aside =
        3e-4 * solid_.detail() * place->normal.cross(tangent).normalized();
    const bool left = surfaces_.IsSunny(place->position + aside, place->normal);
    const bool right =
        surfaces_.IsSunny(place->position - aside, place->normal);
    return left == right ? -1 : place->face_key;
  }

  Vector3d Tangent(double s) const {
    const double h = 1e-5 * caster_.length;
    const double before = caster_.is_closed ? s - h : std::max(0.0, s - h);
    const double after =
        caster_.is_closed ? s + h : std::min(caster_.length, s + h);
    const auto a = At(before);
    const auto b = At(after);
    if (!a || !b || a->face_key != b->face_key) return Vector3d::Zero();
    return (b->position - a->position).normalized();
  }

  std::vector<TrueSample> Sample(double begin, double end, double step) const {
    constexpr int kNumPieces = 400;
    std::vector<double> lengths = {0};  // of the shadow up to the i-th place
    std::vector<double> places;
    std::optional<Vector3d> previous;
    for (int i = 0; i <= kNumPieces; ++i) {
      const double s = begin + (end - begin) * i / kNumPieces;
      const auto place = At(s);
      if (!place) continue;
      if (previous) {
        lengths.push_back(lengths.back() +
                          (place->position - *previous).norm());
      }
      places.push_back(s);
      previous = place->position;
    }
    std::vector<TrueSample> samples;
    if (lengths.back() < kLeastLength * solid_.detail()) return samples;
    const int num_steps =
        std::max(2, static_cast<int>(std::lround(lengths.back() / step)));
    for (int i = 0; i <= num_steps; ++i) {
      const double length = lengths.back() * i / num_steps;
      const auto after = std::clamp<std::ptrdiff_t>(
          std::ranges::lower_bound(lengths, length) - lengths.begin(),
          1,
          static_cast<std::ptrdiff_t>(lengths.size()) - 1);
      const auto k = static_cast<std::size_t>(after);
      const double share =
          (length - lengths[k - 1]) / (lengths[k] - lengths[k - 1]);
      const double s = places[k - 1] + share * (places[k] - places[k - 1]);
      const auto place = At(s);
      const Vector3d tangent = Tangent(s);
      if (!place || tangent.isZero()) continue;
      TrueSample sample;
      sample.position = place->position;
      sample.tangent = tangent;
      sample.kind = CurveKind::kMarking;
      samples.push_back(sample);
    }
    return samples;
  }

  const Solid& solid_;
  const Surfaces& surfaces_;
  const TrueCurve& caster_;
};

}  // namespace

std::vector<TrueCurve> MarkingCurves(const Solid& solid,
                                     const Surfaces& surfaces) {
  std::vector<TrueCurve> curves;
  for (std::size_t p = 0; p < solid.primitives().size(); ++p) {
    const SolidPrimitive& primitive = solid.primitives()[p];
    for (int face = 0; face < NumFaces(primitive.shape); ++face) {
      const FacePattern* pattern = surfaces.PatternOf(p, face);
      if (pattern == nullptr) continue;
      for (const TrueCurve& flat : pattern->Outlines()) {
        const TrueCurve whole = OnFace(primitive, face, flat);
        const auto on_surface = [&](double s) {
          return IsOnSurface(solid, p, face, whole.Position(s));
        };
        std::ranges::copy(PartsWhere(whole, solid.detail(), on_surface),
                          std::back_inserter(curves));
      }
    }
  }
  return curves;
}

std::vector<TrueSample> SampleShadowEdges(const Solid& solid,
                                          const Surfaces& surfaces,
                                          const std::vector<TrueCurve>& creases,
                                          double step,
                                          int first_id) {
  std::vector<TrueSample> samples;
  if (!surfaces.has_shadows()) return samples;
  std::vector<TrueCurve> casters = creases;
  for (const SolidPrimitive& primitive : solid.primitives()) {
    AppendTerminators(primitive, casters);
  }
  int id = first_id;
  for (const TrueCurve& caster : casters) {
    for (auto& shadow : EdgeShadow(solid, surfaces, caster).Sample(step)) {
      for (TrueSample& sample : shadow) {
        sample.curve_id = id;
        samples.push_back(sample);
      }
      ++id;
    }
  }
  return samples;
}

}  // namespace curvix

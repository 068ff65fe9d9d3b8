// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/synthetic_truth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/angles.h"
#include "base/infinity.h"
#include "synthetic/face_pattern.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// A face of a primitive and its surface in the world.
struct Face {
  const SolidPrimitive* primitive;
  bool is_plane;
  Vector3d point;  // on the plane; base of the frustum; centre of the sphere
  Vector3d axis;   // unit: normal of the plane, axis of the frustum
};

Face MakeFace(const SolidPrimitive& primitive, int face_idx) {
  const Rigid3& pose = primitive.world_from_own;
  const bool is_box = primitive.shape == PrimitiveShape::kBox;
  const bool is_plane = is_box || face_idx > 0;
  const Vector3d middle =
      is_plane ? OwnFromFace(primitive, face_idx, {0, 0}) : Vector3d::Zero();
  const Vector3d axis =
      is_box ? OwnNormal(primitive, face_idx, middle) : Vector3d::UnitZ();
  return {&primitive, is_plane, pose * middle, pose.rotation * axis};
}

std::optional<TrueCurve> CircleOf(const Vector3d& centre,
                                  const Vector3d& normal,
                                  double radius,
                                  double tolerance) {
  if (!(radius > tolerance)) return std::nullopt;
  return Circle(centre, normal, radius, CurveKind::kCrease);
}

// The whole line, as far as it runs within `box`.
std::optional<TrueCurve> PlanePlane(const Face& a,
                                    const Face& b,
                                    const Eigen::AlignedBox3d& box) {
  const Vector3d along = a.axis.cross(b.axis);
  if (along.norm() < 1e-6) return std::nullopt;
  const double cosine = a.axis.dot(b.axis);
  const double to_a = a.axis.dot(a.point);
  const double to_b = b.axis.dot(b.point);
  TrueCurve line;
  line.along = along.normalized();
  const Vector3d nearest =
      ((to_a - to_b * cosine) * a.axis + (to_b - to_a * cosine) * b.axis) /
      (1 - cosine * cosine);
  double begin = -kInfinity;
  double end = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = line.along[axis];
    const double to_low = box.min()[axis] - nearest[axis];
    const double to_high = box.max()[axis] - nearest[axis];
    if (std::abs(step) < 1e-12) {
      if (to_low > 0 || to_high < 0) return std::nullopt;
      continue;
    }
    begin = std::max(begin, std::min(to_low / step, to_high / step));
    end = std::min(end, std::max(to_low / step, to_high / step));
  }
  if (!(begin < end)) return std::nullopt;
  line.origin = nearest + begin * line.along;
  line.length = end - begin;
  return line;
}

std::optional<TrueCurve> PlaneRound(const Face& plane,
                                    const Face& round,
                                    double tolerance) {
  const Vector3d& size = round.primitive->size;
  const double height = plane.axis.dot(plane.point - round.point);
  if (round.primitive->shape == PrimitiveShape::kSphere) {
    const double squared = size.x() * size.x() - height * height;
    return CircleOf(round.point + height * plane.axis,
                    plane.axis,
                    std::sqrt(std::max(0.0, squared)),
                    tolerance);
  }
  const double cosine = plane.axis.dot(round.axis);
  if (std::abs(cosine) < 1 - 1e-9) return std::nullopt;
  const double z = height * cosine;
  return CircleOf(round.point + z * round.axis,
                  plane.axis,
                  size.x() + (size.y() - size.x()) * z / size.z(),
                  tolerance);
}

std::optional<TrueCurve> Candidate(const Face& a,
                                   const Face& b,
                                   const Eigen::AlignedBox3d& box,
                                   double tolerance) {
  if (a.is_plane && b.is_plane) return PlanePlane(a, b, box);
  if (a.is_plane) return PlaneRound(a, b, tolerance);
  if (b.is_plane) return PlaneRound(b, a, tolerance);
  return std::nullopt;
}

constexpr int kNumProbes = 32;

// How much of a small disc around x, across `tangent`, the solid fills: 0 to
// kNumProbes.
int CountFilled(const Solid& solid,
                const Vector3d& x,
                const Vector3d& tangent) {
  const double probe_radius = 1e-5 * solid.detail();
  const Vector3d u = tangent.unitOrthogonal();
  const Vector3d v = tangent.cross(u);
  int num_inside = 0;
  for (int i = 0; i < kNumProbes; ++i) {
    const double angle = 2 * kPi * (i + 0.37) / kNumProbes;
    num_inside += solid.Contains(
        x + probe_radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return num_inside;
}

// Whether the solid fills neither none, half nor all of the disc.
bool IsCrease(const Solid& solid, const Vector3d& x, const Vector3d& tangent) {
  const int num_inside = CountFilled(solid, x, tangent);
  return num_inside > 0 && num_inside < kNumProbes &&
         std::abs(num_inside - kNumProbes / 2) > 1;
}

// Whether x is on the whole line or circle that `curve` belongs to.
bool IsOnCarrier(const Vector3d& x, const TrueCurve& curve, double tolerance) {
  const Vector3d d = x - curve.origin;
  if (curve.radius == 0) return d.cross(curve.along).norm() < tolerance;
  const Vector3d radial =
      d.dot(curve.along) * curve.along + d.dot(curve.across) * curve.across;
  return (d - radial).norm() < tolerance &&
         std::abs(radial.norm() - curve.radius) < tolerance;
}

bool IsSame(const TrueCurve& a, const TrueCurve& b, double tolerance) {
  if ((a.radius == 0) != (b.radius == 0)) return false;
  return IsOnCarrier(a.Position(0), b, tolerance) &&
         IsOnCarrier(a.Position(a.length / 3), b, tolerance) &&
         IsOnCarrier(a.Position(2 * a.length / 3), b, tolerance);
}

// The different lines and circles in which faces of the solid may meet.
std::vector<TrueCurve> Candidates(const Solid& solid) {
  std::vector<Face> faces;
  for (const SolidPrimitive& primitive : solid.primitives()) {
    if (primitive.shape == PrimitiveShape::kSheet) continue;
    for (int face = 0; face < NumFaces(primitive.shape); ++face) {
      faces.push_back(MakeFace(primitive, face));
    }
  }
  const Vector3d margin = Vector3d::Constant(0.01 * solid.detail());
  const Eigen::AlignedBox3d box(solid.box().min() - margin,
                                solid.box().max() + margin);
  const double tolerance = 1e-6 * solid.detail();
  std::vector<TrueCurve> candidates;
  const auto is_new = [&](const TrueCurve& curve) {
    return std::ranges::none_of(candidates, [&](const TrueCurve& other) {
      return IsSame(curve, other, tolerance);
    });
  };
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      const auto curve = Candidate(faces[i], faces[j], box, tolerance);
      if (curve && is_new(*curve)) candidates.push_back(*curve);
    }
  }
  return candidates;
}

// Whether the segment `part` lies on the segment `curve`.
bool Covers(const TrueCurve& curve, const TrueCurve& part, double tolerance) {
  if (curve.radius > 0) return false;
  const auto is_on_curve = [&](const Vector3d& x) {
    const double s =
        std::clamp((x - curve.origin).dot(curve.along), 0.0, curve.length);
    return (x - curve.Position(s)).norm() < tolerance;
  };
  return is_on_curve(part.origin) && is_on_curve(part.Position(part.length));
}

// Whether a sheet other than `sheet` passes through x.
bool TouchesAnotherSheet(const Solid& solid,
                         const SolidPrimitive& sheet,
                         const Vector3d& x) {
  const double tolerance = 1e-6 * solid.detail();
  return std::ranges::any_of(
      solid.primitives(), [&](const SolidPrimitive& other) {
        if (other.shape != PrimitiveShape::kSheet || &other == &sheet) {
          return false;
        }
        const Vector3d own = OwnFromWorld(other, x);
        return ((own.cwiseAbs() - other.size).array() < tolerance).all();
      });
}

// The boundary of a sheet: free, or on a face of the solid or another sheet.
void AppendRim(const Solid& solid,
               const SolidPrimitive& sheet,
               std::vector<TrueCurve>& curves) {
  const double detail = solid.detail();
  const auto corner = [&](int i) {
    const Vector3d sign(i == 1 || i == 2 ? 1 : -1, i < 2 ? -1 : 1, 0);
    return sheet.world_from_own * sheet.size.cwiseProduct(sign);
  };
  for (int side = 0; side < 4; ++side) {
    for (const CurveKind kind : {CurveKind::kBoundary, CurveKind::kCrease}) {
      const TrueCurve whole =
          Segment(corner(side), corner((side + 1) % 4), kind);
      const auto has_kind = [&](double s) {
        const Vector3d x = whole.Position(s);
        const int num_filled = CountFilled(solid, x, whole.along);
        const bool touches =
            num_filled > 0 || TouchesAnotherSheet(solid, sheet, x);
        return num_filled < kNumProbes &&
               touches == (kind == CurveKind::kCrease);
      };
      for (const TrueCurve& part : PartsWhere(whole, detail, has_kind)) {
        const bool is_new =
            std::ranges::none_of(curves, [&](const TrueCurve& other) {
              return other.kind == kind && Covers(other, part, 1e-6 * detail);
            });
        if (is_new) curves.push_back(part);
      }
    }
  }
}

}  // namespace

std::vector<TrueCurve> CreaseCurves(const Solid& solid) {
  std::vector<TrueCurve> curves;
  for (const TrueCurve& whole : Candidates(solid)) {
    const auto is_crease = [&](double s) {
      return IsCrease(solid, whole.Position(s), whole.Tangent(s));
    };
    std::ranges::copy(PartsWhere(whole, solid.detail(), is_crease),
                      std::back_inserter(curves));
  }
  for (const SolidPrimitive& primitive : solid.primitives()) {
    if (primitive.shape != PrimitiveShape::kSheet) continue;
    AppendRim(solid, primitive, curves);
  }
  return curves;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "synthetic/counter_random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// The patch of one cell of a cubic grid; lengths in cells.
struct Patch {
  Vector3d centre;
  double radius;    // at most 0.5, so that 8 cells are near any point
  double strength;  // in +-1.2
  bool is_crisp;
};

// The i-th 21 of the 63 upper bits, in [0, 1).
double Third(std::uint64_t mixed, int i) {
  return static_cast<double>(mixed << (21 * i) >> 43) * 0x1.0p-21;
}

Patch PatchOfCell(const Eigen::Vector3i& cell, std::uint64_t id) {
  const std::uint64_t other = Mix(id);
  const double level = 2 * Third(other, 1) - 1;
  return {
      cell.cast<double>() + Vector3d(Third(id, 0), Third(id, 1), Third(id, 2)),
      0.25 + 0.25 * Third(other, 0),
      level + (level < 0 ? -0.2 : 0.2),
      Third(other, 2) < 0.5};
}

std::uint64_t CellId(const Eigen::Vector3i& cell, std::uint64_t seed) {
  std::uint64_t packed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    packed =
        (packed << 21) + static_cast<std::uint64_t>(cell[axis] + (1 << 20));
  }
  return Mix(seed ^ packed);
}

// Round patches at random places: a surface that passes through them shows what
// feature detectors look for. All fade to their rims, or half of them end there
// with a crisp rim.
struct SurfaceTexture {
  double contrast;   // grey levels between the brightest and the darkest patch
  double cell_size;  // mean distance of patches, world units
  std::uint64_t seed;
  bool has_rims;

  struct Value {
    double grey = 0;             // to be added, within +-contrast / 2
    std::uint64_t patch_id = 0;  // changes where the grey value jumps
  };
  Value At(const Vector3d& world) const {
    Value value;
    if (contrast == 0) return value;
    const Vector3d x = world / cell_size;
    const Eigen::Vector3i home = (x.array() - 0.5).floor().cast<int>();
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector3i cell =
          home + Eigen::Vector3i(k & 1, k >> 1 & 1, k >> 2);
      const std::uint64_t id = CellId(cell, seed);
      const Patch patch = PatchOfCell(cell, id);
      const double share =
          (x - patch.centre).squaredNorm() / (patch.radius * patch.radius);
      if (share >= 1) continue;
      const bool is_crisp = patch.is_crisp && has_rims;
      sum += patch.strength * (is_crisp ? 1 : (1 - share) * (1 - share));
      if (is_crisp) value.patch_id ^= id;
    }
    value.grey = contrast / 2 * std::clamp(sum, -1.0, 1.0);
    return value;
  }
};

constexpr double kMottle = 10;      // contrast, grey levels
constexpr double kSkyShare = 0.65;  // of the light, where the sun shines
constexpr double kMirrorShare = 0.45;
constexpr double kLampGrey = 250;

// Grey levels of faces that look along +x, +y, +z and along -x, -y, -z.
const Eigen::Array3d kForward(140, 78, 208);
const Eigen::Array3d kBackward(106, 174, 56);

// An ambient cube: smooth in the normal, so that shading makes no edges, and
// different for all faces of a box.
double Shade(const Vector3d& normal) {
  const Eigen::Array3d facing =
      (normal.array() > 0).select(kForward, kBackward);
  return (normal.array().square() * facing).sum();
}

// Which of the square lamps all around lies in this direction; 0: none.
std::uint64_t LampAt(const Vector3d& direction) {
  constexpr double kHalfWidth = 0.2;  // tangent of an angle
  static const std::array<Vector3d, 6> lamps = {
      Vector3d(0.5, -0.6, 0.62).normalized(),
      Vector3d(-0.8, -0.3, 0.5).normalized(),
      Vector3d(0.1, 0.8, 0.6).normalized(),
      Vector3d(0.9, 0.4, -0.1).normalized(),
      Vector3d(-0.3, -0.9, -0.1).normalized(),
      Vector3d(-0.5, 0.7, 0.1).normalized()};
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const double ahead = direction.dot(lamps[i]);
    if (ahead <= 0) continue;
    const Vector3d right = lamps[i].cross(Vector3d::UnitZ()).normalized();
    const double x = direction.dot(right) / ahead;
    const double y = direction.dot(right.cross(lamps[i])) / ahead;
    if (std::max(std::abs(x), std::abs(y)) < kHalfWidth) return i + 1;
  }
  return 0;
}

bool HasPattern(const Solid& solid) {
  return std::ranges::any_of(
      solid.primitives(), [](const SolidPrimitive& primitive) {
        return primitive.pattern != SurfacePattern::kNone;
      });
}

}  // namespace

Surfaces::Surfaces(const Solid& solid, const SyntheticOptions& options)
    : solid_(solid),
      options_(options),
      mottle_(HasPattern(solid) ? kMottle : 0) {
  std::uint64_t counter = 2;
  for (const SolidPrimitive& primitive : solid.primitives()) {
    auto& faces = patterns_.emplace_back();
    for (int face = 0; face < NumFaces(primitive.shape); ++face) {
      const auto area = AreaOfFace(primitive, face);
      const std::uint64_t seed = Mix(options.seed, counter++);
      faces.push_back(
          area ? MakeFacePattern(primitive.pattern, *area, options.scale, seed)
               : nullptr);
    }
  }
}

const Vector3d& Surfaces::SunDirection() {
  static const Vector3d direction = Vector3d(0.43, -0.55, 0.72).normalized();
  return direction;
}

const FacePattern* Surfaces::PatternOf(std::size_t primitive_idx,
                                       int face_idx) const {
  return patterns_[primitive_idx][static_cast<std::size_t>(face_idx)].get();
}

bool Surfaces::IsSunny(const Vector3d& x, const Vector3d& normal) const {
  if (normal.dot(SunDirection()) <= 0) return false;
  const double clear = 1e-5 * solid_.detail();
  return !solid_.Trace({x + clear * normal, SunDirection()});
}

// The light on the surface, 1 in full sunshine; `id` changes at shadows.
double Surfaces::Sunlight(const Vector3d& x,
                          const Vector3d& normal,
                          std::uint64_t& id) const {
  if (!IsSunny(x, normal)) return kSkyShare;
  id = Mix(id, 1);
  // Smooth where the surface turns away from the sun.
  const double facing = std::min(1.0, 2 * normal.dot(SunDirection()));
  return kSkyShare + (1 - kSkyShare) * (1 - (1 - facing) * (1 - facing));
}

Look Surfaces::At(const Ray& ray, const Hit& hit) const {
  const Vector3d x = ray.origin + hit.t * ray.direction;
  const SurfaceTexture texture{
      options_.texture, options_.scale / 18, options_.seed, true};
  const SurfaceTexture mottle{
      mottle_, options_.scale / 24, Mix(options_.seed, 1), false};
  const auto spots = texture.At(x);
  const SolidPrimitive& primitive = solid_.primitives()[hit.primitive_idx];
  const std::uint64_t face =
      8 * hit.primitive_idx + static_cast<unsigned>(hit.face_idx);
  Look look{primitive.albedo * Shade(hit.normal),
            Mix(spots.patch_id, face + 1)};
  if (const FacePattern* pattern = PatternOf(hit.primitive_idx, hit.face_idx)) {
    const Vector3d own = OwnFromWorld(primitive, x);
    const auto painted = pattern->At(FaceFromOwn(primitive, hit.face_idx, own));
    look.grey *= painted.tone;
    look.id = Mix(look.id, painted.patch_id);
  }
  if (options_.shadows) look.grey *= Sunlight(x, hit.normal, look.id);
  look.grey += spots.grey + mottle.At(x).grey;
  if (options_.reflections) {
    const Vector3d away = ray.direction.normalized();
    const std::uint64_t lamp =
        LampAt(away - 2 * away.dot(hit.normal) * hit.normal);
    if (lamp > 0) {
      look.grey += kMirrorShare * (kLampGrey - look.grey);
      look.id = Mix(look.id, lamp);
    }
  }
  return look;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// The result: curves in space.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace curvix {

// What shows as a curve in the images.
enum class CurveKind : std::uint8_t {
  kUnknown,           // the images do not tell
  kCrease,            // two surfaces meet
  kBoundary,          // a surface ends before something further away
  kMarking,           // one surface on both sides: paint, mortar, a shadow
  kOccludingContour,  // a round body turns away
};

constexpr int kNumCurveKinds = 5;

// "unknown", "crease", "boundary", "marking", "occluding_contour", and back.
// nullopt: none of these.
std::string_view KindName(CurveKind kind);
std::optional<CurveKind> KindFromName(std::string_view name);

// Some of the kinds; all of them by default.
class CurveKindSet {
 public:
  bool Has(CurveKind kind) const { return (bits_ & Bit(kind)) != 0; }
  void Add(CurveKind kind) { bits_ |= Bit(kind); }
  static CurveKindSet None() {
    CurveKindSet none;
    none.bits_ = 0;
    return none;
  }

 private:
  static unsigned Bit(CurveKind kind) {
    return 1U << static_cast<unsigned>(kind);
  }
  unsigned bits_ = ~0U;
};

struct CurveSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit, along the curve
  double sigma = 0;     // standard deviation across the curve, of each of the
                        // two axes, world units; 0: not estimated
  double evidence = 0;  // of Edge3d: how strongly the views support it
  std::vector<EdgeRef> support;  // at most one 2D edge per view, ascending
  // Of the position, across the curve; its trace is 2 sigma^2. World units
  // squared; 0: not estimated.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  // The most probable kind of curve here, and its probability; kUnknown: 0.
  // Occluding contours of CurveRefinementOptions::keep_occluding_contours,
  // which may also be what views show by chance: 1.
  CurveKind kind = CurveKind::kUnknown;
  float kind_probability = 0;
};

// A polyline of at least two samples. If `closed`, the last sample is followed
// by the first, which is not repeated.
struct Curve {
  bool closed = false;
  std::vector<CurveSample> samples;
  // The junctions in which the first and the last sample lie: indices into
  // CurveSet::junctions, or -1.
  int start_junction = -1;
  int end_junction = -1;
};

// Where ends of curves meet, as at a corner. The first or last samples of all
// these curves are at `position` to the last bit.
struct CurveJunction {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  double sigma = 0;  // the largest of its samples, world units
  int num_ends = 0;  // two or more
};

// The index of a curve is its id in every output file.
struct CurveSet {
  std::vector<Curve> curves;
  std::vector<CurveJunction> junctions = {};
};

// The entries xx, xy, xz, yy, yz, zz of a symmetric matrix.
inline std::array<double, 6> Triangle(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

// The length of the polyline, closing segment included. World units.
inline double Length(const Curve& curve) {
  double length = 0;
  for (std::size_t i = 1; i < curve.samples.size(); ++i) {
    length +=
        (curve.samples[i].position - curve.samples[i - 1].position).norm();
  }
  if (curve.closed && !curve.samples.empty()) {
    length +=
        (curve.samples.front().position - curve.samples.back().position).norm();
  }
  return length;
}

// The kind that most of the samples are of; ties: the first in CurveKind.
CurveKind MainKind(const Curve& curve);

// The pixel of the view's image, distortion included, at which `point` is seen.
// nullopt: behind the camera, more than 80 degrees off its axis, where the
// camera model is not one-to-one, or outside the image.
std::optional<Eigen::Vector2d> ProjectPoint(const Eigen::Vector3d& point,
                                            const View& view,
                                            const Camera& camera);

// The stretches of two or more successive samples of `curve` that the view
// could see, in pixels; the closing segment included. What surfaces hide is
// not left out.
std::vector<std::vector<Eigen::Vector2d>> ProjectCurve(const Curve& curve,
                                                       const View& view,
                                                       const Camera& camera);

// Part of a curve in the image of a view: two pixels or more.
struct ProjectedStretch {
  std::vector<Eigen::Vector2d> pixels;
  // Whether the view supports the samples, but for gaps of fewer than 20: edges
  // are missed here and there. What it does not show may be hidden.
  bool is_shown = false;
};

// The same, divided where the view begins or ceases to show the curve.
std::vector<ProjectedStretch> ProjectShownAndHidden(const Curve& curve,
                                                    const Scene& scene,
                                                    int view_idx);

// Gives curves one after the other, as often as needed, so that writers and
// fits keep few in memory. For one thread.
class CurveSource {
 public:
  using Visit = std::function<void(std::size_t id, const Curve& curve)>;

  virtual ~CurveSource() = default;

  // How many there are.
  virtual std::size_t size() const = 0;

  // Calls `visit` with each curve in the order of the ids, 0 to size() - 1. If
  // a curve cannot be read, none follows, and status() then says why.
  virtual void ForEach(const Visit& visit) const = 0;
  virtual Status status() const { return {}; }

  // The 2D edge of `ref`, which is a support of the curve that is being
  // visited.
  virtual Edge2d EdgeOf(const EdgeRef& ref) const = 0;
};

// Curves in memory, which outlive this. Without edge maps (one per view),
// nothing may ask for edges.
class CurvesInMemory : public CurveSource {
 public:
  explicit CurvesInMemory(const CurveSet& curves,
                          const std::vector<EdgeMap>* edge_maps = nullptr)
      : curves_(curves), edge_maps_(edge_maps) {}
  CurvesInMemory(CurveSet&&, const std::vector<EdgeMap>* = nullptr) = delete;

  std::size_t size() const override { return curves_.curves.size(); }
  void ForEach(const Visit& visit) const override {
    for (std::size_t id = 0; id < size(); ++id) visit(id, curves_.curves[id]);
  }
  Edge2d EdgeOf(const EdgeRef& ref) const override {
    return edge_maps_->at(static_cast<std::size_t>(ref.view_idx))
        .edges.at(static_cast<std::size_t>(ref.edge_idx));
  }

 private:
  const CurveSet& curves_;
  const std::vector<EdgeMap>* edge_maps_;
};

}  // namespace curvix

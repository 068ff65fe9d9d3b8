// SPDX-License-Identifier: BSD-3-Clause
// Curves and their fits as flat arrays, which NumPy looks at without copying.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace curvix {

using SharedEdges = std::shared_ptr<const std::vector<EdgeMap>>;

// One entry per curve (offsets: and one more), per sample or per support.
// Samples of curve i: sample_offsets[i] to sample_offsets[i + 1]; supports of
// sample j alike.
struct CurveColumns {
  std::vector<std::int64_t> sample_offsets = {0};
  std::vector<std::uint8_t> closed;
  std::vector<std::int32_t> start_junction;
  std::vector<std::int32_t> end_junction;

  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> tangents;
  std::vector<Eigen::Matrix3d> covariances;
  std::vector<double> sigmas;
  std::vector<double> evidence;
  std::vector<CurveKind> kinds;
  std::vector<float> kind_probabilities;
  std::vector<std::int64_t> support_offsets = {0};

  std::vector<EdgeRef> support;
};

// A set of curves that is kept as columns. Writers and fits see it as the
// curves that it was made of.
class CurveTable : public CurveSource {
 public:
  // Without edge maps, the edges of supports are not known: not a number.
  CurveTable(CurveSet curves, SharedEdges edge_maps);

  std::size_t size() const override { return columns_.closed.size(); }
  void ForEach(const Visit& visit) const override;
  Edge2d EdgeOf(const EdgeRef& ref) const override;

  Curve At(std::size_t id) const;
  // These curves, each less than size(), in that order. Junctions that keep two
  // ends stay.
  CurveSet Select(const std::vector<std::size_t>& ids) const;

  const CurveColumns& columns() const { return columns_; }
  const std::vector<CurveJunction>& junctions() const { return junctions_; }
  const SharedEdges& edge_maps() const { return edge_maps_; }

 private:
  void Append(const Curve& curve);

  CurveColumns columns_;
  std::vector<CurveJunction> junctions_;
  SharedEdges edge_maps_;
};

// A CurveFit; `curve` is the index of its curve. Its control points are
// num_points from first_point on, its knots num_points + 4 from first_knot on;
// none but of splines.
struct FitRow {
  std::int64_t curve;
  std::uint8_t kind;
  bool closed;
  std::int64_t first_sample;
  std::int64_t num_samples;
  double length;
  double start[3];
  double end[3];
  std::int32_t start_node;
  std::int32_t end_node;
  double radius;  // of arcs; of others not a number
  double center[3];
  double major[3];
  double minor[3];
  double start_angle;
  double end_angle;
  std::int64_t first_point;
  std::int64_t num_points;
  std::int64_t first_knot;
  double rms_residual;
  double max_residual;
  double inlier_share;
  double sigma;
  double radius_sigma;
};

struct FitTable {
  explicit FitTable(FittedCurves from);

  FittedCurves fitted;
  std::vector<FitRow> rows;               // curve after curve
  std::vector<std::int64_t> fit_offsets;  // into rows; one per curve, and one
  std::vector<Eigen::Vector3d> spline_points;
  std::vector<double> spline_knots;
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Eigen::Matrix3d> node_covariances;
};

// The fits of some curves, in that order, and what they share. Nodes that keep
// two ends stay.
FittedCurves SelectFits(const FittedCurves& fitted,
                        const std::vector<std::size_t>& curve_idxs);

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/python/curve_table.h"

#include <limits>
#include <map>
#include <utility>

#include "fitting/structure.h"

namespace curvix {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

void Copy(const Eigen::Vector3d& from, double (&to)[3]) {
  Eigen::Map<Eigen::Vector3d>(static_cast<double*>(to)) = from;
}

FitRow RowOf(std::size_t curve_idx, const CurveFit& fit) {
  FitRow row = {};
  row.curve = static_cast<std::int64_t>(curve_idx);
  row.kind = static_cast<std::uint8_t>(fit.kind);
  row.closed = fit.closed;
  row.first_sample = static_cast<std::int64_t>(fit.first_sample);
  row.num_samples = static_cast<std::int64_t>(fit.num_samples);
  row.length = Length(fit);
  Copy(fit.start, row.start);
  Copy(fit.end, row.end);
  row.start_node = fit.start_node;
  row.end_node = fit.end_node;
  row.radius = fit.kind == FitKind::kArc ? fit.major.norm() : kNotANumber;
  Copy(fit.center, row.center);
  Copy(fit.major, row.major);
  Copy(fit.minor, row.minor);
  row.start_angle = fit.start_angle;
  row.end_angle = fit.end_angle;
  row.num_points = static_cast<std::int64_t>(fit.control_points.size());
  row.rms_residual = fit.rms_residual;
  row.max_residual = fit.max_residual;
  row.inlier_share = fit.inlier_share;
  row.sigma = fit.sigma;
  row.radius_sigma = fit.radius_sigma;
  return row;
}

template <typename T>
void AppendAll(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

// New numbers for those that are named twice or more, in the order of the old
// ones. The others have none.
std::map<int, int> NumberTheRepeated(const std::map<int, int>& counts) {
  std::map<int, int> numbers;
  for (const auto& [idx, count] : counts) {
    if (count >= 2) numbers.emplace(idx, static_cast<int>(numbers.size()));
  }
  return numbers;
}

int NumberOf(const std::map<int, int>& numbers, int idx) {
  const auto found = numbers.find(idx);
  return found == numbers.end() ? -1 : found->second;
}

}  // namespace

CurveTable::CurveTable(CurveSet curves, SharedEdges edge_maps)
    : junctions_(std::move(curves.junctions)),
      edge_maps_(std::move(edge_maps)) {
  std::size_t num_samples = 0, num_supports = 0;
  for (const Curve& curve : curves.curves) {
    num_samples += curve.samples.size();
    for (const CurveSample& sample : curve.samples) {
      num_supports += sample.support.size();
    }
  }
  CurveColumns& to = columns_;
  to.positions.reserve(num_samples);
  to.tangents.reserve(num_samples);
  to.covariances.reserve(num_samples);
  to.sigmas.reserve(num_samples);
  to.evidence.reserve(num_samples);
  to.kinds.reserve(num_samples);
  to.kind_probabilities.reserve(num_samples);
  to.support_offsets.reserve(num_samples + 1);
  to.support.reserve(num_supports);
  for (Curve& curve : curves.curves) {
    Append(curve);
    curve = Curve();  // gives its memory back
  }
}

void CurveTable::Append(const Curve& curve) {
  CurveColumns& to = columns_;
  for (const CurveSample& sample : curve.samples) {
    to.positions.push_back(sample.position);
    to.tangents.push_back(sample.tangent);
    to.covariances.push_back(sample.covariance);
    to.sigmas.push_back(sample.sigma);
    to.evidence.push_back(sample.evidence);
    to.kinds.push_back(sample.kind);
    to.kind_probabilities.push_back(sample.kind_probability);
    AppendAll(sample.support, to.support);
    to.support_offsets.push_back(static_cast<std::int64_t>(to.support.size()));
  }
  to.sample_offsets.push_back(static_cast<std::int64_t>(to.positions.size()));
  to.closed.push_back(curve.closed);
  to.start_junction.push_back(curve.start_junction);
  to.end_junction.push_back(curve.end_junction);
}

Curve CurveTable::At(std::size_t id) const {
  const CurveColumns& from = columns_;
  Curve curve;
  curve.closed = from.closed[id] != 0;
  curve.start_junction = from.start_junction[id];
  curve.end_junction = from.end_junction[id];
  const auto begin = static_cast<std::size_t>(from.sample_offsets[id]);
  const auto end = static_cast<std::size_t>(from.sample_offsets[id + 1]);
  curve.samples.resize(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    CurveSample& sample = curve.samples[i - begin];
    sample.position = from.positions[i];
    sample.tangent = from.tangents[i];
    sample.covariance = from.covariances[i];
    sample.sigma = from.sigmas[i];
    sample.evidence = from.evidence[i];
    sample.kind = from.kinds[i];
    sample.kind_probability = from.kind_probabilities[i];
    sample.support.assign(from.support.begin() + from.support_offsets[i],
                          from.support.begin() + from.support_offsets[i + 1]);
  }
  return curve;
}

void CurveTable::ForEach(const Visit& visit) const {
  for (std::size_t id = 0; id < size(); ++id) visit(id, At(id));
}

Edge2d CurveTable::EdgeOf(const EdgeRef& ref) const {
  if (edge_maps_ == nullptr) {
    Edge2d unknown;
    unknown.position.setConstant(kNotANumber);
    return unknown;
  }
  return edge_maps_->at(static_cast<std::size_t>(ref.view_idx))
      .edges.at(static_cast<std::size_t>(ref.edge_idx));
}

CurveSet CurveTable::Select(const std::vector<std::size_t>& ids) const {
  CurveSet selected;
  std::map<int, int> num_ends;
  for (const std::size_t id : ids) {
    selected.curves.push_back(At(id));
    ++num_ends[selected.curves.back().start_junction];
    ++num_ends[selected.curves.back().end_junction];
  }
  num_ends.erase(-1);
  const std::map<int, int> numbers = NumberTheRepeated(num_ends);
  for (const auto& [idx, number] : numbers) {
    CurveJunction junction = junctions_[static_cast<std::size_t>(idx)];
    junction.num_ends = num_ends[idx];
    selected.junctions.push_back(junction);
  }
  for (Curve& curve : selected.curves) {
    curve.start_junction = NumberOf(numbers, curve.start_junction);
    curve.end_junction = NumberOf(numbers, curve.end_junction);
  }
  return selected;
}

FitTable::FitTable(FittedCurves from) : fitted(std::move(from)) {
  fit_offsets.push_back(0);
  for (std::size_t i = 0; i < fitted.curves.size(); ++i) {
    for (const CurveFit& fit : fitted.curves[i].fits) {
      rows.push_back(RowOf(i, fit));
      rows.back().first_point = static_cast<std::int64_t>(spline_points.size());
      rows.back().first_knot = static_cast<std::int64_t>(spline_knots.size());
      AppendAll(fit.control_points, spline_points);
      AppendAll(fit.knots, spline_knots);
    }
    fit_offsets.push_back(static_cast<std::int64_t>(rows.size()));
  }
  for (const CurveNode& node : fitted.nodes) {
    nodes.push_back(node.position);
    node_covariances.push_back(node.covariance);
  }
}

FittedCurves SelectFits(const FittedCurves& fitted,
                        const std::vector<std::size_t>& curve_idxs) {
  FittedCurves selected;
  std::map<int, int> num_ends;
  for (const std::size_t idx : curve_idxs) {
    selected.curves.push_back(fitted.curves[idx]);
    for (const CurveFit& fit : selected.curves.back().fits) {
      ++num_ends[fit.start_node];
      ++num_ends[fit.end_node];
    }
  }
  num_ends.erase(-1);
  const std::map<int, int> numbers = NumberTheRepeated(num_ends);
  for (const auto& [idx, number] : numbers) {
    const CurveNode& node = fitted.nodes[static_cast<std::size_t>(idx)];
    selected.nodes.push_back({node.position, {}, node.covariance});
  }
  const auto renumber =
      [&](int& node, std::size_t curve, std::size_t fit, bool at_end) {
        node = NumberOf(numbers, node);
        if (node < 0) return;
        selected.nodes[static_cast<std::size_t>(node)].ends.push_back(
            {curve, fit, at_end});
      };
  for (std::size_t i = 0; i < selected.curves.size(); ++i) {
    std::vector<CurveFit>& fits = selected.curves[i].fits;
    for (std::size_t k = 0; k < fits.size(); ++k) {
      renumber(fits[k].start_node, i, k, false);
      renumber(fits[k].end_node, i, k, true);
    }
  }
  selected.structure = FindStructure(selected);
  return selected;
}

}  // namespace curvix

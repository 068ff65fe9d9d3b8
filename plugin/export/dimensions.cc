// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/dimensions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/angles.h"
#include "base/text_fields.h"
#include "measuring/known_directions.h"
#include "plugin/export/spread.h"

namespace curvix {
namespace {

constexpr std::size_t kMaxRows = 100;
constexpr std::size_t kMaxPartners = 15;
constexpr double kParallelSigmas = 3;

struct Named {
  std::string name;
  const CurveFit* fit = nullptr;
  double size = 0;
};

class Table {
 public:
  Table(const CurveRecord& record, const ByteSink& sink)
      : sink_(sink), alignment_(record.alignment) {
    unit_ = alignment_ != nullptr ? alignment_->unit : "";
  }

  // A length with its standard deviation, that of the scale left out.
  void AddLength(const char* dimension,
                 const std::string& from,
                 const std::string& to,
                 double value,
                 double sigma) {
    const double scale = alignment_ != nullptr ? alignment_->scale_sigma() : 0;
    Add(dimension, from, to, value, std::hypot(sigma, value * scale), unit_);
  }
  void AddAngle(const std::string& from,
                const std::string& to,
                double angle,
                double sigma) {
    Add("angle", from, to, RadToDeg(angle), RadToDeg(sigma), "deg");
  }

 private:
  void Add(const char* dimension,
           const std::string& from,
           const std::string& to,
           double value,
           double sigma,
           const std::string& unit) {
    sink_(std::string(dimension) + "," + from + "," + to + "," +
          NumberText(value) + "," + NumberText(sigma) + "," + unit + "\n");
  }

  const ByteSink& sink_;
  const WorldAlignment* alignment_;
  std::string unit_;
};

template <typename Takes, typename SizeOf>
std::vector<Named> Largest(const FittedCurves& fitted,
                           const Takes& takes,
                           const SizeOf& size_of,
                           std::size_t max_count) {
  std::vector<Named> named;
  for (std::size_t c = 0; c < fitted.curves.size(); ++c) {
    const std::vector<CurveFit>& fits = fitted.curves[c].fits;
    for (std::size_t f = 0; f < fits.size(); ++f) {
      if (!takes(fitted.curves[c], fits[f])) continue;
      named.push_back({std::string(KindName(fits[f])) + " " +
                           std::to_string(c) + "." + std::to_string(f),
                       &fits[f],
                       size_of(fits[f])});
    }
  }
  std::ranges::stable_sort(named, std::ranges::greater(), &Named::size);
  named.resize(std::min(named.size(), max_count));
  return named;
}

void AddLines(const std::vector<Named>& lines, Table& table) {
  for (const Named& line : lines) {
    const CurveFit& fit = *line.fit;
    const double sigma = DistanceSigma(
        fit.end - fit.start, fit.start_covariance, fit.end_covariance);
    table.AddLength("length", line.name, "", line.size, sigma);
  }
}

// From the middle of the shorter line `b` to the line `a`.
void AddDistance(const Named& a, const Named& b, Table& table) {
  const Eigen::Vector3d chord = a.fit->end - a.fit->start;
  const Eigen::Vector3d middle = (b.fit->start + b.fit->end) / 2;
  const double at = chord.dot(middle - a.fit->start) / chord.squaredNorm();
  const Eigen::Vector3d off = middle - (a.fit->start + at * chord);
  // A point of the line is a weighted mean of its ends.
  const double t = std::clamp(at, 0.0, 1.0);
  const Eigen::Matrix3d of_a = (1 - t) * (1 - t) * a.fit->start_covariance +
                               t * t * a.fit->end_covariance;
  const Eigen::Matrix3d of_b =
      (b.fit->start_covariance + b.fit->end_covariance) / 4;
  if (!(off.norm() > 0)) return;
  table.AddLength(
      "distance", a.name, b.name, off.norm(), DistanceSigma(off, of_a, of_b));
}

void AddPairsOfLines(const std::vector<Named>& lines, Table& table) {
  const std::size_t n = std::min(lines.size(), kMaxPartners);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const CurveFit& a = *lines[i].fit;
      const CurveFit& b = *lines[j].fit;
      const Eigen::Vector3d first = (a.end - a.start).normalized();
      const Eigen::Vector3d second = (b.end - b.start).normalized();
      const double angle =
          std::atan2(first.cross(second).norm(), std::abs(first.dot(second)));
      const double sigma =
          std::sqrt(DirectionVariance(a) + DirectionVariance(b));
      table.AddAngle(lines[i].name, lines[j].name, angle, sigma);
      if (angle < std::min(kParallelSigmas * sigma, DegToRad(kParallelDeg))) {
        AddDistance(lines[i], lines[j], table);
      }
    }
  }
}

void AddRadii(const std::vector<Named>& arcs, Table& table) {
  for (const Named& arc : arcs) {
    table.AddLength("radius", arc.name, "", arc.size, arc.fit->radius_sigma);
  }
}

void AddPairsOfCircles(const std::vector<Named>& circles, Table& table) {
  const std::size_t n = std::min(circles.size(), kMaxPartners);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const CurveFit& a = *circles[i].fit;
      const CurveFit& b = *circles[j].fit;
      // A centre is known as well as the radius is.
      table.AddLength("distance",
                      circles[i].name,
                      circles[j].name,
                      (a.center - b.center).norm(),
                      std::hypot(a.radius_sigma, b.radius_sigma));
    }
  }
}

// Of the better half by uncertainty: the first, then always the one that is
// furthest from those chosen before.
std::vector<std::size_t> SpreadNodes(const std::vector<CurveNode>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return nodes[i].covariance.trace(); });
  order.resize((order.size() + 1) / 2);
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (nodes[order[i]].position - nodes[order[j]].position).norm();
  };
  std::vector<std::size_t> chosen;
  for (const std::size_t i : SpreadOut(order.size(), kMaxPartners, distance)) {
    chosen.push_back(order[i]);
  }
  std::ranges::sort(chosen);
  return chosen;
}

void AddNodes(const std::vector<CurveNode>& nodes, Table& table) {
  const std::vector<std::size_t> chosen = SpreadNodes(nodes);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = i + 1; j < chosen.size(); ++j) {
      const CurveNode& a = nodes[chosen[i]];
      const CurveNode& b = nodes[chosen[j]];
      const Eigen::Vector3d between = b.position - a.position;
      table.AddLength("distance",
                      "node " + std::to_string(chosen[i]),
                      "node " + std::to_string(chosen[j]),
                      between.norm(),
                      DistanceSigma(between, a.covariance, b.covariance));
    }
  }
}

}  // namespace

void EncodeDimensions(const CurveRecord& record, const ByteSink& sink) {
  sink("dimension,from,to,value,sigma,unit\n");
  Table table(record, sink);
  const std::vector<Named> lines = Largest(
      record.fitted,
      [](const FittedCurve&, const CurveFit& fit) {
        return fit.kind == FitKind::kLine && Length(fit) > 0;
      },
      [](const CurveFit& fit) { return Length(fit); },
      kMaxRows);
  // Nearly straight arcs, which are the largest, leave room for circles.
  const auto arcs = [&](bool closed, std::size_t max_count) {
    return Largest(
        record.fitted,
        [&](const FittedCurve& curve, const CurveFit& fit) {
          return fit.kind == FitKind::kArc && fit.closed == closed &&
                 curve.fits.size() == 1 && Length(fit) > 0;
        },
        [](const CurveFit& fit) { return fit.major.norm(); },
        max_count);
  };
  const std::vector<Named> circles = arcs(true, kMaxRows);
  AddLines(lines, table);
  AddRadii(circles, table);
  AddRadii(arcs(false, kMaxRows - circles.size()), table);
  AddPairsOfCircles(circles, table);
  AddPairsOfLines(lines, table);
  AddNodes(record.fitted.nodes, table);
}

}  // namespace curvix

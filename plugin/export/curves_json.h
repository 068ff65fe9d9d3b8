// SPDX-License-Identifier: BSD-3-Clause
// curves.json: everything that is known about the curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/file_io.h"
#include "base/text_fields.h"
#include "measuring/world_alignment.h"
#include "plugin/base/json.h"

namespace curvix {

// What a run knows about its curves, all in one frame. All of it outlives the
// bundle.
struct CurveRecord {
  const Scene& scene;
  const CurveSource& curves;   // whose 2D edges are known
  const FittedCurves& fitted;  // of `curves`
  // Whose world the frame is; nullptr: the frame is the model's.
  const WorldAlignment* alignment = nullptr;
};

// An edge of a view that supports a sample.
struct SupportingEdge {
  // In the image, distortion included.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double residual_px = 0;  // signed distance of the projected sample from the
                           // edge's line, in the ideal pinhole image; positive
                           // on the bright side
};

// `edge` of the view supports `sample`. nullopt if the sample is behind the
// camera. `pixel` is not finite where the image has none for the edge.
std::optional<SupportingEdge> FindSupportingEdge(const Scene& scene,
                                                 const CurveSample& sample,
                                                 const EdgeRef& ref,
                                                 const Edge2d& edge);

// The text of curves.json, as docs/curves.schema.json and
// docs/output_format.md describe it: one line per curve.
void EncodeCurvesJson(const CurveRecord& record,
                      int num_threads,
                      const ByteSink& sink);

// Texts of JSON values on a line each, with commas between, which are made on
// several threads, some hundred at a time. `sink` must outlive it.
class JsonLines {
 public:
  JsonLines(int num_threads, const ByteSink& sink)
      : num_threads_(num_threads), sink_(sink) {}

  // `text` is called later, on any thread.
  void Add(std::function<std::string()> text);
  // Writes what has been added.
  void Flush();

 private:
  int num_threads_;
  const ByteSink& sink_;
  bool is_first_ = true;
  std::vector<std::function<std::string()>> texts_;
};

// `json` on one line, safe within an HTML <script> element too. Numbers that
// are not finite are null.
std::string JsonText(const Json& json);

// Appends a number, "null" if it is not finite. Numbers of floating-point types
// have a decimal point or an exponent.
template <typename T>
void AppendJson(T value, std::string& out) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  const std::size_t begin = out.size();
  AppendNumber(value, out);
  if (std::is_floating_point_v<T> &&
      out.find_first_of(".e", begin) == std::string::npos) {
    out += ".0";
  }
}

// Appends a JSON array of what `append`(item, out) appends for each item.
template <typename Items, typename Append>
void AppendJsonList(const Items& items,
                    const Append& append,
                    std::string& out) {
  out += '[';
  for (const auto& item : items) {
    append(item, out);
    out += ',';
  }
  if (out.back() == ',') out.pop_back();
  out += ']';
}

Json VectorJson(const Eigen::Vector3d& v);

// `value` with so many digits behind the point at most; NaN and infinity stay.
inline double Rounded(double value, int num_decimals) {
  const double scale = std::pow(10.0, num_decimals);
  const double scaled = std::round(value * scale);
  return scaled == 0 ? 0.0 : scaled / scale;
}

// The double nearest to `value` in so many significant digits, at most 17.
double RoundedToDigits(double value, int num_digits);

}  // namespace curvix

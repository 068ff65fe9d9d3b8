// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as text.
#include "io/curve_formats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "base/check.h"
#include "base/line_reader.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

// image id -> view number
using ViewByImageId = std::map<std::uint32_t, std::int32_t>;

void AppendSample(const CurveSample& sample,
                  const Scene& scene,
                  std::string& out) {
  AppendNumbers(sample.position, ' ', out);
  out += ' ';
  AppendNumbers(sample.tangent, ' ', out);
  out += ' ';
  AppendNumber(sample.sigma, out);
  out += ' ';
  out += KindName(sample.kind);
  for (const EdgeRef& ref : sample.support) {
    if (scene.views.empty()) break;
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    CURVIX_CHECK(view_idx < scene.views.size(), "support names a view");
    out += ' ';
    AppendNumber(scene.views[view_idx].image_id, out);
  }
  out += '\n';
}

// Sets `curve.closed` and returns the number of samples that follow.
std::optional<std::size_t> ParseHead(std::string_view line, Curve& curve) {
  WordReader words(line);
  words.Number<std::uint64_t>();  // the id
  const std::string_view closed = words.Word();
  const auto count = words.Number<std::uint64_t>();
  const bool is_flag = closed == "0" || closed == "1";
  if (words.failed() || !words.AtEnd() || !is_flag || count < 2) {
    return std::nullopt;
  }
  curve.closed = closed == "1";
  return static_cast<std::size_t>(count);
}

std::optional<CurveSample> ParseSample(std::string_view line,
                                       const ViewByImageId& views) {
  WordReader words(line);
  CurveSample sample;
  for (double& x : sample.position) x = words.Number<double>();
  for (double& x : sample.tangent) x = words.Number<double>();
  sample.sigma = words.Number<double>();
  const auto kind = KindFromName(words.Word());
  std::vector<EdgeRef>& support = sample.support;
  while (!words.AtEnd()) {
    const auto view = views.find(words.Number<std::uint32_t>());
    if (view != views.end()) support.push_back({view->second, 0});
  }
  if (words.failed() || !kind || !sample.position.allFinite() ||
      !sample.tangent.allFinite() || !std::isfinite(sample.sigma)) {
    return std::nullopt;
  }
  sample.kind = *kind;
  std::sort(support.begin(), support.end());
  support.erase(std::unique(support.begin(), support.end()), support.end());
  return sample;
}

Status Broken(std::size_t line_number, const std::string& expected) {
  return Status::DataLoss("line " + std::to_string(line_number) + " is not " +
                          expected +
                          "; the file is truncated or was changed by hand");
}

// Reads so many samples into `curve`.
Status ReadSamples(std::size_t num_samples,
                   const ViewByImageId& views,
                   LineReader& lines,
                   Curve& curve) {
  // Seven digits, "crease", seven blanks.
  constexpr std::size_t kMinBytesOfSample = 20;
  if (num_samples > lines.bytes_left() / kMinBytesOfSample) {
    return Broken(lines.line_number(),
                  "followed by as many samples as it announces");
  }
  curve.samples.reserve(num_samples);
  for (std::size_t i = 0; i < num_samples; ++i) {
    const std::optional<std::string_view> line = lines.NextFilled();
    std::optional<CurveSample> sample;
    if (line) sample = ParseSample(*line, views);
    if (!sample) {
      return Broken(lines.line_number(),
                    "a sample (X Y Z TX TY TZ SIGMA KIND IMAGE_IDS)");
    }
    curve.samples.push_back(*std::move(sample));
  }
  return {};
}

}  // namespace

void EncodeTxtCurves(const CurveSource& curves,
                     const Scene& scene,
                     const ByteSink& sink) {
  std::string out =
      "# Curves, with two kinds of lines:\n"
      "#   CURVE_ID CLOSED NUM_SAMPLES, then for each of its samples\n"
      "#   X Y Z TX TY TZ SIGMA KIND IMAGE_IDS...\n"
      "# Number of curves: ";
  AppendNumber(curves.size(), out);
  out += '\n';
  sink(out);
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    out.clear();
    AppendNumber(id, out);
    out += curve.closed ? " 1 " : " 0 ";
    AppendNumber(curve.samples.size(), out);
    out += '\n';
    for (const CurveSample& sample : curve.samples) {
      AppendSample(sample, scene, out);
    }
    sink(out);
  });
}

Result<CurveSet> DecodeTxtCurves(std::string_view bytes, const Scene& scene) {
  ViewByImageId views;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    views.emplace(scene.views[i].image_id, static_cast<std::int32_t>(i));
  }
  LineReader lines(bytes);
  CurveSet curves;
  while (const std::optional<std::string_view> line = lines.NextFilled()) {
    Curve curve;
    const std::optional<std::size_t> num_samples = ParseHead(*line, curve);
    if (!num_samples) {
      return Broken(lines.line_number(),
                    "a curve (CURVE_ID CLOSED NUM_SAMPLES)");
    }
    CURVIX_RETURN_IF_ERROR(ReadSamples(*num_samples, views, lines, curve));
    curves.curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets as Wavefront OBJ.
#include "io/curve_formats.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/line_reader.h"
#include "base/text_fields.h"
#include "io/curve_style.h"
#include "io/polylines.h"

namespace curvix {
namespace {

void AppendSegment(std::size_t a, std::size_t b, std::string& out) {
  out += "l ";
  AppendNumbers(std::array{a, b}, ' ', out);
  out += '\n';
}

// The end of the line of a vertex.
std::string ColorText(const Rgb& color) {
  std::string text;
  for (const std::uint8_t channel : color) {
    text += ' ';
    AppendNumber(std::round(channel / 0.255) / 1000, text);
  }
  return text += '\n';
}

// The vertex that is counted last of all that lines name, and a line with it.
// It may follow that line.
struct LastVertex {
  std::int64_t number = 0;
  std::size_t line = 0;
};

// Adds the vertices and edges of one line; false if it is broken.
bool ParseVertex(std::string_view line, LineGraph& graph) {
  WordReader words(line);
  Eigen::Vector3d& position = graph.positions.emplace_back();
  for (double& x : position) x = words.Number<double>();
  return !words.failed() && position.allFinite();
}

bool ParseLine(std::string_view words,
               std::size_t line_number,
               LineGraph& graph,
               LastVertex& last) {
  const auto size = static_cast<std::int64_t>(graph.positions.size());
  std::optional<std::int64_t> previous;
  while (true) {
    const std::string_view word = TakeWord(words);
    if (word.empty()) return previous.has_value();
    const auto number =
        ParseNumber<std::int64_t>(word.substr(0, word.find('/')));
    // Numbers count from 1; negative ones count back from the last vertex.
    if (!number || *number == 0 || *number < -size) return false;
    if (*number > last.number) last = {*number, line_number};
    const std::int64_t vertex = *number > 0 ? *number - 1 : size + *number;
    if (previous) graph.edges.push_back({*previous, vertex});
    previous = vertex;
  }
}

Status NotUnderstood(std::size_t line_number, std::string_view line) {
  return Status::DataLoss("line " + std::to_string(line_number) +
                          " is not understood: \"" +
                          std::string(line.substr(0, 80)) + "\"");
}

}  // namespace

void EncodeObjLines(const CurveSource& curves, const ByteSink& sink) {
  sink("# 3D curves of curvix: v x y z red green blue, l from to\n");
  std::size_t first = 1;
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    const std::size_t n = curve.samples.size();
    std::string out = "o curve_";
    AppendNumber(id, out);
    out += '\n';
    const std::string color = ColorText(CurveColor(id));
    for (const CurveSample& sample : curve.samples) {
      out += "v ";
      AppendNumbers(sample.position, ' ', out);
      out += color;
    }
    for (std::size_t i = 1; i < n; ++i) {
      AppendSegment(first + i - 1, first + i, out);
    }
    if (curve.closed && n > 2) AppendSegment(first + n - 1, first, out);
    first += n;
    sink(out);
  });
}

Result<CurveSet> DecodeObjLines(std::string_view bytes) {
  LineGraph graph;
  LastVertex last;
  bool any_line = false;
  bool only_comments = true;
  bytes = WithoutByteOrderMark(bytes);
  for (std::size_t number = 1; !bytes.empty(); ++number) {
    const std::string_view line = TakeLine(bytes);
    std::string_view words = line;
    const std::string_view keyword = TakeWord(words);
    if (keyword.empty() || keyword.starts_with('#')) continue;
    only_comments = false;
    bool understood = true;
    if (keyword == "v") understood = ParseVertex(words, graph);
    if (keyword == "l") {
      any_line = true;
      understood = ParseLine(words, number, graph, last);
    }
    if (!understood) return NotUnderstood(number, line);
  }
  if (!any_line && !only_comments) {
    return Status::Unsupported(
        "the OBJ has no line (\"l\"), so it holds no curves");
  }
  const std::size_t num_vertices = graph.positions.size();
  if (last.number > static_cast<std::int64_t>(num_vertices)) {
    return Status::DataLoss("line " + std::to_string(last.line) +
                            " names vertex " + std::to_string(last.number) +
                            ", but the file has " +
                            std::to_string(num_vertices) + "; it is damaged");
  }
  return JoinPolylines(graph);
}

}  // namespace curvix

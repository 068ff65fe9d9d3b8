// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets from PLY.
#include <array>
#include <cmath>
#include <optional>

#include "io/ply_lines.h"
#include "io/ply_reader.h"
#include "io/polylines.h"

namespace curvix {
namespace {

// The columns of `element` with these names; nothing if one is missing.
std::optional<std::vector<std::size_t>> FindScalars(
    const PlyElement& element, const std::vector<std::string_view>& names) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : names) {
    const std::optional<std::size_t> column = FindScalar(element, name);
    if (!column) return std::nullopt;
    columns.push_back(*column);
  }
  return columns;
}

Status NoColumns(const std::string& what) {
  return {StatusCode::kUnsupported,
          "the PLY has no " + what + ", so it is not a set of lines; a point " +
              "cloud or a mesh holds no curves"};
}

// Unknown for numbers of no kind.
CurveKind KindFromNumber(double number) {
  return number > 0 && number < kNumCurveKinds ? static_cast<CurveKind>(number)
                                               : CurveKind::kUnknown;
}

Status TakeVertices(const PlyElement& element,
                    PlyFormat format,
                    std::string_view& body,
                    LineGraph& graph) {
  auto columns = FindScalars(element, {"x", "y", "z", "tx", "ty", "tz"});
  const bool has_tangents = columns.has_value();
  if (!has_tangents) columns = FindScalars(element, {"x", "y", "z"});
  if (!columns) return NoColumns("scalar properties x, y, z of a vertex");
  const std::size_t num_coordinates = columns->size();
  const auto kinds = FindScalars(element, {"kind", "kind_probability"});
  if (kinds) columns->insert(columns->end(), kinds->begin(), kinds->end());
  const auto rows = TakePlyRows(element, format, *columns, body);
  if (!rows.ok()) return rows.status();
  const std::size_t stride = columns->size();
  for (std::size_t i = 0; i < rows->size(); i += stride) {
    graph.positions.emplace_back(Eigen::Vector3d::Map(rows->data() + i));
    if (has_tangents) {
      graph.tangents.emplace_back(Eigen::Vector3d::Map(rows->data() + i + 3));
    }
    if (kinds) {
      const double* const kind = rows->data() + i + num_coordinates;
      graph.kinds.emplace_back(KindFromNumber(kind[0]),
                               static_cast<float>(kind[1]));
    }
  }
  return {};
}

Status TakeEdges(const PlyElement& element,
                 PlyFormat format,
                 std::string_view& body,
                 LineGraph& graph) {
  const auto columns = FindScalars(element, {"vertex1", "vertex2"});
  if (!columns) {
    return NoColumns("scalar properties vertex1, vertex2 of an edge");
  }
  const auto rows = TakePlyRows(element, format, *columns, body);
  if (!rows.ok()) return rows.status();
  for (std::size_t i = 0; i < rows->size(); i += 2) {
    std::array<std::int64_t, 2> edge;
    for (std::size_t k = 0; k < 2; ++k) {
      const double vertex = (*rows)[i + k];
      // What is not a small whole number becomes one that no vertex has.
      const bool whole =
          std::abs(vertex) < 1e15 && std::floor(vertex) == vertex;
      edge[k] = whole ? static_cast<std::int64_t>(vertex) : -1;
    }
    graph.edges.push_back(edge);
  }
  return {};
}

}  // namespace

Result<CurveSet> DecodePlyLines(std::string_view bytes) {
  const Result<PlyHeader> header = TakePlyHeader(bytes);
  if (!header.ok()) return header.status();
  LineGraph graph;
  int num_vertex_elements = 0;
  int num_edge_elements = 0;
  for (const PlyElement& element : header->elements) {
    Status status;
    if (element.name == "vertex" && ++num_vertex_elements == 1) {
      status = TakeVertices(element, header->format, bytes, graph);
    } else if (element.name == "edge" && ++num_edge_elements == 1) {
      status = TakeEdges(element, header->format, bytes, graph);
    } else {
      status = TakePlyRows(element, header->format, {}, bytes).status();
    }
    if (!status.ok()) return status;
  }
  if (num_vertex_elements == 0) return NoColumns("element vertex");
  if (num_edge_elements == 0) return NoColumns("element edge");
  return JoinPolylines(graph);
}

}  // namespace curvix

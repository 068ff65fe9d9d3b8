// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets as PLY; docs/output_format.md.
#include "io/curve_formats.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/bytes.h"
#include "io/curve_style.h"
#include "io/ply_reader.h"
#include "io/polylines.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status NoColumns(const std::string& what) {
  return Status::Unsupported("the PLY has no " + what +
                             ", so it is not a set of lines; a point " +
                             "cloud or a mesh holds no curves");
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
  CURVIX_ASSIGN_OR_RETURN(const auto rows,
                          TakePlyRows(element, format, *columns, body));
  const std::size_t stride = columns->size();
  for (std::size_t i = 0; i < rows.size(); i += stride) {
    graph.positions.emplace_back(Eigen::Vector3d::Map(rows.data() + i));
    if (has_tangents) {
      graph.tangents.emplace_back(Eigen::Vector3d::Map(rows.data() + i + 3));
    }
    if (kinds) {
      const double* const kind = rows.data() + i + num_coordinates;
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
  CURVIX_ASSIGN_OR_RETURN(const auto rows,
                          TakePlyRows(element, format, *columns, body));
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    std::array<std::int64_t, 2> edge;
    for (std::size_t k = 0; k < 2; ++k) {
      const double vertex = rows[i + k];
      // What is not a small whole number becomes one that no vertex has.
      const bool whole =
          std::abs(vertex) < 1e15 && std::floor(vertex) == vertex;
      edge[k] = whole ? static_cast<std::int64_t>(vertex) : -1;
    }
    graph.edges.push_back(edge);
  }
  return {};
}

// `frame`: a comment on it; "": that of the model.
std::string PlyStart(std::string_view frame) {
  if (frame.empty()) frame = "coordinates are those of the COLMAP model";
  return "ply\n"
         "format binary_little_endian 1.0\n"
         "comment curvix: " +
         std::string(frame) + "\nelement vertex ";
}

constexpr std::string_view kPlyGeometry =
    "\n"
    "property float x\n"
    "property float y\n"
    "property float z\n"
    "property float tx\n"
    "property float ty\n"
    "property float tz\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n";
constexpr std::string_view kEndOfHeader = "end_header\n";
constexpr std::size_t kEdgeBytes = 31;  // of edges before they are grouped
constexpr std::size_t kMaxVertices = std::numeric_limits<std::int32_t>::max();

Status TooManyVertices(std::size_t count) {
  return Status::Unsupported(
      "A PLY file names vertices with 32 bits, too few for " +
      std::to_string(count) + " of them; write .txt instead");
}

void AppendVector(const Eigen::Vector3d& vector, std::string& out) {
  for (int i = 0; i < 3; ++i) {
    AppendLittleEndian(static_cast<float>(vector[i]), out);
  }
}

void AppendRgb(const Rgb& rgb, std::string& out) {
  for (const std::uint8_t channel : rgb) AppendLittleEndian(channel, out);
}

// A curve of two samples closes onto the same segment, so it stays open.
bool HasClosingEdge(const Curve& curve) {
  return curve.closed && curve.samples.size() > 2;
}

std::string LinesHeader(std::size_t num_vertices,
                        std::size_t num_edges,
                        bool has_kinds,
                        std::string_view frame) {
  std::string header = PlyStart(frame);
  header += std::to_string(num_vertices);
  header += kPlyGeometry;
  header +=
      "property float curve_id\n"
      "property float confidence\n"
      "property float support\n";
  if (has_kinds) {
    header += "property uchar kind\nproperty float kind_probability\n";
  }
  header += "element edge ";
  header += std::to_string(num_edges);
  header +=
      "\n"
      "property int vertex1\n"
      "property int vertex2\n"
      "end_header\n";
  return header;
}

void AppendVertices(const Curve& curve,
                    std::size_t id,
                    bool has_kinds,
                    std::string& out) {
  const Rgb color = CurveColor(id);
  for (const CurveSample& sample : curve.samples) {
    AppendVector(sample.position, out);
    AppendVector(sample.tangent, out);
    AppendRgb(color, out);
    AppendLittleEndian(static_cast<float>(id), out);
    AppendLittleEndian(Confidence(sample.support.size()), out);
    AppendLittleEndian(static_cast<float>(sample.support.size()), out);
    if (has_kinds) {
      AppendLittleEndian(static_cast<std::uint8_t>(sample.kind), out);
      AppendLittleEndian(sample.kind_probability, out);
    }
  }
}

void AppendEdge(std::size_t from, std::size_t to, std::string& out) {
  AppendLittleEndian(static_cast<std::int32_t>(from), out);
  AppendLittleEndian(static_cast<std::int32_t>(to), out);
}

void AppendEdges(const Curve& curve, std::size_t first, std::string& out) {
  for (std::size_t i = 1; i < curve.samples.size(); ++i) {
    AppendEdge(first + i - 1, first + i, out);
  }
  if (HasClosingEdge(curve)) {
    AppendEdge(first + curve.samples.size() - 1, first, out);
  }
}

std::string EdgesHeader(std::size_t num_edges) {
  std::string header = PlyStart("");
  header += std::to_string(num_edges);
  header += kPlyGeometry;
  header += "property float support\n";
  header += kEndOfHeader;
  return header;
}

// What follows the header in a file of EncodePlyEdges().
Result<std::string_view> FindEdges(std::string_view bytes) {
  const std::size_t end = bytes.find(kEndOfHeader);
  if (end != std::string_view::npos) {
    const std::string_view body = bytes.substr(end + kEndOfHeader.size());
    if (bytes.substr(0, bytes.size() - body.size()) ==
            EdgesHeader(body.size() / kEdgeBytes) &&
        body.size() % kEdgeBytes == 0) {
      return body;
    }
  }
  return Status::DataLoss(
      "it is broken, or was not written by curvix; reconstruct this part "
      "again");
}

Status ForEachEdges(const std::vector<fs::path>& parts, const ByteSink& take) {
  for (const fs::path& part : parts) {
    CURVIX_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(part));
    const Result<std::string_view> edges = FindEdges(bytes);
    if (!edges.ok()) return InFile(part, edges.status());
    take(*edges);
  }
  return {};
}

}  // namespace

Status EncodePlyLines(const CurveSource& curves,
                      std::string_view frame,
                      const ByteSink& sink) {
  std::size_t num_vertices = 0;
  std::size_t num_edges = 0;
  bool has_kinds = false;
  curves.ForEach([&](std::size_t, const Curve& curve) {
    num_vertices += curve.samples.size();
    num_edges += curve.samples.empty() ? 0 : curve.samples.size() - 1;
    num_edges += HasClosingEdge(curve) ? 1 : 0;
    has_kinds = has_kinds || std::ranges::any_of(
                                 curve.samples, [](const CurveSample& sample) {
                                   return sample.kind != CurveKind::kUnknown;
                                 });
  });
  if (num_vertices > kMaxVertices) return TooManyVertices(num_vertices);

  sink(LinesHeader(num_vertices, num_edges, has_kinds, frame));
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    std::string out;
    AppendVertices(curve, id, has_kinds, out);
    sink(out);
  });
  std::size_t first = 0;
  curves.ForEach([&](std::size_t, const Curve& curve) {
    std::string out;
    AppendEdges(curve, first, out);
    first += curve.samples.size();
    sink(out);
  });
  return {};
}

Status EncodePlyEdges(const std::vector<Edge3d>& edges, const ByteSink& sink) {
  if (edges.size() > kMaxVertices) return TooManyVertices(edges.size());
  sink(EdgesHeader(edges.size()));
  for (const Edge3d& edge : edges) {
    std::string out;
    AppendVector(edge.position, out);
    AppendVector(edge.tangent, out);
    AppendRgb(DirectionColor(edge.tangent), out);
    AppendLittleEndian(static_cast<float>(edge.support.size()), out);
    sink(out);
  }
  return {};
}

Status ConcatenatePlyEdges(const fs::path& path,
                           const std::vector<fs::path>& parts) {
  std::size_t num_bytes = 0;
  CURVIX_RETURN_IF_ERROR(ForEachEdges(
      parts, [&](std::string_view edges) { num_bytes += edges.size(); }));
  const std::size_t num_edges = num_bytes / kEdgeBytes;
  if (num_edges > kMaxVertices) return InFile(path, TooManyVertices(num_edges));
  FileWriter file(path);
  file.Append(EdgesHeader(num_edges));
  CURVIX_RETURN_IF_ERROR(ForEachEdges(parts, file.Sink()));
  return file.Finish();
}

Result<CurveSet> DecodePlyLines(std::string_view bytes) {
  CURVIX_ASSIGN_OR_RETURN(const PlyHeader header, TakePlyHeader(bytes));
  LineGraph graph;
  int num_vertex_elements = 0;
  int num_edge_elements = 0;
  for (const PlyElement& element : header.elements) {
    Status status;
    if (element.name == "vertex" && ++num_vertex_elements == 1) {
      status = TakeVertices(element, header.format, bytes, graph);
    } else if (element.name == "edge" && ++num_edge_elements == 1) {
      status = TakeEdges(element, header.format, bytes, graph);
    } else {
      status = TakePlyRows(element, header.format, {}, bytes).status();
    }
    if (!status.ok()) return status;
  }
  if (num_vertex_elements == 0) return NoColumns("element vertex");
  if (num_edge_elements == 0) return NoColumns("element edge");
  return JoinPolylines(graph);
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of stages to and from files, which after
// their head (stage_file.h) hold
//   edges.bin: number of views; per view: number of edges, noise, spacing in
//     pixels (doubles), edges dropped by the mask, as isolated, over the limit
//     (int32 each); per edge: x, y (doubles), angle, strength, sharpness, level
//     (floats), indices of the previous and the next edge (int32, -1: none)
//   sketch.bin: view pairs, edges asked, hypotheses, without support, weaker
//     weaker alternatives, 2D edges used (int64 each); edge sigma in pixels
//     (double); number of 3D edges; per edge: position, tangent (3 doubles
//     each), sigma, evidence (doubles), number of supports, per support view
//     and edge (int32 each)
//   curve_poses.bin: number of views; per view: rotation x, y, z, w and
//     translation (7 doubles); number of cameras; per camera: model, width,
//     height (int32 each), number of parameters, these (doubles); accepted (1
//     byte); length of the reason, its text; counts and doubles in the order of
//     WriteCurvePoses
#include "io/stage_io.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "io/stage_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLinkedEdge2dBytes = kEdge2dBytes + 8;
constexpr std::size_t kEdgeMapBytes = 36;  // without edges
constexpr std::size_t kPoseBytes = 56;

void Put(const Rigid3& pose, ByteWriter& out) {
  for (int i = 0; i < 4; ++i) out.Put(pose.rotation.coeffs()[i]);
  Put(pose.translation, out);
}

Rigid3 TakePose(ByteReader& in) {
  Rigid3 pose;
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = in.Take<double>();
  pose.translation = TakeVector3(in);
  return pose;
}

constexpr std::size_t kMinCameraBytes = 20;

void Put(const Camera& camera, ByteWriter& out) {
  out.Put(static_cast<std::int32_t>(camera.model));
  out.Put(static_cast<std::int32_t>(camera.width));
  out.Put(static_cast<std::int32_t>(camera.height));
  out.PutCount(camera.params.size());
  for (const double param : camera.params) out.Put(param);
}

Camera TakeCamera(ByteReader& in) {
  Camera camera;
  camera.model = static_cast<CameraModel>(in.Take<std::int32_t>());
  camera.width = in.Take<std::int32_t>();
  camera.height = in.Take<std::int32_t>();
  camera.params.resize(in.TakeCount(sizeof(double)));
  for (double& param : camera.params) param = in.Take<double>();
  return camera;
}

void Put(const std::string& text, ByteWriter& out) {
  out.PutCount(text.size());
  for (const char c : text) out.Put(c);
}

std::string TakeText(ByteReader& in) {
  std::string text(in.TakeCount(1), '\0');
  for (char& c : text) c = in.Take<char>();
  return text;
}

// -1: none.
std::optional<std::int32_t> TakeNeighbor(ByteReader& in) {
  const auto edge_idx = in.Take<std::int32_t>();
  if (edge_idx == -1) return std::nullopt;
  return edge_idx;
}

void Put(const EdgeMap& map, ByteWriter& out) {
  out.PutCount(map.edges.size());
  out.Put(map.noise);
  out.Put(map.spacing_px);
  out.Put(map.num_dropped_masked);
  out.Put(map.num_dropped_isolated);
  out.Put(map.num_dropped_over_limit);
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const Edge2d& edge = map.edges[i];
    Put(edge, out);
    out.Put(map.neighbors[i].previous.value_or(-1));
    out.Put(map.neighbors[i].next.value_or(-1));
  }
}

EdgeMap TakeEdgeMap(ByteReader& in) {
  EdgeMap map;
  const std::size_t num_edges = in.TakeCount(kLinkedEdge2dBytes);
  map.noise = in.Take<double>();
  map.spacing_px = in.Take<double>();
  map.num_dropped_masked = in.Take<std::int32_t>();
  map.num_dropped_isolated = in.Take<std::int32_t>();
  map.num_dropped_over_limit = in.Take<std::int32_t>();
  map.edges.resize(num_edges);
  map.neighbors.resize(num_edges);
  for (std::size_t i = 0; i < num_edges; ++i) {
    map.edges[i] = TakeEdge2d(in);
    map.neighbors[i].previous = TakeNeighbor(in);
    map.neighbors[i].next = TakeNeighbor(in);
  }
  return map;
}

}  // namespace

Status WriteEdgeMaps(const fs::path& path,
                     std::uint64_t key,
                     const std::vector<EdgeMap>& edge_maps) {
  ByteWriter out;
  std::size_t num_bytes = sizeof(std::uint64_t);
  for (const EdgeMap& map : edge_maps) {
    num_bytes += kEdgeMapBytes + kLinkedEdge2dBytes * map.edges.size();
  }
  out.Reserve(num_bytes);
  out.PutCount(edge_maps.size());
  for (const EdgeMap& map : edge_maps) Put(map, out);
  return WriteStage(path, StageKind::kEdgeMaps, key, out.bytes());
}

Result<std::vector<EdgeMap>> ReadEdgeMaps(const fs::path& path,
                                          std::uint64_t key) {
  const Result<std::string> content =
      ReadStage(path, StageKind::kEdgeMaps, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  std::vector<EdgeMap> edge_maps(in.TakeCount(kEdgeMapBytes));
  for (EdgeMap& map : edge_maps) map = TakeEdgeMap(in);
  if (!in.AtEnd()) return BrokenStage(path);
  return edge_maps;
}

Status WriteEdgeSketch(const fs::path& path,
                       std::uint64_t key,
                       const EdgeSketch& sketch) {
  ByteWriter out;
  const SketchCounts& counts = sketch.counts;
  for (const std::int64_t count : {counts.view_pairs,
                                   counts.h1_edges,
                                   counts.hypotheses,
                                   counts.unsupported,
                                   counts.rivals,
                                   counts.used_edges}) {
    out.Put(count);
  }
  out.Put(sketch.edge_sigma_px);
  out.PutCount(sketch.edges.size());
  for (const Edge3d& edge : sketch.edges) PutEdge(edge, out);
  return WriteStage(path, StageKind::kEdgeSketch, key, out.bytes());
}

Result<EdgeSketch> ReadEdgeSketch(const fs::path& path, std::uint64_t key) {
  const Result<std::string> content =
      ReadStage(path, StageKind::kEdgeSketch, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  EdgeSketch sketch;
  SketchCounts& counts = sketch.counts;
  for (std::int64_t* count : {&counts.view_pairs,
                              &counts.h1_edges,
                              &counts.hypotheses,
                              &counts.unsupported,
                              &counts.rivals,
                              &counts.used_edges}) {
    *count = in.Take<std::int64_t>();
  }
  sketch.edge_sigma_px = in.Take<double>();
  sketch.edges.resize(in.TakeCount(kEdge3dBytes));
  for (Edge3d& edge : sketch.edges) edge = TakeEdge<Edge3d>(in);
  if (!in.AtEnd()) return BrokenStage(path);
  return sketch;
}

Status WriteCurvePoses(const fs::path& path,
                       std::uint64_t key,
                       const CurvePoses& poses) {
  ByteWriter out;
  out.PutCount(poses.cam_from_world.size());
  for (const Rigid3& pose : poses.cam_from_world) Put(pose, out);
  out.PutCount(poses.cameras.size());
  for (const Camera& camera : poses.cameras) Put(camera, out);
  out.Put(static_cast<std::uint8_t>(poses.accepted));
  Put(poses.reason, out);
  for (const std::size_t count : {poses.num_samples,
                                  poses.num_check_samples,
                                  poses.num_check_observations,
                                  poses.num_points,
                                  poses.num_check_points,
                                  poses.num_views_moved,
                                  poses.max_shift_view_idx}) {
    out.PutCount(count);
  }
  for (const double error : {poses.before.mean_px,
                             poses.before.median_px,
                             poses.after.mean_px,
                             poses.after.median_px,
                             poses.points_before.mean_px,
                             poses.points_before.median_px,
                             poses.points_after.mean_px,
                             poses.points_after.median_px,
                             poses.significance,
                             poses.median_shift_px,
                             poses.max_shift_px}) {
    out.Put(error);
  }
  return WriteStage(path, StageKind::kCurvePoses, key, out.bytes());
}

Result<CurvePoses> ReadCurvePoses(const fs::path& path, std::uint64_t key) {
  const Result<std::string> content =
      ReadStage(path, StageKind::kCurvePoses, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  CurvePoses poses;
  poses.cam_from_world.resize(in.TakeCount(kPoseBytes));
  for (Rigid3& pose : poses.cam_from_world) pose = TakePose(in);
  poses.cameras.resize(in.TakeCount(kMinCameraBytes));
  for (Camera& camera : poses.cameras) camera = TakeCamera(in);
  poses.accepted = in.Take<std::uint8_t>() != 0;
  poses.reason = TakeText(in);
  for (std::size_t* count : {&poses.num_samples,
                             &poses.num_check_samples,
                             &poses.num_check_observations,
                             &poses.num_points,
                             &poses.num_check_points,
                             &poses.num_views_moved,
                             &poses.max_shift_view_idx}) {
    *count = static_cast<std::size_t>(in.Take<std::uint64_t>());
  }
  for (double* error : {&poses.before.mean_px,
                        &poses.before.median_px,
                        &poses.after.mean_px,
                        &poses.after.median_px,
                        &poses.points_before.mean_px,
                        &poses.points_before.median_px,
                        &poses.points_after.mean_px,
                        &poses.points_after.median_px,
                        &poses.significance,
                        &poses.median_shift_px,
                        &poses.max_shift_px}) {
    *error = in.Take<double>();
  }
  if (!in.AtEnd() || poses.max_shift_view_idx >= poses.cam_from_world.size()) {
    return BrokenStage(path);
  }
  return poses;
}

}  // namespace curvix

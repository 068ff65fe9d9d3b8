// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "io/stage_file.h"
#include "io/stage_io.h"
#include "tests/invariance/compare_runs.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

constexpr std::uint64_t kKey = 0x123456789abcdef0;

std::vector<EdgeMap> SomeEdgeMaps() {
  std::vector<EdgeMap> maps(3);
  maps[0].noise = 0.1;
  maps[1].spacing_px = 1.3;
  maps[0].num_dropped_isolated = 7;
  maps[2].num_dropped_masked = 3;
  maps[2].fine_variance_gain_px2 = 1.25;
  maps[2].unseen = {{1, 0, 0, 1}, 2, 0.75};
  maps[2].num_dropped_over_limit = 5;
  for (int i = 0; i < 4; ++i) {
    Edge2d edge;
    edge.position = {1.0 / 3 + i, std::nextafter(2.0, 3.0)};
    edge.angle = 0.1F * static_cast<float>(i);
    edge.strength = std::numeric_limits<float>::denorm_min();
    edge.sharpness = -0.3F;
    edge.level = Eigen::half(120.5F);
    edge.crowding = Eigen::half(0.25F);
    edge.fine_px = Eigen::half(-0.125F);
    maps[2].edges.push_back(edge);
    EdgeNeighbors neighbors;
    if (i > 0) neighbors.previous = i - 1;
    if (i < 3) neighbors.next = i + 1;
    maps[2].neighbors.push_back(neighbors);
  }
  return maps;
}

EdgeSketch SomeSketch() {
  EdgeSketch sketch;
  sketch.counts = {1, 2, 3, 4, 5, 6'000'000'000, 7};
  sketch.edge_sigma_px = 0.23;
  for (int i = 0; i < 3; ++i) {
    Edge3d edge;
    edge.position = {i / 3.0, -1e-300, 1e300};
    edge.tangent = {0, 0.6, -0.8};
    edge.sigma = 1e-5;
    edge.evidence = 12.5 * i;
    for (int k = 0; k < i; ++k) edge.support.push_back({2 * k, 5});
    sketch.edges.push_back(edge);
  }
  return sketch;
}

class StageIo : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "stage.bin";
};

TEST_F(StageIo, KnowsTheSizesOfItsParts) {
  EXPECT_EQ(MinBytes<char>(), 1u);
  EXPECT_EQ(MinBytes<EdgeRef>(), 8u);
  EXPECT_EQ(MinBytes<Edge2d>(), 34u);
  EXPECT_EQ(MinBytes<Edge3d>(), 72u);
}

TEST_F(StageIo, GivesEdgeMapsBackBitByBit) {
  const auto maps = SomeEdgeMaps();
  ASSERT_TRUE(WriteStageResult(path_, kKey, maps).ok());
  const auto read = ReadStageResult<std::vector<EdgeMap>>(path_, kKey);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->size(), maps.size());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const EdgeMap& a = maps[i];
    const EdgeMap& b = (*read)[i];
    EXPECT_EQ(a.noise, b.noise);
    EXPECT_EQ(a.spacing_px, b.spacing_px);
    EXPECT_EQ(a.fine_variance_gain_px2, b.fine_variance_gain_px2);
    EXPECT_EQ(a.num_dropped_masked, b.num_dropped_masked);
    EXPECT_EQ(a.num_dropped_isolated, b.num_dropped_isolated);
    EXPECT_EQ(a.num_dropped_over_limit, b.num_dropped_over_limit);
    ASSERT_EQ(a.edges.size(), b.edges.size());
    EXPECT_EQ(a.unseen.cells, b.unseen.cells);
    EXPECT_EQ(a.unseen.num_columns, b.unseen.num_columns);
    EXPECT_EQ(a.unseen.margin_px, b.unseen.margin_px);
    ASSERT_EQ(b.neighbors.size(), b.edges.size());
    for (std::size_t k = 0; k < a.edges.size(); ++k) {
      EXPECT_EQ(a.edges[k].position, b.edges[k].position);
      EXPECT_EQ(a.edges[k].angle, b.edges[k].angle);
      EXPECT_EQ(a.edges[k].strength, b.edges[k].strength);
      EXPECT_EQ(a.edges[k].sharpness, b.edges[k].sharpness);
      EXPECT_EQ(a.edges[k].level, b.edges[k].level);
      EXPECT_EQ(a.edges[k].crowding, b.edges[k].crowding);
      EXPECT_EQ(a.edges[k].fine_px, b.edges[k].fine_px);
      EXPECT_EQ(a.neighbors[k].previous, b.neighbors[k].previous);
      EXPECT_EQ(a.neighbors[k].next, b.neighbors[k].next);
    }
  }
}

TEST_F(StageIo, GivesASketchBackBitByBit) {
  const EdgeSketch sketch = SomeSketch();
  ASSERT_TRUE(WriteStageResult(path_, kKey, sketch).ok());
  const auto read = ReadStageResult<EdgeSketch>(path_, kKey);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->counts.view_pairs, 1);
  EXPECT_EQ(read->counts.unsupported, 4);
  EXPECT_EQ(read->counts.used_edges, 6'000'000'000);
  EXPECT_EQ(read->counts.repeated_views, 7);
  EXPECT_EQ(read->edge_sigma_px, 0.23);
  ExpectIdentical(read->edges, sketch.edges);
}

CurvePoses SomePoses() {
  CurvePoses poses;
  poses.cam_from_world.resize(3);
  poses.cam_from_world[1].rotation =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  poses.cam_from_world[1].translation = {1.0 / 3, -1e-300, 7};
  poses.accepted = true;
  poses.reason = "they are better";
  poses.num_samples = 1;
  poses.num_check_samples = 2;
  poses.num_check_observations = 3;
  poses.before = {0.4, 0.3};
  poses.after = {0.2, 0.1};
  poses.cameras = {{CameraModel::kRadial, 64, 48, {50, 32, 24, -0.1, 1.0 / 3}}};
  poses.num_points = 5;
  poses.num_check_points = 6;
  poses.points_before = {0.8, 0.7};
  poses.points_after = {0.75, 0.65};
  poses.significance = 4.5;
  poses.num_views_moved = 4;
  poses.median_shift_px = 0.5;
  poses.max_shift_px = 0.6;
  poses.max_shift_view_idx = 2;
  return poses;
}

TEST_F(StageIo, GivesPosesBackBitByBit) {
  const CurvePoses poses = SomePoses();
  ASSERT_TRUE(WriteStageResult(path_, kKey, poses).ok());
  const auto read = ReadStageResult<CurvePoses>(path_, kKey);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->cam_from_world.size(), 3u);
  EXPECT_EQ(read->cam_from_world[1].rotation.coeffs(),
            poses.cam_from_world[1].rotation.coeffs());
  EXPECT_EQ(read->cam_from_world[1].translation,
            poses.cam_from_world[1].translation);
  EXPECT_TRUE(read->accepted);
  EXPECT_EQ(read->reason, poses.reason);
  EXPECT_EQ(read->num_samples, 1u);
  EXPECT_EQ(read->num_check_samples, 2u);
  EXPECT_EQ(read->num_check_observations, 3u);
  EXPECT_EQ(read->num_views_moved, 4u);
  EXPECT_EQ(read->max_shift_view_idx, 2u);
  EXPECT_EQ(read->before.mean_px, 0.4);
  EXPECT_EQ(read->before.median_px, 0.3);
  EXPECT_EQ(read->after.mean_px, 0.2);
  EXPECT_EQ(read->after.median_px, 0.1);
  EXPECT_EQ(read->median_shift_px, 0.5);
  EXPECT_EQ(read->max_shift_px, 0.6);
  EXPECT_EQ(read->cameras, poses.cameras);
  EXPECT_EQ(read->num_points, 5u);
  EXPECT_EQ(read->num_check_points, 6u);
  EXPECT_EQ(read->points_before.mean_px, 0.8);
  EXPECT_EQ(read->points_after.median_px, 0.65);
  EXPECT_EQ(read->significance, 4.5);

  CurvePoses broken = poses;
  broken.max_shift_view_idx = 3;
  ASSERT_TRUE(WriteStageResult(path_, kKey, broken).ok());
  EXPECT_EQ(ReadStageResult<CurvePoses>(path_, kKey).status().code(),
            StatusCode::kDataLoss);
}

TEST_F(StageIo, GivesABundleAdjustmentBackBitByBit) {
  const BundleAdjustment adjustment = {
      SomePoses().cam_from_world, {{1.0 / 3, 0, -2}, {1e300, 4, 5}}, "3.8"};
  ASSERT_TRUE(WriteStageResult(path_, kKey, adjustment).ok());
  const auto read = ReadStageResult<BundleAdjustment>(path_, kKey);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->cam_from_world.size(), 3u);
  EXPECT_EQ(read->cam_from_world[1].rotation.coeffs(),
            adjustment.cam_from_world[1].rotation.coeffs());
  EXPECT_EQ(read->cam_from_world[1].translation,
            adjustment.cam_from_world[1].translation);
  EXPECT_EQ(read->positions, adjustment.positions);
  EXPECT_EQ(read->program_version, "3.8");
}

PartResult SomePart() {
  PartResult part;
  part.num_own_edges_2d = 17;
  part.num_core_edges_3d = 5'000'000'000;
  part.curves.resize(2);
  part.curves[0].curve.closed = true;
  CurveSample sample;
  sample.position = {1.0 / 3, -1e-300, 7};
  sample.sigma = 0.1;
  sample.covariance << 1, 0.2, -0.3, 0.2, 5, 1e-300, -0.3, 1e-300, 7;
  sample.support = {{2, 0}, {2, 3}};
  sample.kind = CurveKind::kBoundary;
  sample.kind_probability = 0.7F;
  part.curves[1].curve.samples = {CurveSample(), sample};
  part.curves[1].edges = SomeEdgeMaps()[2].edges;
  return part;
}

TEST_F(StageIo, GivesAPartBackBitByBit) {
  const PartResult part = SomePart();
  ASSERT_TRUE(WritePartResult(path_, kKey, part).ok());
  auto file = PartFile::Open(path_, kKey);
  ASSERT_TRUE(file.ok()) << file.status().message();
  EXPECT_EQ(file->num_own_edges_2d(), 17);
  EXPECT_EQ(file->num_core_edges_3d(), 5'000'000'000);
  ASSERT_EQ(file->num_curves(), 2u);
  // In any order, and after it was closed.
  const auto second = file->Read(1);
  file->Close();
  const auto first = file->Read(0);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_TRUE(first->curve.closed);
  EXPECT_TRUE(first->curve.samples.empty());
  ASSERT_EQ(second->curve.samples.size(), 2u);
  const CurveSample& sample = part.curves[1].curve.samples[1];
  EXPECT_EQ(second->curve.samples[1].kind, sample.kind);
  EXPECT_EQ(second->curve.samples[1].kind_probability, sample.kind_probability);
  EXPECT_EQ(second->curve.samples[1].position, sample.position);
  EXPECT_EQ(second->curve.samples[1].sigma, sample.sigma);
  EXPECT_EQ(second->curve.samples[1].covariance, sample.covariance);
  EXPECT_EQ(second->curve.samples[1].support, sample.support);
  ASSERT_EQ(second->edges.size(), 4u);
  EXPECT_EQ(second->edges[3].position, part.curves[1].edges[3].position);
  EXPECT_EQ(second->edges[3].angle, part.curves[1].edges[3].angle);
}

TEST_F(StageIo, NoticesThatAPartIsBroken) {
  ASSERT_TRUE(WritePartResult(path_, kKey, SomePart()).ok());
  EXPECT_EQ(PartFile::Open(path_, kKey + 1).status().code(),
            StatusCode::kNotFound);
  EXPECT_EQ(PartFile::Open(folder_.path() / "none.bin", kKey).status().code(),
            StatusCode::kNotFound);
  const std::string bytes = *ReadFile(path_);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    folder_.Write("stage.bin", bytes.substr(0, size));
    EXPECT_EQ(PartFile::Open(path_, kKey).status().code(),
              StatusCode::kDataLoss)
        << size;
  }
  folder_.Write("stage.bin", bytes + "x");
  EXPECT_EQ(PartFile::Open(path_, kKey).status().code(), StatusCode::kDataLoss);

  // Gone once it was checked.
  folder_.Write("stage.bin", bytes);
  auto file = PartFile::Open(path_, kKey);
  ASSERT_TRUE(file.ok());
  file->Close();
  folder_.Write("stage.bin", bytes.substr(0, bytes.size() - 1));
  EXPECT_TRUE(file->Read(0).ok());
  EXPECT_EQ(file->Read(1).status().code(), StatusCode::kDataLoss);
  file->Close();
  std::filesystem::remove(path_);
  EXPECT_EQ(file->Read(0).status().code(), StatusCode::kDataLoss);
}

TEST_F(StageIo, FindsNothingUnderAnotherKeyOrKind) {
  ASSERT_TRUE(WriteStageResult(path_, kKey, SomeEdgeMaps()).ok());
  EXPECT_EQ(
      ReadStageResult<std::vector<EdgeMap>>(path_, kKey + 1).status().code(),
      StatusCode::kNotFound);
  EXPECT_EQ(ReadStageResult<EdgeSketch>(path_, kKey).status().code(),
            StatusCode::kNotFound);
  EXPECT_EQ(
      ReadStageResult<std::vector<EdgeMap>>(folder_.path() / "none.bin", kKey)
          .status()
          .code(),
      StatusCode::kNotFound);
}

TEST_F(StageIo, NoticesEveryMissingEnd) {
  ASSERT_TRUE(WriteStageResult(path_, kKey, SomeSketch()).ok());
  const std::string bytes = *ReadFile(path_);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    folder_.Write("stage.bin", bytes.substr(0, size));
    EXPECT_EQ(ReadStageResult<EdgeSketch>(path_, kKey).status().code(),
              StatusCode::kDataLoss)
        << size;
  }
  folder_.Write("stage.bin", bytes + "x");
  EXPECT_FALSE(ReadStageResult<EdgeSketch>(path_, kKey).ok());
}

TEST_F(StageIo, NoticesEveryChangedByte) {
  ASSERT_TRUE(WriteStageResult(path_, kKey, SomeEdgeMaps()).ok());
  const std::string bytes = *ReadFile(path_);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x40);
    folder_.Write("stage.bin", changed);
    EXPECT_FALSE(ReadStageResult<std::vector<EdgeMap>>(path_, kKey).ok()) << i;
  }
}

TEST_F(StageIo, TakesNoMemoryOnTheWordOfACount) {
  ASSERT_TRUE(WriteStageResult(path_, kKey, std::vector<EdgeMap>()).ok());
  std::string bytes = *ReadFile(path_);
  // The number of views; then a checksum that agrees with it.
  bytes.replace(bytes.size() - 8, 8, std::string(8, '\x7f'));
  const std::uint64_t hash =
      HashBytes(std::string_view(bytes).substr(bytes.size() - 8));
  bytes.replace(bytes.size() - 16,
                8,
                std::string(reinterpret_cast<const char*>(&hash), 8));
  folder_.Write("stage.bin", bytes);
  EXPECT_EQ(ReadStageResult<std::vector<EdgeMap>>(path_, kKey).status().code(),
            StatusCode::kDataLoss);
}

TEST_F(StageIo, SaysThatItCannotWrite) {
  const auto nowhere = folder_.path() / "no folder" / "stage.bin";
  EXPECT_EQ(WriteStageResult(nowhere, kKey, std::vector<EdgeMap>()).code(),
            StatusCode::kNotFound);
}

}  // namespace
}  // namespace curvix

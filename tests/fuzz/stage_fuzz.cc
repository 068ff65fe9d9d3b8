// SPDX-License-Identifier: BSD-3-Clause
// The results of stages that later runs go on from: the first character
// chooses the kind. Their checksum is put right, so that what lies behind it is
// reached.
#include <cstring>

#include "base/file_io.h"
#include "io/stage_file.h"
#include "io/stage_io.h"
#include "model/check_input.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

constexpr std::uint64_t kKey = 7;
constexpr std::size_t kSizeAt = 24;
constexpr std::size_t kChecksumAt = 32;
constexpr std::size_t kHeadSize = 40;

void Overwrite(std::string& file, std::size_t at, std::uint64_t value) {
  std::memcpy(&file[at], &value, sizeof(value));
}

std::string WithChecksum(std::string file) {
  if (file.size() < kHeadSize) return file;
  const std::string_view content = std::string_view(file).substr(kHeadSize);
  const std::uint64_t checksum = HashBytes(content);
  Overwrite(file, kSizeAt, content.size());
  Overwrite(file, kChecksumAt, checksum);
  return file;
}

std::vector<EdgeMap> SomeEdgeMaps() {
  EdgeMap map;
  map.edges.resize(2);
  map.edges[1].position = {3, 4};
  map.neighbors = {{std::nullopt, 1}, {0, std::nullopt}};
  return {map, EdgeMap(), map};
}

EdgeSketch SomeSketch() {
  EdgeSketch sketch;
  sketch.edges.resize(2);
  sketch.edges[0].support = {{0, 1}, {2, 0}};
  return sketch;
}

}  // namespace

std::vector<std::string> FuzzSeeds() {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "stage.bin";
  Require(WriteStageResult(path, kKey, SomeEdgeMaps()).ok(), "written");
  std::vector<std::string> seeds = {"0" + *ReadFile(path)};
  Require(WriteStageResult(path, kKey, SomeSketch()).ok(), "written");
  seeds.push_back("1" + *ReadFile(path));
  PartResult part;
  part.curves.resize(2);
  part.curves[1].curve.samples.resize(2);
  part.curves[1].curve.samples[1].support = {{0, 1}, {2, 0}};
  part.curves[1].edges.resize(2);
  Require(WritePartResult(path, kKey, part).ok(), "written");
  seeds.push_back("2" + *ReadFile(path));
  CurvePoses poses;
  poses.cam_from_world.resize(2);
  poses.cameras = {{CameraModel::kRadial, 64, 48, {50, 32, 24, -0.1, 0.1}}};
  poses.reason = "they are";
  Require(WriteStageResult(path, kKey, poses).ok(), "written");
  seeds.push_back("3" + *ReadFile(path));
  return seeds;
}

void FuzzReader(std::string_view bytes) {
  static const TemporaryFolder folder;
  const std::size_t kind = TakeChoice(bytes, 4);
  const auto path = folder.Write("stage.bin", WithChecksum(std::string(bytes)));
  if (kind == 0) {
    const auto edge_maps = ReadStageResult<std::vector<EdgeMap>>(path, kKey);
    RequireSentence(edge_maps.status());
    Scene scene;
    scene.views.resize(3);
    if (edge_maps.ok()) RequireSentence(CheckEdgeMaps(scene, *edge_maps));
  } else if (kind == 3) {
    RequireSentence(ReadStageResult<CurvePoses>(path, kKey).status());
  } else if (kind == 2) {
    auto file = PartFile::Open(path, kKey);
    RequireSentence(file.status());
    for (std::size_t i = 0; file.ok() && i < file->num_curves(); ++i) {
      RequireSentence(file->Read(i).status());
    }
  } else {
    const auto sketch = ReadStageResult<EdgeSketch>(path, kKey);
    RequireSentence(sketch.status());
    if (sketch.ok()) RequireSentence(CheckEdgeSketch(SomeEdgeMaps(), *sketch));
  }
}

}  // namespace curvix

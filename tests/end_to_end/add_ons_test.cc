// SPDX-License-Identifier: BSD-3-Clause
// The add-on for Blender and the macro for FreeCAD, in those programs.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "colmap/colmap_model.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/colmap_text.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kNumViews = 12;

// One run for all tests: a small part with lines, arcs and circles. The first
// of its curves gets a kind.
class AddOns : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = kNumViews;
    options.width = 200;
    options.height = 200;
    workspace_ = folder_->path() / "proj";
    ASSERT_TRUE(Synthesize(options, workspace_).ok());
    const Outcome outcome =
        RunProgram("--workspace_path " + Quoted(workspace_) +
                   " --refiner none --output_formats json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    curves_path_ = workspace_ / "curvix/0/curves.json";
    json curves = json::parse(Read(curves_path_));
    ASSERT_GT(curves["curves"].size(), 1u);
    curves["curves"][0]["kind"] = "crease";
    folder_->Write("proj/curvix/0/curves.json", curves.dump());
    for (const json& curve : curves["curves"]) {
      for (const json& fit : curve["fits"]) {
        ++counts_[curve.value("kind", "unknown")]
                 [fit["kind"].get<std::string>() + "s"];
      }
    }
  }
  static void TearDownTestSuite() { delete folder_; }

  // The primitives by kind of curve and type, under one name.
  static json Counts(const std::string& between) {
    json counts;
    for (const auto& [kind, types] : counts_) {
      for (const auto& [type, count] : types) {
        counts[kind + between + type] = count;
      }
    }
    return counts;
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline fs::path workspace_;
  static inline fs::path curves_path_;
  static inline std::map<std::string, std::map<std::string, int>> counts_;
};

TEST_F(AddOns, BlenderShowsCurvesAndCameras) {
  if (RunInShell("command -v blender").exit_code != 0) {
    GTEST_SKIP() << "no blender";
  }
  const auto model = ReadColmapModel(workspace_ / "sparse/0");
  ASSERT_TRUE(model.ok()) << model.status().message();
  const fs::path text_model = folder_->path() / "text";
  ASSERT_TRUE(WriteTextModel(*model, text_model).ok());
  const Outcome outcome = RunInShell(
      "blender --background --factory-startup --python-exit-code 1 --python " +
      Quoted(Source("tests/end_to_end/import_in_blender.py")) + " -- " +
      Quoted(Source("plugin/blender/curvix_blender.py")) + " " +
      Quoted(curves_path_) + " " + Quoted(text_model) + " " +
      Quoted(workspace_ / "images") + " 2>&1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string mark = "\nSEEN ";
  const std::size_t at = outcome.output.find(mark);
  ASSERT_NE(at, std::string::npos) << outcome.output;
  const std::size_t begin = at + mark.size();
  const json seen = json::parse(
      outcome.output.substr(begin, outcome.output.find('\n', begin) - begin));
  EXPECT_EQ(seen["splines"], Counts(" "));
  EXPECT_EQ(seen["cameras"], kNumViews);
  EXPECT_EQ(seen["photographs"], kNumViews);
  EXPECT_LT(seen["pixels_off"], 0.3);
}

TEST_F(AddOns, FreeCadHasEdgesAndSketches) {
  const Outcome outcome = RunInShell(
      "/usr/bin/python3 " +
      Quoted(Source("tests/end_to_end/import_in_freecad.py")) + " " +
      Quoted(Source("plugin/freecad/curvix.FCMacro")) + " " +
      Quoted(curves_path_) + " 2>" + Quoted(folder_->path() / "log"));
  if (outcome.exit_code == kNotInstalled) {
    GTEST_SKIP() << "no freecad-python3";
  }
  ASSERT_EQ(outcome.exit_code, 0) << Read(folder_->path() / "log");
  EXPECT_EQ(json::parse(outcome.output), Counts("_"));
}

}  // namespace
}  // namespace curvix

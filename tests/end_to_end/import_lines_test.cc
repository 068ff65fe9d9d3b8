// SPDX-License-Identifier: BSD-3-Clause
// Lines of other programs become the files of a run.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class ImportLines : public testing::Test {
 protected:
  ImportLines() : workspace_(folder_.path() / "proj") {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 8;
    options.width = options.height = 100;
    EXPECT_TRUE(Synthesize(options, workspace_).ok());
  }

  // Two lines near the origin, which images 1, 2 and 3 show.
  fs::path Tracks() const {
    return folder_.Write("alltracks.txt",
                         "2\n0 3 3\n0 0 0\n0 0 0.25\n1 2 3\n0 0 0\n"
                         "1 2 2\n0 0 0\n0.125 0 0\n1 2\n7 8\n");
  }

  TemporaryFolder folder_;
  fs::path workspace_;
};

TEST_F(ImportLines, AreFittedAndWrittenBesideTheModel) {
  const auto before = Contents(workspace_);
  const Outcome outcome =
      RunProgram("import --format limap --input_path " + Quoted(Tracks()) +
                 " --workspace_path " + Quoted(workspace_) +
                 " --output_formats ply,txt,json,dxf,step,html,colmap");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("2 curves, total length 0.375"));
  const json curves = json::parse(Read(workspace_ / "limap/curves.json"));
  ASSERT_EQ(curves["curves"].size(), 2u);
  for (const json& curve : curves["curves"]) {
    ASSERT_EQ(curve["fits"].size(), 1u);
    EXPECT_EQ(curve["fits"][0]["kind"], "line");
  }
  const json& first = curves["curves"][0];
  EXPECT_EQ(first["fits"][0]["end"], json({0, 0, 0.25}));
  EXPECT_EQ(first["samples"][1]["support"].size(), 3u);
  EXPECT_THAT(Read(workspace_ / "limap/curves.step"), HasSubstr("'curve_1'"));
  EXPECT_TRUE(fs::exists(workspace_ / "limap/viewer.html"));
  EXPECT_FALSE(fs::exists(workspace_ / "limap/project.ini"));
  auto after = Contents(workspace_);
  for (const auto& [name, content] : before) {
    EXPECT_EQ(after[name], content) << name;
  }
}

TEST_F(ImportLines, AreNotOverwritten) {
  const std::string tracks = Tracks();
  const Outcome outcome =
      RunProgram("import --format limap --input_path " + Quoted(tracks) +
                 " --workspace_path " + Quoted(workspace_) + " --output_path " +
                 Quoted(fs::path(tracks).parent_path()));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("among the lines"));
}

TEST_F(ImportLines, AreAlignedByAnotherImport) {
  const std::string folders = " --workspace_path " + Quoted(workspace_);
  const std::string import =
      "import --format limap --input_path " + Quoted(Tracks()) + folders;
  ASSERT_EQ(RunProgram(import).exit_code, 0);
  const Outcome outcome =
      RunProgram("align --distance 0,0,0 0,0,0.25 1 --unit m" + folders +
                 " --output_path " + Quoted(workspace_ / "limap"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("Repeat the 'colmap_curvix import'"));
  EXPECT_THAT(RunProgram(import).output, HasSubstr("total length 1.5 m"));
}

TEST_F(ImportLines, TakeThePlaceOfWhatARunHasWritten) {
  const fs::path results = workspace_ / "curvix/0";
  ASSERT_EQ(RunProgram("--workspace_path " + Quoted(workspace_)).exit_code, 0);
  ASSERT_TRUE(fs::exists(results / "edges.ply"));
  ASSERT_TRUE(fs::exists(results / "project.ini"));
  // As if the run had refined the poses.
  folder_.Write("proj/curvix/0/bundle_adjuster.log", "");
  folder_.Write("proj/curvix/0/sparse/cameras.bin", "");
  json report = json::parse(Read(results / "report.json"));
  report["result"]["files"].push_back("bundle_adjuster.log");
  report["result"]["files"].push_back("sparse/");
  folder_.Write("proj/curvix/0/report.json", report.dump());
  const std::string notes =
      folder_.Write("proj/curvix/0/notes.txt", "mine").string();
  const Outcome outcome =
      RunProgram("import --format limap --input_path " + Quoted(Tracks()) +
                 " --workspace_path " + Quoted(workspace_) + " --output_path " +
                 Quoted(results));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* name :
       {"sparse", "bundle_adjuster.log", "project.ini", "edges.ply"}) {
    EXPECT_FALSE(fs::exists(results / name)) << name;
  }
  EXPECT_EQ(Read(notes), "mine");
}

TEST_F(ImportLines, SayWhichFolderCannotBeUsed) {
  const fs::path loop = folder_.path() / "loop";
  fs::create_symlink(loop, loop);
  const Outcome outcome =
      RunProgram("import --format limap --input_path " + Quoted(Tracks()) +
                 " --workspace_path " + Quoted(workspace_) + " --output_path " +
                 Quoted(loop));
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr(loop.string()));
}

TEST_F(ImportLines, AreNotWrittenThroughALinkThatWasNotNamed) {
  fs::create_directories(folder_.path() / "else");
  fs::create_directory_symlink(folder_.path() / "else", workspace_ / "limap");
  const std::string words = "import --format limap --input_path " +
                            Quoted(Tracks()) + " --workspace_path " +
                            Quoted(workspace_);
  EXPECT_THAT(RunProgram(words).output, HasSubstr("is a link"));
  EXPECT_TRUE(fs::is_empty(folder_.path() / "else"));
  EXPECT_EQ(RunProgram(words + " --normalize 1").exit_code, 2);
}

TEST_F(ImportLines, OfAnotherWorldLeaveNothing) {
  const fs::path obj =
      folder_.Write("far.obj", "v 0 0 900\nv 0 1 900\nl 1 2\n");
  const Outcome outcome =
      RunProgram("import --format line3dpp --input_path " + Quoted(obj) +
                 " --workspace_path " + Quoted(workspace_));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("another world"));
  EXPECT_FALSE(fs::exists(workspace_ / "line3dpp"));
}

}  // namespace
}  // namespace curvix

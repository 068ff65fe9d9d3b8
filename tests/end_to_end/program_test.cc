// SPDX-License-Identifier: BSD-3-Clause
// The built program, as a person calls it, on synthetic workspaces.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "colmap/colmap_model_format.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::string> Names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

// A block, seen by a dozen small photographs.
class ProgramRun : public testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 12;
    options.width = 200;
    options.height = 200;
    const Status status = Synthesize(options, workspace_);
    ASSERT_TRUE(status.ok()) << status.message();
  }

  Outcome RunWorkspace(const std::string& more = "") {
    return RunProgram("--workspace_path '" + workspace_.string() + "' " + more);
  }
  void OverwriteImages(const std::string& bytes) {
    for (const auto& image : fs::directory_iterator(workspace_ / "images")) {
      std::ofstream(image.path(), std::ios::binary) << bytes;
    }
  }

  TemporaryFolder folder_;
  fs::path workspace_ = folder_.path() / "my proj";
  fs::path results_ = workspace_ / "curvix/0";
};

// A 200 x 200 PGM; the decoder looks at the content, not at the name.
std::string BlankImage(char grey) {
  return "P5\n200 200\n255\n" + std::string(40'000, grey);
}

TEST_F(ProgramRun, WritesEveryFileAndLeavesTheInputsAlone) {
  const auto before = Contents(workspace_);
  const Outcome outcome = RunWorkspace();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("Detect edges ... 12 views, "),
                    HasSubstr(" curves"),
                    HasSubstr(results_.string()),
                    HasSubstr("MeshLab")));
  EXPECT_EQ(outcome.output.find('\033'), std::string::npos);
  EXPECT_THAT(Names(results_),
              UnorderedElementsAre("curves.ply",
                                   "curves.obj",
                                   "curves.pcd",
                                   "curves.txt",
                                   "curves.json",
                                   "dimensions.csv",
                                   "viewer.html",
                                   "edges.ply",
                                   "report.json",
                                   "project.ini",
                                   "stages"));
  const json report = json::parse(Read(results_ / "report.json"));
  EXPECT_GT(report["result"]["num_curves"], 0);
  EXPECT_EQ(report["input"]["num_views"], 12);
  EXPECT_EQ(report["result"]["why_empty"], "");

  fs::remove_all(workspace_ / "curvix");
  EXPECT_EQ(Contents(workspace_), before);
}

TEST_F(ProgramRun, FindsTheEdgesOfTheBlock) {
  ASSERT_EQ(RunWorkspace().exit_code, 0);
  const Outcome outcome = RunProgram(
      "evaluate --json --curves_path '" + (results_ / "curves.ply").string() +
      "' --truth_path '" + (workspace_ / "gt.txt").string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json scores = json::parse(outcome.output);
  EXPECT_GT(scores["P10"], 90) << outcome.output;
  EXPECT_GT(scores["Rv10"], 80) << outcome.output;
}

TEST_F(ProgramRun, BlackMasksLeaveNoEdgesAndTheSummarySaysSo) {
  for (const auto& image : fs::directory_iterator(workspace_ / "images")) {
    folder_.Write("masks/" + image.path().filename().string() + ".png",
                  BlankImage('\0'));
  }
  const Outcome outcome =
      RunWorkspace("--mask_path '" + (folder_.path() / "masks").string() + "'");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("Are the masks inverted?"));
  EXPECT_THAT(outcome.output, ContainsRegex("\\([0-9]+\\s+[0-9]{3}\\)"));
}

TEST_F(ProgramRun, ViewsHeldOutShowItsCurves) {
  const auto before = Contents(workspace_);
  const Outcome outcome =
      RunProgram("evaluate --json --holdout_every 4 --workspace_path '" +
                 workspace_.string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json scores =
      json::parse(outcome.output.substr(outcome.output.find('{')));
  EXPECT_EQ(scores["held_out"], 3);
  EXPECT_GT(scores["curves"], 0);
  EXPECT_GT(scores["precision"], 3 * scores["precision_chance"].get<double>());
  for (const char* figure : {"strong_lift", "lines_lift"}) {
    EXPECT_GT(scores[figure], 50) << figure;
  }
  EXPECT_EQ(Contents(workspace_), before);
}

TEST_F(ProgramRun, GivesTheSameBytesAgainAndForAnyNumberOfThreads) {
  std::vector<std::map<std::string, std::string>> results;
  for (const std::string threads : {"1", "2", "3", "8", "8"}) {
    const fs::path output =
        folder_.path() / ("run " + std::to_string(results.size()));
    const Outcome outcome =
        RunWorkspace("--num_threads " + threads + " --output_path '" +
                     output.string() + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    auto contents = Contents(output);
    json report = json::parse(contents["report.json"]);
    report.erase("run");
    contents["report.json"] = report.dump();
    contents.erase("project.ini");  // names the folder and the threads
    results.push_back(std::move(contents));
  }
  EXPECT_THAT(results, testing::Each(results[0]));
}

TEST_F(ProgramRun, TheOrderOfImagesInTheModelMakesNoDifference) {
  const fs::path path = workspace_ / "sparse/0/images.bin";
  std::vector<ColmapImage> images = *ParseImagesBinary(Read(path), "images");
  // Both runs get the same poses to the last bit.
  std::ofstream(path, std::ios::binary) << FormatImagesBinary(images);
  ASSERT_EQ(RunWorkspace("--clean").exit_code, 0);
  const std::string expected = Read(results_ / "curves.ply");
  std::vector<std::uint32_t> ids;
  for (const ColmapImage& image : images) ids.push_back(image.image_id);
  std::reverse(images.begin(), images.end());
  for (std::size_t i = 0; i < images.size(); ++i) images[i].image_id = ids[i];
  std::ofstream(path, std::ios::binary) << FormatImagesBinary(images);
  ASSERT_EQ(RunWorkspace("--clean").exit_code, 0);
  EXPECT_EQ(Read(results_ / "curves.ply"), expected);
}

TEST_F(ProgramRun, TheProjectFileRepeatsTheRun) {
  ASSERT_EQ(RunWorkspace("--Validation.max_angle_deg 12").exit_code, 0);
  const auto first = Contents(results_);
  const fs::path project = folder_.path() / "saved.ini";
  fs::copy_file(results_ / "project.ini", project);
  fs::remove_all(workspace_ / "curvix");
  const Outcome outcome =
      RunProgram("--project_path '" + project.string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const auto& [name, bytes] : Contents(results_)) {
    if (name == "report.json") continue;  // holds the seconds
    EXPECT_EQ(bytes, first.at(name)) << name;
  }
}

TEST_F(ProgramRun, ExplainsWhyBlankImagesGiveNoCurves) {
  OverwriteImages(BlankImage('\xff'));
  const Outcome outcome = RunWorkspace();
  EXPECT_EQ(outcome.exit_code, 5) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("No curves: "), HasSubstr("0 edges")));
  EXPECT_THAT(Names(results_),
              UnorderedElementsAre("report.json", "project.ini", "stages"));
  const json report = json::parse(Read(results_ / "report.json"));
  EXPECT_EQ(report["result"]["num_curves"], 0);
  EXPECT_NE(report["result"]["why_empty"], "");
}

TEST_F(ProgramRun, AFailureKeepsEarlierResults) {
  ASSERT_EQ(RunWorkspace().exit_code, 0);
  const auto before = Contents(workspace_ / "curvix");
  OverwriteImages("no image");
  const Outcome outcome = RunWorkspace();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("view_0"));
  EXPECT_EQ(Contents(workspace_ / "curvix"), before);
}

TEST_F(ProgramRun, NoFileOfTheRunBeforeStays) {
  ASSERT_EQ(RunWorkspace("--output_formats ply,dxf,colmap").exit_code, 0);
  std::ofstream(results_ / "curves.obj") << "# of somebody else\n";
  const auto names = [&] {
    auto files = Names(results_);
    std::erase(files, "edges.ply");
    std::erase(files, "report.json");
    std::erase(files, "stages");
    return files;
  };
  EXPECT_THAT(names(),
              UnorderedElementsAre("curves.ply",
                                   "curves.dxf",
                                   "curves.obj",
                                   "curves_model",
                                   "project.ini"));
  ASSERT_EQ(RunWorkspace("--output_formats txt").exit_code, 0);
  EXPECT_THAT(names(),
              UnorderedElementsAre("curves.txt", "curves.obj", "project.ini"));
  ASSERT_EQ(RunWorkspace("--CurveFilter.min_length_px 9000").exit_code, 5);
  EXPECT_THAT(names(), UnorderedElementsAre("curves.obj", "project.ini"));
}

TEST_F(ProgramRun, ReplacesNoFolderThatNoRunWrote) {
  const fs::path mine = results_ / "sparse/0/images.bin";
  fs::create_directories(mine.parent_path());
  std::ofstream(mine) << "mine";
  const Outcome outcome = RunWorkspace();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("which no earlier run wrote"));
  EXPECT_EQ(Read(mine), "mine");
}

TEST_F(ProgramRun, GoesOnFromTheStagesThatALateOptionLeavesAsTheyWere) {
  const auto resumed = [&](const std::string& more) {
    const Outcome outcome = RunWorkspace(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const json report = json::parse(Read(results_ / "report.json"));
    return report["run"]["resumed_stages"].get<std::vector<std::string>>();
  };
  const std::string late = "--CurveRefinement.smoothing_px 2";
  const std::string middle = "--Validation.max_angle_deg 14";
  EXPECT_THAT(resumed(""), IsEmpty());
  EXPECT_THAT(
      resumed(late),
      ElementsAre("detect_edges", "refine_poses_with_curves", "sketch_edges"));
  auto from_stages = Contents(results_);
  EXPECT_THAT(resumed(late + " --clean"), IsEmpty());
  EXPECT_FALSE(fs::exists(results_ / "stages"));
  auto from_scratch = Contents(results_);
  std::erase_if(from_stages, [](const auto& file) {
    return file.first.rfind("stages", 0) == 0;
  });
  // All but the seconds.
  json report1 = json::parse(from_stages["report.json"]);
  json report2 = json::parse(from_scratch["report.json"]);
  report1.erase("run");
  report2.erase("run");
  EXPECT_EQ(report1, report2);
  from_stages.erase("report.json");
  from_scratch.erase("report.json");
  EXPECT_EQ(from_stages, from_scratch);

  EXPECT_THAT(resumed(""), IsEmpty());
  EXPECT_THAT(resumed(middle), ElementsAre("detect_edges"));
  EXPECT_THAT(resumed("--EdgeDetection.sigma_px 1.1"), IsEmpty());
}

TEST_F(ProgramRun, DoesNotGoOnFromOtherOrBrokenStages) {
  const auto resumed = [&] {
    EXPECT_EQ(RunWorkspace().exit_code, 0);
    const json report = json::parse(Read(results_ / "report.json"));
    return report["run"]["resumed_stages"].size();
  };
  EXPECT_EQ(resumed(), 0u);
  EXPECT_EQ(resumed(), 3u);
  fs::resize_file(results_ / "stages/sketch.bin", 1000);
  EXPECT_EQ(resumed(), 2u);
  fs::resize_file(results_ / "stages/curve_poses.bin", 100);
  EXPECT_EQ(resumed(), 2u);
  const fs::path image = fs::directory_iterator(workspace_ / "images")->path();
  fs::last_write_time(image, fs::file_time_type::clock::now());
  EXPECT_EQ(resumed(), 0u);
}

TEST_F(ProgramRun, RefusesBrokenInputWithoutATrace) {
  fs::resize_file(workspace_ / "sparse/0/images.bin", 100);
  const auto before = Contents(workspace_);
  const Outcome outcome = RunWorkspace();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("ERROR"), HasSubstr("images.bin")));
  EXPECT_EQ(Contents(workspace_), before);
}

TEST_F(ProgramRun, DoesNotWriteAmongTheInputs) {
  const auto before = Contents(workspace_);
  for (const char* input : {"sparse/0", "images", "", "sparse"}) {
    const std::string path = (workspace_ / input).string();
    const Outcome outcome = RunWorkspace("--output_path '" + path + "/'");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.output, HasSubstr("--output_path"));
  }
  EXPECT_EQ(Contents(workspace_), before);
}

TEST_F(ProgramRun, LeavesNothingWhenInterrupted) {
  const auto before = Contents(workspace_);
  const std::string path = workspace_.string();
  const std::vector<const char*> arguments = {
      CURVIX_PROGRAM, "--workspace_path", path.c_str(), "--clean", nullptr};
  pid_t child = 0;
  ASSERT_EQ(posix_spawn(&child,
                        CURVIX_PROGRAM,
                        nullptr,
                        nullptr,
                        const_cast<char* const*>(arguments.data()),
                        environ),
            0);
  // The folder appears when the work begins.
  for (int i = 0; i < 10000 && !fs::exists(workspace_ / "curvix"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(Contents(workspace_), before);
}

}  // namespace
}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_report.h"

#include <nlohmann/json.hpp>

#include "base/option_table.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/base/command_line.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Two stages, three views, one closed square of side two and one segment.
RunRecord Example() {
  RunRecord record;
  record.settings.workspace_path = "proj";
  record.settings.options.validation.max_angle_deg = 12.5;
  record.input.camera_models = {"OPENCV"};
  record.input.num_views = 3;
  record.input.missing_images = {"gone.png"};
  record.input.notes = {"One of four images is missing."};
  CurveSet curves;
  curves.curves.resize(2);
  curves.curves[0].closed = true;
  for (const auto& [x, y] : {std::pair(0., 0.), {2., 0.}, {2., 2.}, {0., 2.}}) {
    curves.curves[0].samples.push_back({{x, y, 0}, {1, 0, 0}, 0, 0, {}});
  }
  curves.curves[1].samples = {{{0, 0, 0}, {1, 0, 0}, 0, 0, {}},
                              {{0, 0, 3}, {1, 0, 0}, 0, 0, {}}};
  record.result = SummarizeCurves(curves);
  record.result.num_edges_2d = 171204;
  record.result.num_edges_3d = 5;
  record.result.output_path = "proj/curvix/0";
  record.result.files = {"curves.ply", "report.json"};
  record.stages = {{"detect_edges", 3.1, 6.0, 120, {{"edges", 171204}}},
                   {"connect", 0.1, 0.2, 130, {{"curves", 2}, {"short", 7}}}};
  record.total = {"total", 3.3, 6.3, 130, {}};
  return record;
}

TEST(SummarizeCurves, CountsAndMeasures) {
  const ResultSummary result = Example().result;
  EXPECT_EQ(result.num_curves, 2);
  EXPECT_EQ(result.num_closed, 1);
  EXPECT_EQ(result.num_samples, 6);
  EXPECT_EQ(result.total_length, 8 + 3);
}

TEST(ReportJson, HoldsEveryOptionAsUsed) {
  RunRecord record = Example();
  const json report = json::parse(ReportJson(record));
  for (const OptionRow& row : OptionTable(record.settings.options)) {
    if (row.section.empty()) continue;
    EXPECT_TRUE(report["options"][row.section].contains(row.name)) << row.name;
  }
  EXPECT_EQ(report["options"]["Validation"]["max_angle_deg"], 12.5);
  EXPECT_EQ(report["options"]["Hypotheses"]["view_selection"], "every_view");
  EXPECT_EQ(report["program"]["version"], std::string(ProgramVersion()));
}

TEST(ReportJson, HoldsTheInputTheStagesAndTheResult) {
  const json report = json::parse(ReportJson(Example()));
  EXPECT_EQ(report["input"]["num_views"], 3);
  EXPECT_EQ(report["input"]["camera_models"][0], "OPENCV");
  EXPECT_EQ(report["input"]["missing_images"][0], "gone.png");
  EXPECT_EQ(report["input"]["notes"][0], "One of four images is missing.");
  EXPECT_EQ(report["stages"][1]["name"], "connect");
  EXPECT_EQ(report["stages"][1]["counts"]["short"], 7);
  EXPECT_EQ(report["result"]["num_curves"], 2);
  EXPECT_EQ(report["result"]["total_length"], 11.0);
  EXPECT_EQ(report["run"]["stages"][0]["wall_seconds"], 3.1);
  EXPECT_EQ(report["run"]["peak_memory_mb"], 130.0);
  EXPECT_EQ(report["run"]["parallelism"], 1.909);  // 6.3 / 3.3
  EXPECT_EQ(report["run"]["stages"][1]["parallelism"], 2.0);
}

TEST(ReportJson, HasNoParallelismOfAStageThatTookNoTime) {
  RunRecord record = Example();
  record.stages[0].wall_seconds = 0;
  const json report = json::parse(ReportJson(record));
  EXPECT_EQ(report["run"]["stages"][0]["parallelism"], 0.0);
}

TEST(ReportJson, DiffersBetweenEqualJobsOnlyUnderRun) {
  RunRecord slow = Example();
  slow.settings.options.runtime.num_threads = 3;
  slow.total.wall_seconds = 99;
  for (StageReport& stage : slow.stages) {
    stage.wall_seconds += 10;
    stage.cpu_seconds += 10;
    stage.peak_memory_mb += 10;
  }
  json a = json::parse(ReportJson(Example()));
  json b = json::parse(ReportJson(slow));
  EXPECT_NE(a, b);
  a.erase("run");
  b.erase("run");
  EXPECT_EQ(a, b);
}

TEST(ReportJson, SurvivesNamesThatAreNotUtf8) {
  RunRecord record = Example();
  record.input.missing_images = {"caf\xe9.png"};
  EXPECT_TRUE(json::accept(ReportJson(record)));
}

// Results, and images beside their workspace or wherever `image_path` is.
class EarlierImages : public testing::Test {
 protected:
  EarlierImages() {
    for (const char* name : {"old/photos", "new/photos", "new/in/images"}) {
      std::filesystem::create_directories(At(name));
    }
  }
  std::filesystem::path At(const std::string& name) const {
    return folder_.path() / name;
  }
  // By a report of a run with these paths, for the workspace new/in.
  std::filesystem::path Found(const json& input) const {
    folder_.Write("report.json", json{{"input", input}}.dump());
    return ImagesOfEarlierRun(folder_.path(), At("new/in"));
  }

  TemporaryFolder folder_;
};

TEST_F(EarlierImages, MoveWithTheirWorkspaceOrStay) {
  const auto found = [&](const std::string& images, const std::string& own) {
    return Found({{"image_path", images}, {"workspace_path", own}});
  };
  const std::string photos = At("old/photos").string();
  EXPECT_EQ(found(photos, At("old/in")), At("new/photos"));
  EXPECT_EQ(found("/gone/in/images", "/gone/x/../in/."), At("new/in/images"));
  EXPECT_EQ(found(photos, "/gone/in"), photos);
  EXPECT_EQ(found("/gone/photos", "/gone/a/in"), "");
  // As it was written, if nothing has moved.
  for (const char* place : {"new/in/../photos/", "new/in", "new/in/"}) {
    const std::string written = At(place).string();
    EXPECT_EQ(found(written, At("new/in")), written);
  }
}

TEST_F(EarlierImages, AreNotThereWithoutAWholeReport) {
  const std::string photos = At("old/photos").string();
  const std::string own = At("old/in").string();
  EXPECT_EQ(Found({{"image_path", photos}}), "");
  EXPECT_EQ(Found({{"workspace_path", own}}), "");
  for (const json& wrong : {json(), json(3), json(""), json(".")}) {
    EXPECT_EQ(Found({{"image_path", wrong}, {"workspace_path", own}}), "");
    EXPECT_EQ(Found({{"image_path", photos}, {"workspace_path", wrong}}), "");
  }
  EXPECT_EQ(Found({}), "");
  folder_.Write("report.json", "[");
  EXPECT_EQ(ImagesOfEarlierRun(folder_.path(), At("new/in")), "");
  EXPECT_EQ(ImagesOfEarlierRun(At("new"), At("new/in")), "");
}

TEST(ProjectFile, ReadsBackAsTheSameSettings) {
  RunSettings written = Example().settings;
  written.preset = "paper";
  written.options = PaperOptions();
  written.options.runtime.num_threads = 2;
  written.options.edge_detection.sigma_px = 1.25;
  written.output = {{"ply", "dxf"}, "view_003.png", 4};

  const TemporaryFolder folder;
  const auto path = folder.Write("project.ini", ProjectFile(written));
  RunSettings read;
  std::filesystem::path project_path;
  std::vector<FlagSection> sections = OptionSections(read.options);
  sections.push_back({"",
                      {PathFlag("workspace_path", &read.workspace_path, ""),
                       PathFlag("project_path", &project_path, ""),
                       ChoiceFlag("preset", {"paper"}, &read.preset, "")}});
  sections.push_back(PoseRefinementFlags(&read.poses));
  sections.push_back(OutputFlags(&read.output));
  const auto request = ParseFlags({"--project_path", path.string()}, sections);
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(ProjectFile(read), ProjectFile(written));
}

TEST(SummaryText, TellsWhatWasFoundAndWhereItIs) {
  EXPECT_THAT(SummaryText(Example()),
              AllOf(HasSubstr("2 curves (1 closed), total length 11"),
                    HasSubstr("3 views, 171 204 edges and 5 3D edges"),
                    HasSubstr("3.3 s"),
                    HasSubstr("proj/curvix/0"),
                    HasSubstr("curves.ply"),
                    HasSubstr("MeshLab")));
}

TEST(SummaryText, SaysWhetherSigmaOf2dEdgesIsTheLeast) {
  RunRecord record = Example();
  record.result.edge_sigma_px =
      record.settings.options.hypotheses.EdgeSigmaPx();
  EXPECT_THAT(SummaryText(record),
              HasSubstr("2D edges are taken to be 0.15 px off"));
  record.result.edge_sigma_px = 0.31;
  EXPECT_THAT(SummaryText(record), HasSubstr("2D edges are 0.31 px off"));
}

TEST(SummaryText, ExplainsAnEmptyResult) {
  RunRecord record = Example();
  record.result.num_curves = 0;
  record.result.why_empty = "No view shows an edge.";
  record.stages.push_back({"write_files", 0.1, 0.1, 130, {}});
  record.result.files = {"report.json"};
  EXPECT_THAT(SummaryText(record),
              AllOf(HasSubstr("No curves: No view shows an edge."),
                    HasSubstr("171 204 edges"),
                    HasSubstr("7 short"),
                    HasSubstr("report.json"),
                    Not(HasSubstr("write_files")),
                    Not(HasSubstr("curves.ply"))));
}

}  // namespace
}  // namespace curvix

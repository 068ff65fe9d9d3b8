// SPDX-License-Identifier: BSD-3-Clause
// Every file that the program writes, opened by readers of others.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"
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
using testing::HasSubstr;

bool IsInstalled(const std::string& program) {
  return RunInShell("command -v " + program).exit_code == 0;
}

// One run for all tests: a lathe-turned part in a dozen small photographs, one
// of which has a name that is out to break pages and files.
class Formats : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 12;
    options.width = 200;
    options.height = 200;
    const fs::path workspace = folder_->path() / "proj";
    ASSERT_TRUE(Synthesize(options, workspace).ok());
    RenameFirstImage(workspace);
    results_ = folder_->path() / "out";
    const Outcome outcome = RunInShell(
        std::string("'") + CURVIX_PROGRAM + "' --workspace_path " +
        Quoted(workspace) + " --output_path " + Quoted(results_) +
        " --refiner none --write_overlays 3"
        " --output_formats "
        "ply,obj,pcd,txt,json,csv,dxf,step,vtp,glb,svg,colmap,html 2>&1");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    report_ = json::parse(Read(results_ / "report.json"));
  }
  static void TearDownTestSuite() { delete folder_; }

  static void RenameFirstImage(const fs::path& workspace) {
    const fs::path model_path = workspace / "sparse/0";
    auto model = ReadColmapModel(model_path);
    ASSERT_TRUE(model.ok()) << model.status().message();
    const std::string old_name = model->images[0].name;
    model->images[0].name = kEvilName;
    fs::rename(workspace / "images" / old_name,
               workspace / "images" / kEvilName);
    fs::remove_all(model_path);
    ASSERT_TRUE(WriteColmapModel(*model, model_path).ok());
  }

  static int NumCurves() { return report_["result"]["num_curves"]; }
  // Primitives of all curves.
  static int NumFits() {
    const json curves = json::parse(Read(results_ / "curves.json"));
    int count = 0;
    for (const json& curve : curves["curves"]) {
      count += static_cast<int>(curve["fits"].size());
    }
    return count;
  }

  // What read_file.py counts; -1 if its reader is not installed.
  static int Count(const std::string& format, const std::string& more = "") {
    const Outcome outcome = RunInShell(
        "/usr/bin/python3 '" + Source("tests/end_to_end/read_file.py") + "' " +
        format + " " + Quoted(results_ / ("curves." + format)) + " " + more);
    if (outcome.exit_code == kNotInstalled) return -1;
    EXPECT_EQ(outcome.exit_code, 0) << format;
    return outcome.exit_code == 0 ? std::stoi(outcome.output) : 0;
  }

  // What viewer_probe.js saw in a browser with these flags.
  static json ProbeViewer(const std::string& flags) {
    const std::string end = "</body>";
    std::string page = Read(results_ / "viewer.html");
    page.insert(page.rfind(end),
                "<script>" + Read(Source("tests/end_to_end/viewer_probe.js")) +
                    "</script>");
    const fs::path path = folder_->Write("probed.html", page);
    const Outcome outcome = RunInShell(
        "timeout 60 chromium --headless --no-sandbox --window-size=1200,800 "
        "--virtual-time-budget=3000 --user-data-dir=" +
        Quoted(folder_->path() / "chromium") + " " + flags +
        " --dump-dom file://" + path.string() + " 2>/dev/null");
    const std::string mark = "PROBE";
    const std::size_t begin = outcome.output.rfind("id=\"probe\"");
    if (begin == std::string::npos) return {{"error", "not at its end"}};
    const std::size_t from = outcome.output.find(mark, begin) + mark.size();
    return json::parse(
        outcome.output.substr(from, outcome.output.find(mark, from) - from));
  }

  static constexpr char kEvilName[] = "a b'<script>alert(1)<!--&quot;\xff.png";
  static inline TemporaryFolder* folder_ = nullptr;
  static inline fs::path results_;
  static inline json report_;
};

TEST_F(Formats, JsonKeepsToItsSchema) {
  const int count =
      Count("json", "'" + Source("docs/curves.schema.json") + "'");
  if (count < 0) GTEST_SKIP() << "no python3-jsonschema";
  EXPECT_EQ(count, NumCurves());
}

TEST_F(Formats, AWrongImageOfTheSvgIsFoundBeforeTheRun) {
  const fs::path output = folder_->path() / "no_image";
  const std::string words = "--workspace_path " +
                            Quoted(folder_->path() / "proj") +
                            " --output_path " + Quoted(output) +
                            " --svg_image none.png --refiner none";
  const Outcome outcome = RunProgram(words + " --output_formats ply,svg");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(
      outcome.output,
      AllOf(
          HasSubstr("svg_image is none.png, which is no image of the model; "),
          HasSubstr(" is one.")));
  EXPECT_FALSE(fs::exists(output)) << "stages/ of a run";
  EXPECT_EQ(RunProgram(words + " --output_formats ply").exit_code, 0);
}

TEST_F(Formats, PythonExampleListsTheCurves) {
  if (RunInShell("/usr/bin/python3 -c 'import numpy' 2>&1").exit_code != 0) {
    GTEST_SKIP() << "no python3-numpy";
  }
  const Outcome outcome =
      RunInShell("/usr/bin/python3 '" + Source("examples/04_read_curves.py") +
                 "' " + Quoted(results_ / "curves.json") + " 2>&1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output,
              HasSubstr(std::to_string(NumCurves()) + " curves, "));
  EXPECT_THAT(outcome.output, HasSubstr("  line, length "));
}

TEST_F(Formats, DxfPassesAnAudit) {
  const int count = Count("dxf", Quoted(results_ / "curves.json"));
  if (count < 0) GTEST_SKIP() << "no python3-ezdxf";
  EXPECT_EQ(count, NumFits());
}

TEST_F(Formats, FreeCadReadsStep) {
  const int count = Count("step", Quoted(results_ / "curves.json"));
  if (count < 0) GTEST_SKIP() << "no freecad-python3";
  EXPECT_EQ(count, NumFits());
}

TEST_F(Formats, VtkReadsVtp) {
  const int count = Count("vtp");
  if (count < 0) GTEST_SKIP() << "no python3-vtk9";
  EXPECT_EQ(count, NumCurves());
}

TEST_F(Formats, VtkReadsGlb) {
  const int count = Count("glb");
  if (count < 0) GTEST_SKIP() << "no python3-vtk9";
  EXPECT_EQ(count, NumCurves());
}

TEST_F(Formats, SvgIsXmlWithAPathPerCurve) {
  EXPECT_EQ(Count("svg"), NumCurves());
}

TEST_F(Formats, ColmapModelHasATrackPerSample) {
  const auto model = ReadColmapModel(results_ / "curves_model");
  ASSERT_TRUE(model.ok()) << model.status().message();
  EXPECT_EQ(model->images.size(), 12u);
  EXPECT_GT(model->points.size(), 100u);
  for (const ColmapPoint3D& point : model->points) {
    EXPECT_GE(point.track.size(), 2u);
    EXPECT_LT(point.error, 2);
  }
  if (!IsInstalled("colmap")) GTEST_SKIP() << "no colmap";
  const Outcome outcome =
      RunInShell("colmap model_analyzer --path " +
                 Quoted(results_ / "curves_model") + " 2>&1");
  EXPECT_THAT(outcome.output,
              HasSubstr("Points: " + std::to_string(model->points.size())));
}

TEST_F(Formats, OverlaysAreAsManyAsAskedFor) {
  int count = 0;
  for (const auto& file : fs::directory_iterator(results_ / "overlays")) {
    EXPECT_EQ(file.path().extension(), ".png");
    EXPECT_EQ(Read(file).substr(1, 3), "PNG");
    ++count;
  }
  EXPECT_EQ(count, 3);
}

TEST_F(Formats, ViewerLetsNothingInOrOut) {
  const std::string page = Read(results_ / "viewer.html");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; "));
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("three.js authors"));
}

TEST_F(Formats, ViewerWorksInABrowser) {
  if (!IsInstalled("chromium")) GTEST_SKIP() << "no chromium";
  const json seen = ProbeViewer(
      "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader");
  ASSERT_EQ(seen["error"], "");
  EXPECT_EQ(seen["missing"], false);
  EXPECT_EQ(seen["total"], std::to_string(NumCurves()));
  EXPECT_EQ(seen["shownAtFirst"], std::to_string(NumCurves()));
  EXPECT_EQ(seen["inside"], true) << "the first view cuts curves off";
  EXPECT_EQ(seen["drawn"], true);
  EXPECT_EQ(seen["drawnNowhere"], false);
  EXPECT_EQ(seen["selectedRight"], true);
  EXPECT_THAT(seen["card"].get<std::string>(), HasSubstr("Photographs"));
  EXPECT_GE(seen["photos"], 1);
  EXPECT_EQ(seen["selectedNothing"], "-1");
  EXPECT_GT(seen["turned"], 0.1);
  EXPECT_LT(seen["zoomed"], 1);
  EXPECT_EQ(seen["shownLongest"], "1");
  EXPECT_EQ(seen["objects"], 1);
  EXPECT_EQ(seen["plyHead"], "ply\n");
  EXPECT_EQ(seen["jsonCurves"], 1);
}

TEST_F(Formats, ViewerMeasuresWhatDimensionsHave) {
  if (!IsInstalled("chromium")) GTEST_SKIP() << "no chromium";
  const json seen = ProbeViewer(
      "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader");
  ASSERT_EQ(seen["error"], "");
  std::ifstream rows(results_ / "dimensions.csv");
  std::string row;
  std::getline(rows, row);
  int count = 0;
  while (std::getline(rows, row)) {
    std::size_t end = 0;  // of the first three fields
    for (int i = 0; i < 3; ++i) end = row.find(',', i > 0 ? end + 1 : 0);
    const json& measured = seen["measures"][row.substr(0, end)];
    ASSERT_FALSE(measured.is_null()) << row;
    double value = 0, sigma = 0;
    ASSERT_EQ(std::sscanf(row.c_str() + end, ",%lf,%lf", &value, &sigma), 2);
    EXPECT_NEAR(measured[0].get<double>(), value, 1e-6 * value + 1e-5) << row;
    EXPECT_NEAR(measured[1].get<double>(), sigma, 1e-3 * sigma) << row;
    ++count;
  }
  EXPECT_GT(count, 20);
  EXPECT_NEAR(seen["lookingDown"], 1, 1e-6);
  EXPECT_LT(seen["rises"], 0.1);
  EXPECT_NEAR(seen["scaleBar"], 1, 1e-3);
  EXPECT_EQ(seen["nodesPicked"], true);
  EXPECT_EQ(seen["command"], true);
  EXPECT_THAT(seen["label"].get<std::string>(), HasSubstr(" \u00b1 "));
  EXPECT_EQ(seen["linesPicked"], 2);
  EXPECT_EQ(seen["coordinates"], true);
  EXPECT_LT(seen["square"], 1e-6);
  EXPECT_EQ(seen["measuringAfterEscape"], false);
  EXPECT_EQ(seen["pickedBesideCamera"], true);
  EXPECT_EQ(seen["pictureSize"], 3000);
  EXPECT_GT(seen["pictureDark"], 3000);
  EXPECT_EQ(seen["pictureCorner"], json({255, 255, 255, 255}));
}

TEST_F(Formats, ViewerSaysThatWebGlIsMissing) {
  if (!IsInstalled("chromium")) GTEST_SKIP() << "no chromium";
  const json seen = ProbeViewer("--disable-3d-apis");
  EXPECT_EQ(seen["error"], "");
  EXPECT_EQ(seen["missing"], true);
  EXPECT_EQ(seen["shownLongest"], "1");
  EXPECT_EQ(seen["objects"], 1);
}

TEST_F(Formats, UnknownOnesAreRefusedWithWhatThereIs) {
  const Outcome outcome =
      RunInShell(std::string("'") + CURVIX_PROGRAM +
                 "' --workspace_path x --output_formats ply,iges 2>&1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("\"iges\""));
  EXPECT_THAT(outcome.output, HasSubstr("dxf"));
}

}  // namespace
}  // namespace curvix

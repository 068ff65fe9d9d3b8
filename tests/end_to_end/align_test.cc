// SPDX-License-Identifier: BSD-3-Clause
// From curves without a unit to millimetres, as a person does it.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "colmap/colmap_model.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/end_to_end/block_test.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Align : public BlockTest {
 protected:
  void SetUp() override {
    BlockTest::SetUp();
    before_ = Curves();
    ASSERT_GE(before_["nodes"].size(), 4u);
  }

  // Switched to the frame of `known`.
  Outcome RunAlign(const std::string& known) { return Run("align " + known); }
  // What it prints to stderr.
  std::string ErrorsOfAlign(const std::string& known) {
    return RunInShell("'" + std::string(CURVIX_PROGRAM) + "' align " + known +
                      " --workspace_path " + Quoted(workspace_) +
                      " 2>&1 >/dev/null")
        .output;
  }

  // A file of the centres of the cameras, after the similarity that is to be
  // found: three times as large, turned about z by 90 degrees, and moved.
  fs::path PositionsFrom(double east) {
    const auto model = ReadColmapModel(workspace_ / "sparse/0");
    EXPECT_TRUE(model.ok());
    std::ostringstream positions;
    positions.precision(17);
    for (const ColmapImage& image : model->images) {
      const Eigen::Vector3d c = image.cam_from_world.Inverse().translation;
      positions << image.name << " " << east - 3 * c.y() << " " << 3 * c.x()
                << " " << 3 * c.z() + 7 << "\n";
    }
    return folder_.Write("positions.txt", positions.str());
  }

  // The first line between two nodes.
  static json FirstLine(const json& curves) {
    for (const json& curve : curves["curves"]) {
      for (const json& fit : curve["fits"]) {
        if (fit["kind"] == "line" && fit["start_node"].is_number() &&
            fit["end_node"].is_number()) {
          return fit;
        }
      }
    }
    return {};
  }

  json before_;
};

TEST_F(Align, AKnownDistanceScalesAllResults) {
  const std::string model = Read(workspace_ / "sparse/0/images.bin");
  const json line = FirstLine(before_);
  ASSERT_FALSE(line.is_null());
  const Outcome outcome =
      RunAlign("--distance " + line["start_node"].dump() + " " +
               line["end_node"].dump() + " 250 --unit mm");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("mm"));
  const json after = Curves();
  EXPECT_NEAR(FirstLine(after)["length"], 250, 1e-6);
  const double scale = after["alignment"]["world_from_model"]["scale"];
  EXPECT_NEAR(scale, 250 / line["length"].get<double>(), 1e-6 * scale);
  const auto& a = before_["curves"][0]["samples"][0];
  const auto& b = after["curves"][0]["samples"][0];
  EXPECT_NEAR(b["sigma"], scale * a["sigma"].get<double>(), 1e-9 * scale);
  EXPECT_EQ(a["support"], b["support"]);
  EXPECT_THAT(Read(results_ / "dimensions.csv"), HasSubstr(",mm\n"));
  EXPECT_THAT(Read(results_ / "curves.ply"),
              HasSubstr("coordinates are those of alignment.json"));
  EXPECT_EQ(Read(workspace_ / "sparse/0/images.bin"), model);

  // Nodes have the numbers they had, and aligning again starts from the model,
  // but for rounding: nodes are read in the unit of the last alignment.
  ASSERT_EQ(RunAlign("--distance " + line["start_node"].dump() + " " +
                     line["end_node"].dump() + " 250 --unit mm")
                .exit_code,
            0);
  const json again = Curves();
  EXPECT_NEAR(
      again["alignment"]["world_from_model"]["scale"], scale, 1e-12 * scale);
  ASSERT_EQ(again["nodes"].size(), after["nodes"].size());
  for (std::size_t i = 0; i < again["nodes"].size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(again["nodes"][i]["position"][axis],
                  after["nodes"][i]["position"][axis],
                  1e-9);
    }
  }
  // Without the alignment, all is as it was.
  fs::remove(results_ / "alignment.json");
  ASSERT_EQ(Run("").exit_code, 0);
  EXPECT_EQ(Curves(), before_);
}

TEST_F(Align, WarnsThatCoordinatesAreThoseOfTheLastAlignment) {
  const std::string warning = "WARNING: The results are aligned already";
  const std::string points = "--distance 0,0,0 0,1,0 5";
  EXPECT_THAT(RunAlign(points).output, Not(HasSubstr(warning)));
  EXPECT_THAT(RunAlign("--distance 0 1 5").output, Not(HasSubstr(warning)));
  EXPECT_THAT(RunAlign("--axes auto").output, Not(HasSubstr(warning)));
  EXPECT_THAT(RunAlign(points).output,
              HasSubstr(warning + ": coordinates after --distance are taken"));
  EXPECT_THAT(
      ErrorsOfAlign("--axes auto --up 0,0,1"),
      AllOf(HasSubstr(warning + ": coordinates after --up are taken"),
            HasSubstr("remove " + (results_ / "alignment.json").string())));
}

TEST_F(Align, WarnsOfAScaleThatIsHardlyKnown) {
  const std::string warning = "WARNING: The scale is hardly known";
  EXPECT_THAT(RunAlign("--distance 0,0,0 0,0.000001,0 5").output,
              HasSubstr(warning));
  EXPECT_THAT(RunAlign("--distance 0 1 5").output, Not(HasSubstr(warning)));
}

TEST_F(Align, TheProjectFileOfARunServesAllThatFollow) {
  const std::string project =
      " --project_path " + Quoted(results_ / "project.ini");
  for (const char* words : {"align --axes auto --num_threads 1",
                            "draw --num_threads 1",
                            "partition",
                            "evaluate --holdout_every 4"}) {
    const Outcome outcome = RunProgram(words + project);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

TEST_F(Align, WritesAgainWhatReconstructWroteBesideAPlanOfParts) {
  ASSERT_EQ(Run("partition").exit_code, 0);
  ASSERT_TRUE(fs::exists(results_ / "parts"));
  const Outcome outcome = RunAlign("--axes auto");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(Curves().contains("alignment"));
}

TEST_F(Align, TheProjectFileOfAMergeRepeatsTheMerge) {
  for (const char* words : {"partition", "reconstruct --part 0", "merge"}) {
    ASSERT_EQ(Run(words).exit_code, 0) << words;
  }
  const json merged = Curves();
  const std::string project =
      "--project_path " + Quoted(results_ / "project.ini");
  const Outcome outcome = RunProgram(project);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("Join parts"));
  EXPECT_EQ(Curves(), merged);
  EXPECT_EQ(RunAlign("--axes auto").exit_code, 0);
  EXPECT_TRUE(Curves().contains("alignment"));
  EXPECT_EQ(RunProgram("draw " + project).exit_code, 0);
}

TEST_F(Align, WorkspacesMayMove) {
  const fs::path moved = folder_.path() / "moved";
  fs::rename(workspace_, moved);
  const Outcome outcome =
      RunProgram("align --axes auto --workspace_path " + Quoted(moved));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_FALSE(fs::exists(workspace_));
  EXPECT_THAT(Read(moved / "curvix/0/curves.json"), HasSubstr("\"alignment\""));
}

TEST_F(Align, StaysAsItWasIfTheResultsCannotBeWrittenAgain) {
  const fs::path alignment = results_ / "alignment.json";
  const fs::path image = workspace_ / "images/view_003.png";
  const std::string bytes = Read(image);
  std::ofstream(image) << "no image";
  ExpectError("align --axes auto", "view_003.png");
  EXPECT_FALSE(fs::exists(alignment));
  EXPECT_EQ(Curves(), before_);

  std::ofstream(image, std::ios::binary) << bytes;
  ASSERT_EQ(RunAlign("--axes auto").exit_code, 0);
  const std::string older = Read(alignment);
  std::ofstream(image) << "no image";
  ExpectError("align --distance 0 1 2", "is as it was before");
  EXPECT_EQ(Read(alignment), older);
}

TEST_F(Align, TellsLargeUncertaintiesWithoutExponents) {
  const Outcome outcome = RunAlign("--distance 0 1 250 500");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(", to 200 %"));
}

TEST_F(Align, DistancesMayBeJoinedToTheirOption) {
  const json line = FirstLine(before_);
  const std::string nodes =
      line["start_node"].dump() + " " + line["end_node"].dump() + " ";
  const Outcome outcome = RunAlign("--distance='" + nodes + "2 0.01' " +
                                   "--distance='" + nodes + "3 0.01'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("What is given contradicts itself"));
}

TEST_F(Align, SaysThatDistancesContradictEachOther) {
  const json line = FirstLine(before_);
  const std::string known = "--distance " + line["start_node"].dump() + " " +
                            line["end_node"].dump() + " ";
  EXPECT_THAT(RunAlign(known + "2 " + known + "2.001 0.01").output,
              Not(HasSubstr("contradicts itself")));
  EXPECT_THAT(ErrorsOfAlign(known + "2 0.01 " + known + "3 0.01"),
              AllOf(HasSubstr("WARNING: What is given contradicts itself"),
                    Not(HasSubstr("another unit"))));
}

TEST_F(Align, SaysThatLengthsAndPositionsContradictEachOther) {
  std::istringstream lines(Read(PositionsFrom(0)));
  std::string with_sigmas;
  for (std::string line; std::getline(lines, line);) {
    with_sigmas += line + " 0.03\n";
  }
  const fs::path path = folder_.Write("positions.txt", with_sigmas);
  const json line = FirstLine(before_);
  const double length = 3 * line["length"].get<double>();
  EXPECT_THAT(
      ErrorsOfAlign("--positions " + Quoted(path) + " --distance " +
                    line["start_node"].dump() + " " + line["end_node"].dump() +
                    " " + std::to_string(1.2 * length)),
      AllOf(HasSubstr("WARNING: What is given contradicts itself"),
            HasSubstr("lengths in another unit than positions")));
}

TEST_F(Align, CamerasWhosePositionsAreKnownGiveEverything) {
  const Outcome outcome =
      RunAlign("--epsg 25832 --positions " + Quoted(PositionsFrom(1000)));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json after = Curves();
  EXPECT_EQ(after["alignment"]["crs"], "EPSG:25832");
  EXPECT_EQ(after["alignment"]["unit"], "m");
  for (std::size_t i = 0; i < before_["nodes"].size(); ++i) {
    const json& a = before_["nodes"][i]["position"];
    const json& b = after["nodes"][i]["position"];
    EXPECT_NEAR(b[0], 1000 - 3 * a[1].get<double>(), 1e-5);
    EXPECT_NEAR(b[1], 3 * a[0].get<double>(), 1e-5);
    EXPECT_NEAR(b[2], 3 * a[2].get<double>() + 7, 1e-5);
  }
}

TEST_F(Align, PositionsThatAreNotOfTheCamerasAreRefused) {
  const fs::path path = PositionsFrom(1000);
  const std::string right = Read(path);
  const std::string command = "--positions " + Quoted(path);
  EXPECT_THAT(RunAlign(command).output, HasSubstr("12 positions, "));

  // The first number of the sixth image has one digit more.
  std::string mistyped = right;
  mistyped.insert(mistyped.find("view_005.png ") + 13, "1");
  std::ofstream(path) << mistyped;
  ExpectError("align " + command, "view_005.png fits worst, by ");
  // The y axis, which is the model's x, the other way.
  std::istringstream words(right);
  std::string name, mirrored;
  for (double x, y, z; words >> name >> x >> y >> z;) {
    for (const auto& word : {name, std::to_string(x), std::to_string(-y)}) {
      mirrored += word + " ";
    }
    mirrored += std::to_string(z) + "\n";
  }
  std::ofstream(path) << mirrored;
  ExpectError("align " + command, "better with x and y swapped");
}

TEST_F(Align, TellsTheOffsetOfLargeCoordinatesWithAllDigits) {
  const Outcome outcome =
      RunAlign("--positions " + Quoted(PositionsFrom(5812350)));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json offset = Curves()["alignment"]["offset"];
  EXPECT_NEAR(offset[0], 5812350, 200);
  EXPECT_THAT(outcome.output,
              HasSubstr("less " + std::to_string(offset[0].get<int>()) + " "));
}

TEST_F(Align, ASinglePositionMakesNoMap) {
  const fs::path path = PositionsFrom(1000);
  const std::string all = Read(path);
  const std::string line = all.substr(0, all.find('\n'));
  const std::string position = "align --positions " + Quoted(path);
  std::ofstream(path) << line << "\n";
  ExpectError(
      position + " --axes auto",
      path.string() + ": The uncertainty of fewer than three positions");
  std::ofstream(path) << line << " 0.1\n" << all.substr(line.size() + 1);
  ExpectError(position + " --axes auto", path.string() + ": Some positions");
  std::ofstream(path) << line << " 0.1\n";
  ExpectError(position + " --axes auto --epsg 25832", "--epsg needs a scale");
  EXPECT_FALSE(fs::exists(results_ / "alignment.json"));
}

#ifdef CURVIX_HAS_GDAL
TEST_F(Align, CodesOfOtherUnitsAndOfNothingAreRefused) {
  ExpectError("align --positions x --epsg 2263", "in the unit US survey foot");
  ExpectError("align --positions x --epsg 4326", "degrees");
  ExpectError("align --positions x --epsg 1025", "GDAL does not know");
  ExpectError("align --positions x --epsg 4978", "not east and north");
}
#endif

TEST_F(Align, AxesOfABlockAreItsEdges) {
  const Outcome outcome = RunAlign("--axes auto");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const json alignment = json::parse(Read(results_ / "alignment.json"));
  // The block's edges are along the axes already, in some order.
  int num_axes = 0;
  for (const json& angle : alignment["sources"]["axes"]["angle_deg"]) {
    EXPECT_NEAR(angle.is_number() ? angle.get<double>() : 90, 90, 0.5);
  }
  const json& q = alignment["world_from_model"]["rotation"];
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    num_axes += turn.col(i).cwiseAbs().maxCoeff() > std::cos(0.1 / 57.3);
  }
  EXPECT_EQ(num_axes, 3);
  EXPECT_GT(turn(2, 2), 0);
  EXPECT_THAT(outcome.output, Not(HasSubstr("look whether they are right")));
}

// Of five lines, three at most leave the axis that most share.
TEST_F(Align, AxesOfFewLinesAreDoubted) {
  json curves = Curves();
  json few = json::array();
  for (const json& curve : curves["curves"]) {
    const json& fits = curve["fits"];
    if (few.size() < 5 && fits.size() == 1 && fits[0]["kind"] == "line") {
      few.push_back(curve);
    }
  }
  ASSERT_EQ(few.size(), 5u);
  curves["curves"] = few;
  std::ofstream(results_ / "curves.json") << curves;
  const Outcome outcome = RunAlign("--axes auto");
  EXPECT_THAT(outcome.output, HasSubstr("look whether they are right"));
}

TEST_F(Align, SaysWhatIsWrongAndChangesNothing) {
  const std::string curves = Read(results_ / "curves.json");
  for (const auto& [words, why] :
       {std::pair("", "something that is known"),
        std::pair("--distance 0 1", "three words"),
        std::pair("--distance 0 100000 3", "no node 100000"),
        std::pair("--distance 1 1 3", "--distance 1 1 3: its two points"),
        std::pair("--markers 4x4_50", "--marker_size"),
        std::pair("--axes auto --marker_size 5", "needs --markers"),
        std::pair("--positions none.txt", "none.txt"),
        std::pair("--axes auto --unit mm", "--unit needs a scale"),
        std::pair("--up 0,0,1", "--axes auto"),
        std::pair("--axes auto --up 0,0,0", "no direction"),
        std::pair("--distance 0 1 1 --epsg 1", "--positions"),
        std::pair("--positions x --epsg 25832 --unit mm", "leave --unit out"),
        std::pair("--positions x --epsg 99999999", "no code of EPSG"),
        std::pair("--positions x --epsg utm", "no code of EPSG")}) {
    ExpectError(std::string("align ") + words, why);
  }
  EXPECT_EQ(Read(results_ / "curves.json"), curves);
  EXPECT_FALSE(fs::exists(results_ / "alignment.json"));
  std::ofstream(results_ / "alignment.json") << "{";
  const Outcome outcome = Run("");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("alignment.json cannot be used"));
}

}  // namespace
}  // namespace curvix

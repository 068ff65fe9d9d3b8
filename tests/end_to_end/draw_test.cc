// SPDX-License-Identifier: BSD-3-Clause
// From curves to drawings to scale, as a person does it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/base/staged_output.h"
#include "tests/end_to_end/block_test.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class Draw : public BlockTest {
 protected:
  // A plan drawn with `option` has a map, drawing_xy with `ending`, of as many
  // curves. A drawing without the option takes it away.
  void CheckMap(const std::string& option,
                const std::string& ending,
                const std::function<std::size_t(const fs::path&)>& num_curves) {
    const std::string words =
        "draw --plane xy --dimensions 1 --" + option + " 1";
    const Outcome outcome = Run(words);
    const fs::path path = results_ / ("drawing_xy" + ending);
#ifdef CURVIX_HAS_GDAL
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    std::size_t num_drawn = 0;
    ASSERT_EQ(std::sscanf(outcome.output.c_str() + outcome.output.find("Drew "),
                          "Drew %zu",
                          &num_drawn),
              1);
    EXPECT_EQ(num_curves(path), num_drawn);
    const std::string bytes = Read(path);
    ASSERT_EQ(Run(words).exit_code, 0);
    EXPECT_EQ(Read(path), bytes);
    ASSERT_EQ(Run("draw --plane xy").exit_code, 0);
#else
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("built without GDAL"));
#endif
    EXPECT_FALSE(fs::exists(path));
  }
};

// Lengths of the lines of a DXF that are not of the frame.
std::vector<double> LineLengths(const std::string& dxf) {
  std::vector<double> lengths;
  std::istringstream lines(dxf.substr(dxf.find("ENTITIES")));
  std::string code, value, type, layer;
  double x[4] = {};
  std::getline(lines, value);
  while (std::getline(lines, code) && std::getline(lines, value)) {
    if (code == "0") {
      if (type == "LINE" && layer != "FRAME") {
        lengths.push_back(std::hypot(x[2] - x[0], x[3] - x[1]));
      }
      type = value;
    }
    if (code == "8") layer = value;
    const std::string codes[4] = {"10", "20", "11", "21"};
    for (int i = 0; i < 4; ++i) {
      if (code == codes[i]) x[i] = std::stod(value);
    }
  }
  return lengths;
}

// What the DIMENSION entities of a DXF say to measure.
std::vector<std::string> StatedLengths(const std::string& dxf) {
  std::vector<std::string> lengths;
  for (std::size_t at = dxf.find("AcDbDimension\n"); at != std::string::npos;
       at = dxf.find("AcDbDimension\n", at + 1)) {
    const std::size_t value = dxf.find("\n42\n", at) + 4;
    lengths.push_back(dxf.substr(value, dxf.find('\n', value) - value));
  }
  return lengths;
}

TEST_F(Draw, DistancesAreThoseOfTheDimensions) {
  json longest;
  const json before = Curves();
  for (const json& curve : before["curves"]) {
    for (const json& fit : curve["fits"]) {
      if (fit["kind"] != "line" || fit["start_node"].is_null() ||
          fit["end_node"].is_null()) {
        continue;
      }
      if (longest.is_null() || fit["length"] > longest["length"]) longest = fit;
    }
  }
  ASSERT_FALSE(longest.is_null());
  ASSERT_EQ(Run("align --axes auto --unit mm --distance " +
                longest["start_node"].dump() + " " +
                longest["end_node"].dump() + " 250")
                .exit_code,
            0);
  const std::map<std::string, int> depth_of = {{"xy", 2}, {"xz", 1}, {"yz", 0}};
  const json curves = Curves();
  std::size_t num_compared = 0;
  for (const auto& [plane, depth] : depth_of) {
    const Outcome outcome =
        Run("draw --dimensions 1 --scale 1:2 --plane " + plane);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("1:2 on A3"));
    const auto drawn =
        LineLengths(Read(results_ / ("drawing_" + plane + ".dxf")));
    const std::string table = Read(results_ / "dimensions.csv");
    const auto stated =
        StatedLengths(Read(results_ / ("drawing_" + plane + ".dxf")));
    EXPECT_GE(stated.size(), 2u) << plane;
    for (const std::string& value : stated) {
      EXPECT_THAT(table, HasSubstr("," + value + ","));
    }
    std::istringstream dimensions(table);
    for (std::string row; std::getline(dimensions, row);) {
      std::size_t curve = 0, fit = 0;
      double length = 0, sigma = 0;
      if (std::sscanf(row.c_str(),
                      "length,line %zu.%zu,,%lf,%lf",
                      &curve,
                      &fit,
                      &length,
                      &sigma) != 4) {
        continue;
      }
      const json& line = curves["curves"][curve]["fits"][fit];
      const auto at = static_cast<std::size_t>(depth);
      const double deep =
          line["end"][at].get<double>() - line["start"][at].get<double>();
      if (std::abs(deep) > 0.02 * length) continue;  // not in the plane
      double nearest = 1e9;
      for (const double other : drawn) {
        nearest = std::min(nearest, std::abs(other - length));
      }
      EXPECT_LT(nearest, deep * deep / length + 1e-9 * length) << row;
      ++num_compared;
    }
  }
  EXPECT_GE(num_compared, 8u);  // four edges or more of two planes
}

TEST_F(Draw, CoordinatesAreThoseOfTheSurvey) {
  json curves = Curves();
  ASSERT_EQ(Run("draw --plane xy").exit_code, 0);
  const auto before = LineLengths(Read(results_ / "drawing_xy.dxf"));
  curves["alignment"] = {
      {"unit", "m"},
      {"crs", "EPSG:25832"},
      {"offset", {400000, 5600000, 100}},
      {"known", {"scale", "rotation", "translation"}},
      {"covariance", json(7, std::vector<double>(7, 0))},
      {"world_from_model",
       {{"scale", 1}, {"rotation", {1, 0, 0, 0}}, {"translation", {0, 0, 0}}}}};
  std::ofstream(results_ / "curves.json") << curves;
#ifdef CURVIX_HAS_GDAL
  ASSERT_EQ(Run("draw --plane xy --geojson 1").exit_code, 0);
  const json map = json::parse(Read(results_ / "drawing_xy.geojson"));
  EXPECT_THAT(map["crs"].dump(), HasSubstr("EPSG::25832"));
  // Mirrored, it is no map.
  ASSERT_EQ(Run("draw --plane xy --from_behind 1 --geojson 1").exit_code, 0);
  EXPECT_FALSE(json::parse(Read(results_ / "drawing_xy_from_behind.geojson"))
                   .contains("crs"));
#endif
  EXPECT_THAT(Run("draw --plane xy --slice=-9,9").output,
              HasSubstr("z of the curves is from "));
  ASSERT_EQ(Run("draw --plane xy --slice 91,109").exit_code, 0);
  const std::string dxf = Read(results_ / "drawing_xy_section.dxf");
  const auto after = LineLengths(dxf);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i], before[i], 1e-8);
  }
  double x = 0, y = 0;
  const std::size_t line = dxf.find("AcDbLine\n");
  ASSERT_EQ(std::sscanf(dxf.c_str() + line, "AcDbLine 10 %lf 20 %lf", &x, &y),
            2);
  EXPECT_NEAR(x, 400000, 2);
  EXPECT_NEAR(y, 5600000, 2);
}

TEST_F(Draw, APhotographLiesBeneath) {
  const Outcome outcome = Run("draw --photograph auto");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("no scale; 1 unit"));
  EXPECT_TRUE(Read(results_ / "drawing_auto.jpg").starts_with("\xff\xd8"));
  EXPECT_THAT(Read(results_ / "drawing_auto.svg"),
              HasSubstr("href=\"drawing_auto.jpg\""));
  EXPECT_THAT(Read(results_ / "drawing_auto.dxf"),
              HasSubstr("drawing_auto.jpg"));
  // A drawing without one takes the old one away.
  ASSERT_EQ(Run("draw").exit_code, 0);
  EXPECT_FALSE(fs::exists(results_ / "drawing_auto.jpg"));
}

TEST_F(Draw, SaysItselfThatAPhotographIsDamaged) {
  std::vector<unsigned char> bytes;
  ASSERT_TRUE(cv::imencode(".tiff", cv::Mat::zeros(40, 40, CV_8UC3), bytes));
  std::string tiff(bytes.begin(), bytes.end());
  // Where the pixels are.
  const std::size_t at = tiff.find(std::string("\x11\1\4\0\1\0\0\0", 8));
  ASSERT_NE(at, tiff.npos);
  tiff[at + 9] = '\x7f';
  for (const auto& file : fs::directory_iterator(workspace_ / "images")) {
    std::ofstream(file.path(), std::ios::binary) << tiff;
  }
  const Outcome outcome = Run("draw --photograph auto");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("Cannot read the image"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("WARN")));
}

TEST_F(Draw, RemovesNoFileThatIsNotOfADrawing) {
  const std::vector<fs::path> files = {results_ / "facade.jpg",
                                       results_ / "facade.gpkg",
                                       results_ / "facade.geojson"};
  for (const fs::path& file : files) std::ofstream(file) << "mine";
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(Run("draw --name facade").exit_code, 0);
    for (const fs::path& file : files) EXPECT_EQ(Read(file), "mine") << file;
  }
}

TEST_F(Draw, OtherResultsTakeDrawingsAway) {
  std::ofstream(results_ / "mine.svg") << "<svg></svg>";
  std::ofstream(results_ / "mine.dxf") << "mine";
  const auto before = Contents(results_);
  ASSERT_EQ(Run("draw --name facade --photograph auto").exit_code, 0);
  ASSERT_EQ(Run("draw --plane xz").exit_code, 0);
  const Outcome outcome = Run("align --axes auto");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("drawing_xz.dxf drawing_xz.svg facade.dxf facade.svg "
                        "facade.jpg;"));
  auto after = Contents(results_);
  EXPECT_EQ(after.erase("alignment.json"), 1u);
  for (const auto& [name, bytes] : after) EXPECT_TRUE(before.contains(name));
  EXPECT_EQ(after.size(), before.size());
}

TEST_F(Draw, APhotographIsRightWhereItsSideIs) {
  fs::remove_all(workspace_);
  SyntheticOptions options;
  options.solid = SyntheticSolid::kBlock;
  options.num_views = 32;  // three or more from each side
  options.width = options.height = 120;
  ASSERT_TRUE(Synthesize(options, workspace_).ok());
  ASSERT_EQ(Run("--output_formats json --refiner none").exit_code, 0);
  // Many lines of the front that no photograph shows.
  json curves = Curves();
  const json given = curves["curves"];
  for (json curve : given) {
    const json& samples = curve["samples"];
    if (samples.front()["position"][1] > -0.3 ||
        samples.back()["position"][1] > -0.3) {
      continue;
    }
    for (json& sample : curve["samples"]) sample["support"] = json::array();
    for (int i = 0; i < 20; ++i) curves["curves"].push_back(curve);
  }
  ASSERT_GT(curves["curves"].size(), given.size());
  std::ofstream(results_ / "curves.json") << curves;
  for (const char* hidden : {"dashed", "solid"}) {
    const Outcome outcome =
        Run("draw --plane xz --from_behind 1 --photograph auto --hidden " +
            std::string(hidden));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("right where y is 0.35"));
  }
}

TEST_F(Draw, APhotographFromBehindIsRefused) {
  ASSERT_EQ(Run("draw --plane xz --from_behind 1 --photograph auto").exit_code,
            0);
  const std::string sheet = Read(results_ / "drawing_xz_from_behind.svg");
  const std::size_t name = sheet.find("photograph view_");
  ASSERT_NE(name, sheet.npos);
  ExpectError("draw --plane xz --photograph " + sheet.substr(name + 11, 12),
              "from this side; --photograph auto chooses");
}

TEST_F(Draw, SeveralViewsAreDrawnWholeOnRequest) {
  EXPECT_EQ(Run("draw --plane xz,xy --crop all").exit_code, 0);
}

TEST_F(Draw, GeoPackageHasTheCurves) {
  if (RunInShell("command -v ogrinfo").exit_code != 0) {
    GTEST_SKIP() << "no gdal-bin";
  }
  CheckMap("geopackage", ".gpkg", [](const fs::path& path) {
    const std::string said =
        RunInShell("ogrinfo -q " + Quoted(path) +
                   " -sql \"SELECT COUNT(*) AS n FROM curves\" 2>&1")
            .output;
    std::size_t count = 0;
    const std::size_t line = said.find("n (Integer) = ");
    EXPECT_NE(line, said.npos) << said;
    std::sscanf(said.c_str() + line, "n (Integer) = %zu", &count);
    return count;
  });
}

TEST_F(Draw, GeoJsonHasTheCurves) {
  CheckMap("geojson", ".geojson", [](const fs::path& path) {
    const json map = json::parse(Read(path));
    EXPECT_EQ(map["type"], "FeatureCollection");
    EXPECT_EQ(map["name"], "curves");
    return map["features"].size();
  });
}

TEST_F(Draw, SectionsAndBacksReplaceNoOtherDrawing) {
  ASSERT_EQ(Run("draw --plane xz").exit_code, 0);
  const std::string front = Read(results_ / "drawing_xz.dxf");
  ASSERT_EQ(Run("draw --plane xz --from_behind 1").exit_code, 0);
  ASSERT_EQ(Run("draw --plane xz --slice=-9,9 --from_behind 1").exit_code, 0);
  EXPECT_EQ(Read(results_ / "drawing_xz.dxf"), front);
  EXPECT_NE(Read(results_ / "drawing_xz_from_behind.dxf"), front);
  EXPECT_TRUE(fs::exists(results_ / "drawing_xz_section_from_behind.svg"));
}

TEST_F(Draw, TitlesTellWhetherAViewIsFromBehind) {
  int num_from_behind = 0;
  for (const std::string behind : {"0", "1"}) {
    EXPECT_EQ(Run("draw --name one --from_behind " + behind).exit_code, 0);
    const std::string title = Read(results_ / "one.svg");
    num_from_behind += title.find(" from behind") != title.npos;
  }
  EXPECT_EQ(num_from_behind, 1);
}

// Depths behind a plane through nodes are those in front of it from behind.
TEST_F(Draw, SlicesOfNodesLieOnTheSideOfTheViewer) {
  const auto lines_of = [&](const std::string& words) {
    const Outcome outcome =
        Run("draw --name one --hidden solid --plane 'nodes 0 1 2' " + words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    std::vector<double> lengths = LineLengths(Read(results_ / "one.dxf"));
    std::ranges::sort(lengths);
    return lengths;
  };
  const std::vector<double> in_front = lines_of("--slice=-0.1,9");
  const std::vector<double> behind = lines_of("--slice=-9,0.1");
  ASSERT_NE(in_front.size(), behind.size());
  const std::vector<double> seen_from_there =
      lines_of("--slice=-0.1,9 --from_behind 1");
  ASSERT_EQ(seen_from_there.size(), behind.size());
  for (std::size_t i = 0; i < behind.size(); ++i) {
    EXPECT_NEAR(seen_from_there[i], behind[i], 1e-9);
  }
}

TEST_F(Draw, AFolderThatCannotBeWrittenToMayBeCopied) {
  const auto lock = FolderLock::Take(results_);
  ASSERT_TRUE(lock);
  ExpectError("draw", "with --output_path, a copy of this one");
}

TEST_F(Draw, CurvesOfOtherProgramsAreNamed) {
  std::ofstream(results_ / "curves.json") << "{}";
  ExpectError("draw", "curves.json is broken: key 'nodes' not found; run");
}

TEST_F(Draw, SaysWhatIsWrongAndWritesNothing) {
  const auto before = Contents(results_);
  for (const auto& [words, why] :
       {std::pair("--plane front", "xy, xz, yz"),
        std::pair("--plane 'nodes 0 1'", "three nodes"),
        std::pair("--plane 'nodes 0 1 99999'", "no node 99999"),
        std::pair("--scale 1:50", "colmap_curvix align"),
        std::pair("--scale big", "1:50"),
        std::pair("--slice 2,1", "lower and the higher"),
        std::pair("--plane xy --slice 1000,1001", "; z of the curves is from "),
        std::pair("--plane xy --crop 1000,0,1001,1", "nothing to draw"),
        std::pair("--plane xy --crop 0,0,1", "left, bottom, right"),
        std::pair("--plane xy,xz --photograph auto", "a single --plane"),
        std::pair("--photograph none.jpg", "of the model; --photograph auto"),
        std::pair("--name a/b", "--name"),
        std::pair("--name curves", "curves.dxf is a file of the curves")}) {
    ExpectError(std::string("draw ") + words, why);
  }
  EXPECT_EQ(Contents(results_), before);
}

}  // namespace
}  // namespace curvix

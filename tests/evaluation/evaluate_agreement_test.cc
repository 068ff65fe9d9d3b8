// SPDX-License-Identifier: BSD-3-Clause
// Our measures against an independent script that defines the same ones.
#include <curvix/curve_io.h>
#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "plugin/commands/evaluations.h"
#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

fs::path ScriptPath(const std::string& name) {
  return DataFolder() / ".." / "eval" / name;
}

// A Python that has these modules; empty if there is none.
std::string FindPython(const std::string& modules) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string probe =
        std::string(python) + " -c 'import " + modules + "' 2>/dev/null";
    if (std::system(probe.c_str()) == 0) return python;
  }
  return "";
}

std::string RunCommand(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"),
                                                   &pclose);
  std::string output;
  std::array<char, 4096> buffer;
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) {
    output += buffer.data();
  }
  return output;
}

class EvaluateAgreement : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(ScriptPath("evaluate.py"))) {
      GTEST_SKIP() << "no evaluation script";
    }
    python_ = FindPython("numpy, scipy");
    if (python_.empty()) GTEST_SKIP() << "no python3 with numpy and scipy";
  }

  // Evaluates the same files both ways and compares every measure.
  void ExpectAgreement(const CurveSet& curves, const fs::path& truth_path) {
    const fs::path path = folder_.path() / "curves.ply";
    ASSERT_TRUE(WriteCurves(path, curves, {}).ok());
    const Result<std::string> ours =
        EvaluateFiles(path, truth_path, {}, /*json=*/true);
    ASSERT_TRUE(ours.ok()) << ours.status().message();
    const auto actual = nlohmann::json::parse(*ours);
    const auto expected = nlohmann::json::parse(
        RunCommand(python_ + " " + ScriptPath("evaluate.py").string() + " " +
                   path.string() + " " + truth_path.string() + " --json"));
    ASSERT_EQ(expected.size(), 26u);
    for (const auto& [key, value] : expected.items()) {
      ASSERT_TRUE(actual.contains(key)) << key;
      const double wanted = value.get<double>();
      // The script rounds to three decimals.
      EXPECT_NEAR(
          actual.at(key).get<double>(), wanted, 1e-3 * std::abs(wanted) + 6e-4)
          << key;
    }
  }

  const TemporaryFolder folder_;
  std::string python_;
};

// Pieces of the true curves of 40 samples, four apart, each moved by up to
// `noise` and shifted by up to `shift` (world units); every fifth is missing,
// every seventh is doubled.
CurveSet Perturb(const GroundTruth& truth, double noise, double shift) {
  std::mt19937 generator(5);
  const auto random = [&](double range) {
    const auto draw = [&] {
      return range * (static_cast<double>(generator()) / 2147483648.0 - 1);
    };
    const double x = draw();
    const double y = draw();
    return Eigen::Vector3d(x, y, draw());
  };
  CurveSet set;
  const std::vector<TrueSample>& samples = truth.samples;
  for (std::size_t begin = 0; begin + 40 < samples.size(); begin += 40) {
    if (begin / 40 % 5 == 4) continue;
    for (int copy = 0; copy < (begin / 40 % 7 == 6 ? 2 : 1); ++copy) {
      const Eigen::Vector3d moved = random(shift);
      Curve curve;
      for (std::size_t i = begin; i < begin + 40; i += 4) {
        if (samples[i].curve_id != samples[begin].curve_id) break;
        CurveSample sample;
        sample.position = samples[i].position + moved + random(noise);
        curve.samples.push_back(sample);
      }
      if (curve.samples.size() > 1) set.curves.push_back(curve);
    }
  }
  return set;
}

TEST_F(EvaluateAgreement, PiecesOfASquareAndACircle) {
  GroundTruth truth;
  const fs::path path = folder_.path() / "gt.txt";
  std::ofstream file(path);
  const auto add = [&](const Eigen::Vector3d& p,
                       const Eigen::Vector3d& t,
                       int id,
                       int views) {
    truth.samples.push_back({p, t, id, views + 1, views});
    file << p.transpose() << ' ' << t.transpose() << ' ' << id << ' '
         << views + 1 << ' ' << views << '\n';
  };
  for (int i = 0; i < 250; ++i) {
    add({0.002 * i, 0, 0}, {1, 0, 0}, 0, i % 9);
  }
  for (int i = 0; i < 250; ++i) add({0.5, 0.002 * i, 0}, {0, 1, 0}, 1, 8);
  // A circle as two arcs.
  for (int i = 0; i < 628; ++i) {
    const double t = 0.01 * i;
    add({0.2 * std::cos(t), 0.2 * std::sin(t), 0.3},
        {-std::sin(t), std::cos(t), 0},
        i < 314 ? 2 : 3,
        5);
  }
  file.close();
  ExpectAgreement(Perturb(truth, 0, 0), path);
  ExpectAgreement(Perturb(truth, 0.001, 0.003), path);
  ExpectAgreement(Perturb(truth, 0.004, 0.02), path);
  CurveSet loop;
  loop.curves.resize(1);
  loop.curves[0].closed = true;
  for (std::size_t i = 500; i < truth.samples.size(); i += 3) {
    loop.curves[0].samples.emplace_back().position = truth.samples[i].position;
  }
  ExpectAgreement(loop, path);
}

TEST_F(EvaluateAgreement, PiecesOfAPublishedObject) {
  const fs::path path = DataFolder() / "abc_nef" / "00000006" / "gt.txt";
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const auto truth = ReadGroundTruth(path);
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  ExpectAgreement(Perturb(*truth, 0.001, 0.004), path);
}

// Lines of another program in photographs of a room.
TEST(HoldoutAgreement, AnIndependentScriptFindsTheSameFigures) {
  const fs::path script = ScriptPath("photo_referee.py");
  const fs::path workspace = DataFolder() / "photos" / "room";
  const fs::path lines = DataFolder() / "peers" / "line3dpp" / "room.obj";
  for (const fs::path& path : {script, workspace, lines}) {
    if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  }
  const std::string python = FindPython("numpy, scipy, cv2");
  if (python.empty()) GTEST_SKIP() << "no python3 with numpy, scipy and cv2";
  RunSettings settings;
  settings.workspace_path = workspace;
  std::ostringstream words;
  ProgressPrinter progress(words, false);
  const Result<std::string> ours =
      RunHoldout(settings, lines, 4, /*json=*/true, progress);
  ASSERT_TRUE(ours.ok()) << ours.status().message();
  const auto actual = nlohmann::json::parse(*ours);
  const auto expected = nlohmann::json::parse(
      RunCommand(python + " " + script.string() + " " + workspace.string() +
                 " " + lines.string() + " --every 4 --json"));
  EXPECT_EQ(actual["held_out"], expected["held"]);
  for (const char* figure : {"precision",
                             "precision_lift",
                             "strong",
                             "strong_lift",
                             "lines",
                             "lines_lift"}) {
    EXPECT_NEAR(actual[figure].get<double>(), expected[figure].get<double>(), 1)
        << figure;
  }
}

}  // namespace
}  // namespace curvix

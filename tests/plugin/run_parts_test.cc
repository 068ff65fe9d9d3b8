// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_parts.h"

#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "evaluation/evaluate.h"
#include "plugin/base/staged_output.h"
#include "plugin/commands/command_synthesize.h"
#include "plugin/run/part_files.h"
#include "plugin/run/run_workspace.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kMaxViews = 46;

// A short street in small photographs.
class RunParts : public testing::Test {
 protected:
  // Photographs four by three.
  void MakeStreet(int width) {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kFacade;
    options.num_views = 48;
    options.width = width;
    options.height = width * 3 / 4;
    options.points_per_view = 10;
    ASSERT_TRUE(Synthesize(options, street_).ok());
    settings_.workspace_path = street_;
    settings_.output_path = parts_;
    settings_.poses.refiner = "none";
    settings_.poses.refine_poses_with_curves = false;
    settings_.options.edge_detection.max_edges_per_megapixel = 60000;
    Plan();
  }

  void Plan() {
    const auto plan = RunPartition(settings_, kMaxViews, progress_);
    ASSERT_TRUE(plan.ok()) << plan.status().message();
    num_parts_ = static_cast<int>(plan->parts.size());
    ASSERT_GE(num_parts_, 2);
  }
  void Reconstruct(int part_idx) {
    const auto part = RunPart(settings_, part_idx, progress_);
    ASSERT_TRUE(part.ok()) << part.status().message();
  }
  void ReconstructAll() {
    for (int k = 0; k < num_parts_; ++k) Reconstruct(k);
  }
  void MergeAll() {
    const auto merged = RunMerge(settings_, progress_);
    ASSERT_TRUE(merged.ok()) << merged.status().message();
  }
  Status MergeStatus() { return RunMerge(settings_, progress_).status(); }

  Evaluation Evaluate(const fs::path& output) const {
    const auto curves = ReadCurves(output / "curves.ply", Scene());
    const auto truth = ReadGroundTruth(street_ / "gt.txt");
    return *EvaluateCurves(*curves, *truth, EvaluationOptions());
  }

  TemporaryFolder folder_;
  const fs::path street_ = folder_.path() / "street";
  const fs::path one_ = folder_.path() / "one";
  const fs::path parts_ = folder_.path() / "in parts";
  RunSettings settings_;
  std::ostringstream text_;
  ProgressPrinter progress_{text_, false};
  int num_parts_ = 0;
};

TEST_F(RunParts, GiveWhatOneRunGives) {
  MakeStreet(240);
  ReconstructAll();
  MergeAll();
  RunSettings settings = settings_;
  settings.output_path = one_;
  const auto run = RunWorkspace(settings, progress_);
  ASSERT_TRUE(run.ok()) << run.status().message();

  EXPECT_THAT(*ReadFile(parts_ / "viewer.html"),
              Not(HasSubstr("\"points\":[]")));
  EXPECT_THAT(*ReadFile(parts_ / "report.json"),
              Not(HasSubstr("edge_sigma_px")));
  EXPECT_THAT(*ReadFile(one_ / "report.json"), HasSubstr("edge_sigma_px"));
  EXPECT_THAT(*ReadFile(parts_ / "project.ini"), HasSubstr("command=merge\n"));
  EXPECT_THAT(*ReadFile(one_ / "project.ini"), Not(HasSubstr("command=")));
  const Evaluation one = Evaluate(one_);
  const Evaluation merged = Evaluate(parts_);
  EXPECT_GT(*one.visible_f_score_5, 50);
  EXPECT_GT(*merged.visible_f_score_5, *one.visible_f_score_5 - 1.5);
  EXPECT_NEAR(*merged.duplication, *one.duplication, 0.02);
  EXPECT_GE(*merged.whole, *one.whole - 3);
  EXPECT_NEAR(static_cast<double>(merged.num_predicted),
              static_cast<double>(one.num_predicted),
              0.04 * static_cast<double>(one.num_predicted));
  for (const auto& entry : fs::directory_iterator(one_)) {
    const fs::path name = entry.path().filename();
    EXPECT_TRUE(name == "stages" || fs::exists(parts_ / name)) << name;
  }
}

TEST_F(RunParts, GoOnAfterAPartIsLost) {
  MakeStreet(120);
  ReconstructAll();
  MergeAll();
  const std::string before = *ReadFile(parts_ / "curves.json");

  // As if it had been killed between two stages.
  fs::remove(parts_ / "parts/1/part.bin");
  fs::remove(parts_ / "parts/1/stages/sketch.bin");
  EXPECT_EQ(MergeStatus().code(), StatusCode::kNotFound);
  EXPECT_THAT(MergeStatus().message(), HasSubstr("not there: 1;"));

  settings_.options.runtime.num_threads = 1;
  Plan();  // the same, so the other parts stay
  Reconstruct(1);
  MergeAll();
  EXPECT_EQ(*ReadFile(parts_ / "curves.json"), before);

  settings_.options.validation.max_angle_deg = 14;
  EXPECT_EQ(MergeStatus().code(), StatusCode::kNotFound);
  EXPECT_THAT(MergeStatus().message(), HasSubstr("version: 0, 1"));
}

TEST_F(RunParts, ChangedImagesAndMasksAreNoticed) {
  MakeStreet(80);
  ReconstructAll();
  MergeAll();
  const auto plan = ReadPlan(parts_ / "parts");
  ASSERT_TRUE(plan.ok());
  ASSERT_EQ(plan->partition.parts[0].view_idxs.front(), 0);
  ASSERT_GT(plan->partition.parts[1].view_idxs.front(), 0);
  const fs::path path = street_ / "images/view_000.png";
  const std::string before = *ReadFile(path);

  fs::copy_file(street_ / "images/view_001.png",
                path,
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(MergeStatus().code(), StatusCode::kNotFound);
  EXPECT_THAT(MergeStatus().message(), HasSubstr("version: 0;"));
  Reconstruct(0);
  MergeAll();

  ASSERT_TRUE(WriteFileAtomically(path, before).ok());
  EXPECT_THAT(MergeStatus().message(), HasSubstr("version: 0;"));
  Reconstruct(0);
  // The time of a file does not count.
  fs::last_write_time(path, fs::file_time_type::clock::now());
  MergeAll();

  settings_.mask_path = street_ / "masks";
  fs::create_directories(settings_.mask_path);
  fs::copy_file(path, settings_.mask_path / "view_000.png.png");
  EXPECT_THAT(MergeStatus().message(), HasSubstr("version: 0;"));
}

TEST_F(RunParts, NeedTheModelAndTheImagesThatWereDivided) {
  MakeStreet(80);
  ReconstructAll();
  const fs::path image = street_ / "images/view_047.png";
  fs::rename(image, street_ / "elsewhere.png");
  EXPECT_EQ(MergeStatus().code(), StatusCode::kNotFound);
  EXPECT_THAT(MergeStatus().message(), HasSubstr("view_047.png is gone"));
  fs::rename(street_ / "elsewhere.png", image);

  // The position of a point counts; its error, which no stage reads, is a
  // reason to look at the plan again, which stays.
  const fs::path path = street_ / "sparse/0/points3D.bin";
  const std::string before = *ReadFile(path);
  constexpr std::size_t kPosition = 16;
  constexpr std::size_t kError = kPosition + 3 * 8 + 3;
  for (const std::size_t at : {kPosition, kError}) {
    std::string bytes = before;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    ASSERT_TRUE(WriteFileAtomically(path, bytes).ok());
    EXPECT_EQ(MergeStatus().code(), StatusCode::kNotFound);
    EXPECT_THAT(MergeStatus().message(), HasSubstr("has changed"));
    EXPECT_EQ(RunPartition(settings_, kMaxViews, progress_).ok(), at == kError);
  }
  MergeAll();
}

TEST_F(RunParts, MergesReportWhatTheModelLacked) {
  MakeStreet(80);
  fs::remove(street_ / "images/view_047.png");
  Plan();
  ReconstructAll();
  MergeAll();
  EXPECT_THAT(*ReadFile(parts_ / "report.json"),
              AllOf(HasSubstr("\"missing_images\": [\n"),
                    HasSubstr("\"view_047.png\""),
                    HasSubstr("1 of 48 images is not in ")));
  const fs::path path = parts_ / "parts/input.json";
  ASSERT_TRUE(WriteFileAtomically(path, "{").ok());
  EXPECT_EQ(MergeStatus().code(), StatusCode::kDataLoss);
  EXPECT_THAT(MergeStatus().message(), HasSubstr("input.json is broken"));
}

TEST_F(RunParts, NeedNotHaveTheImageOfTheSvg) {
  MakeStreet(80);
  settings_.output.formats = {"svg"};
  settings_.output.svg_image = "view_000.png";
  ReconstructAll();
  MergeAll();
  EXPECT_TRUE(fs::exists(parts_ / "curves.svg"));
  settings_.output.svg_image = "none.png";
  EXPECT_THAT(MergeStatus().message(), HasSubstr("svg_image is none.png"));
}

TEST_F(RunParts, ThatShareMostOfTheirViewsAreNoted) {
  MakeStreet(120);
  EXPECT_THAT(text_.str(), testing::Not(HasSubstr("share most")));
  const auto plan = RunPartition(settings_, 42, progress_);
  ASSERT_TRUE(plan.ok()) << plan.status().message();
  EXPECT_GE(plan->parts.size(), 4u);
  EXPECT_THAT(text_.str(), HasSubstr("each view is in about 3 parts"));
}

TEST_F(RunParts, WithoutCurvesSayWhy) {
  MakeStreet(80);
  settings_.options.curve_filter.min_length_px = 1e6;
  const auto record = RunPart(settings_, 0, progress_);
  ASSERT_TRUE(record.ok()) << record.status().message();
  EXPECT_EQ(record->result.num_curves, 0);
  EXPECT_THAT(record->result.why_empty, HasSubstr("filter"));
}

TEST_F(RunParts, AnotherPlanDoesNotTakeThePlaceOfResults) {
  MakeStreet(80);
  EXPECT_TRUE(RunPartition(settings_, 48, progress_).ok());
  Plan();
  Reconstruct(0);
  const Status status = RunPartition(settings_, 48, progress_).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr("parts of it are done"));
  EXPECT_TRUE(fs::exists(parts_ / "parts/0/part.bin"));
}

TEST_F(RunParts, LostFoldersAndBrokenResultsComeBack) {
  MakeStreet(80);
  ReconstructAll();
  MergeAll();
  const std::string before = *ReadFile(parts_ / "curves.json");
  fs::resize_file(parts_ / "parts/0/part.bin", 100);
  fs::remove_all(parts_ / "parts/1");
  fs::remove_all(parts_ / "parts/scene");
  for (const Status& status :
       {RunPart(settings_, 1, progress_).status(), MergeStatus()}) {
    EXPECT_EQ(status.code(), StatusCode::kNotFound);
    EXPECT_THAT(status.message(), HasSubstr("'colmap_curvix partition' again"));
  }
  Plan();
  EXPECT_THAT(MergeStatus().message(), HasSubstr("not there: 1; "));
  EXPECT_THAT(MergeStatus().message(), HasSubstr("version: 0; "));
  Reconstruct(0);
  Reconstruct(1);
  const fs::path edges = parts_ / "parts/1/edges.ply";
  fs::resize_file(edges, fs::file_size(edges) - 1);
  EXPECT_THAT(MergeStatus().message(),
              AllOf(HasSubstr("parts/1/edges.ply"),
                    HasSubstr("reconstruct this part again")));
  Reconstruct(1);
  MergeAll();
  EXPECT_EQ(*ReadFile(parts_ / "curves.json"), before);
}

TEST_F(RunParts, FinishedPartsOutliveTheirPlan) {
  MakeStreet(80);
  ReconstructAll();
  MergeAll();
  const std::string before = *ReadFile(parts_ / "curves.json");
  ASSERT_TRUE(WriteFileAtomically(parts_ / "parts/plan.json", "{").ok());
  Plan();
  MergeAll();
  fs::remove(parts_ / "parts/plan.json");
  fs::remove(parts_ / "parts/input.json");
  Plan();
  fs::remove(parts_ / "parts/input.json");
  EXPECT_THAT(MergeStatus().message(),
              HasSubstr("input.json; run 'colmap_curvix partition'"));
  Plan();
  MergeAll();
  EXPECT_EQ(*ReadFile(parts_ / "curves.json"), before);
}

TEST_F(RunParts, ReadOnlyTheirOwnImages) {
  MakeStreet(80);
  const auto plan = ReadPlan(parts_ / "parts");
  ASSERT_TRUE(plan.ok());
  const std::vector<int>& idxs = plan->partition.parts[0].view_idxs;
  ASSERT_LT(idxs.back(), 47);
  fs::remove(street_ / "images/view_047.png");
  const auto record = RunPart(settings_, 0, progress_);
  ASSERT_TRUE(record.ok()) << record.status().message();
  EXPECT_EQ(record->input.num_views, static_cast<std::int64_t>(idxs.size()));

  fs::remove(street_ / "images/view_000.png");
  const Status status = RunPart(settings_, 0, progress_).status();
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_THAT(status.message(), HasSubstr("view_000.png is gone"));
  EXPECT_THAT(RunPart(settings_, 99, progress_).status().message(),
              HasSubstr("There is no part 99"));
}

TEST_F(RunParts, OneRunAtATimeWorksOnAPart) {
  MakeStreet(80);
  const fs::path folder = parts_ / "parts/0";
  {
    const auto lock = FolderLock::Take(folder);
    const Status status = RunPart(settings_, 0, progress_).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr("Another run is writing"));
    EXPECT_FALSE(fs::exists(folder / "part.bin"));
    Reconstruct(1);
  }
  Reconstruct(0);
  EXPECT_TRUE(fs::exists(folder / "part.bin"));
}

TEST_F(RunParts, APlanTakesThePlaceOfAnotherPlanOnly) {
  MakeStreet(80);
  {
    const auto lock = FolderLock::Take(parts_ / "parts/0");
    const Status status = RunPartition(settings_, 48, progress_).status();
    EXPECT_THAT(status.message(), HasSubstr("is being reconstructed"));
  }
  fs::remove_all(parts_ / "parts");
  const fs::path mine = parts_ / "parts/gearbox/data.txt";
  fs::create_directories(mine.parent_path());
  std::ofstream(mine) << "mine";
  const Status status = RunPartition(settings_, 48, progress_).status();
  EXPECT_THAT(status.message(), HasSubstr("which is no plan"));
  EXPECT_TRUE(fs::exists(mine));
}

TEST_F(RunParts, NeedASoundPlan) {
  MakeStreet(80);
  const fs::path path = parts_ / "parts/plan.json";
  const std::string text = *ReadFile(path);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string broken = text;
    const std::size_t at = broken.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return broken.replace(at, from.size(), to);
  };
  for (const std::string& broken :
       {std::string("{"),
        text.substr(0, text.size() / 2),
        replaced("\"part 0\"", "\"part 7\""),
        replaced("\"part 0\"", "\"part 1\""),
        replaced("\"part 0\"", "\"cut 0\""),
        replaced("\"part 0\"", "\"cut -1\""),
        replaced("\"num_views\": 48", "\"num_views\": 3")}) {
    ASSERT_TRUE(WriteFileAtomically(path, broken).ok());
    EXPECT_EQ(MergeStatus().code(), StatusCode::kDataLoss) << broken;
  }
  fs::remove(path);
  for (const Status& status :
       {RunPart(settings_, 0, progress_).status(), MergeStatus()}) {
    EXPECT_EQ(status.code(), StatusCode::kNotFound);
    EXPECT_THAT(status.message(), HasSubstr("colmap_curvix partition"));
  }
}

}  // namespace
}  // namespace curvix

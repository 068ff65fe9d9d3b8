// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/new_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <csignal>
#include <fstream>

#include "base/file_io.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Two photographs, one in a folder of its own.
struct Source {
  TemporaryFolder folder;
  ColmapModel model;
  std::vector<fs::path> files;

  explicit Source(const std::string& second = "left/b.png") {
    model.cameras.push_back({1, {CameraModel::kPinhole, 8, 6, {9, 9, 4, 3}}});
    for (const std::string& name : {std::string("a.png"), second}) {
      files.push_back(
          folder.Write("photos" + std::to_string(files.size()), name));
      ColmapImage image;
      image.image_id = static_cast<std::uint32_t>(files.size());
      image.camera_id = 1;
      image.name = name;
      model.images.push_back(image);
    }
  }
};

TEST(NewWorkspace, HoldsImagesAndModelUnderEveryPolicy) {
  for (const CopyPolicy policy :
       {CopyPolicy::kCopy, CopyPolicy::kSoftLink, CopyPolicy::kHardLink}) {
    const Source source;
    const fs::path workspace = source.folder.path() / "new" / "workspace";
    const Status status =
        WriteNewWorkspace(source.model, source.files, policy, workspace);
    ASSERT_TRUE(status.ok()) << status.message();
    const fs::path image = workspace / "images" / "left" / "b.png";
    EXPECT_EQ(*ReadFile(image), "left/b.png");
    EXPECT_EQ(fs::is_symlink(image), policy == CopyPolicy::kSoftLink);
    EXPECT_EQ(fs::equivalent(image, source.files[1]),
              policy != CopyPolicy::kCopy);
    const auto model = ReadColmapModel(workspace / "sparse" / "0");
    ASSERT_TRUE(model.ok()) << model.status().message();
    EXPECT_EQ(model->images.size(), 2u);
    EXPECT_EQ(std::distance(fs::directory_iterator(workspace), {}), 2);
  }
}

TEST(NewWorkspace, LeavesImagesThatAreInPlace) {
  Source source;
  const fs::path workspace = source.folder.path();
  source.files = {source.folder.Write("images/a.png", "1"),
                  source.folder.Write("images/left/b.png", "2")};
  source.folder.Write("images/not_in_the_model.png", "3");
  const Status status = WriteNewWorkspace(
      source.model, source.files, CopyPolicy::kCopy, workspace);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(ReadColmapModel(workspace / "sparse" / "0").ok());
  EXPECT_TRUE(fs::exists(workspace / "images" / "not_in_the_model.png"));
}

TEST(NewWorkspace, RefusesToOverwrite) {
  for (const char* file : {"w/images/other.png", "w/sparse/0/cameras.bin"}) {
    const Source source;
    const fs::path mine = source.folder.Write(file, "mine");
    const fs::path workspace = source.folder.path() / "w";
    const Status status = WriteNewWorkspace(
        source.model, source.files, CopyPolicy::kCopy, workspace);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr("there already"));
    EXPECT_EQ(*ReadFile(mine), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(workspace), {}), 1);
  }
}

TEST(NewWorkspace, SaysThatTheImagesThemselvesAreInTheWay) {
  Source source;
  const fs::path workspace = source.folder.path();
  source.files = {source.folder.Write("images/1.png", "1"),
                  source.folder.Write("images/2.png", "2")};
  const Status status = WriteNewWorkspace(
      source.model, source.files, CopyPolicy::kCopy, workspace);
  EXPECT_THAT(status.message(), HasSubstr("holds the images themselves"));
  EXPECT_FALSE(fs::exists(workspace / "sparse"));
}

TEST(NewWorkspace, TakesEmptyFolders) {
  const Source source;
  const fs::path workspace = source.folder.path() / "w";
  fs::create_directories(workspace / "images");
  fs::create_directories(workspace / "sparse");
  EXPECT_TRUE(WriteNewWorkspace(
                  source.model, source.files, CopyPolicy::kCopy, workspace)
                  .ok());
}

TEST(NewWorkspace, LeavesNothingWhenItIsInterrupted) {
  const Source source;
  const fs::path workspace = source.folder.path() / "new" / "workspace";
  int left = 1;
  const Status status = WriteNewWorkspace(
      source.model, source.files, CopyPolicy::kCopy, workspace, [&] {
        return left-- > 0;
      });
  EXPECT_EQ(status.code(), StatusCode::kCancelled);
  EXPECT_FALSE(fs::exists(source.folder.path() / "new"));
}

TEST(NewWorkspace, SaysThatAnImageDoesNotFit) {
  const Source source;
  std::ofstream(source.files[1]) << std::string(100000, 'x');
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {50000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const fs::path workspace = source.folder.path() / "new";
  const Status status = WriteNewWorkspace(
      source.model, source.files, CopyPolicy::kCopy, workspace);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(status.message(),
              testing::AllOf(HasSubstr("b.png"), HasSubstr("free space")));
  EXPECT_FALSE(fs::exists(workspace));
}

TEST(NewWorkspace, LeavesNothingWhenAnImageCannotBePlaced) {
  // A file and a folder cannot both be called a.png.
  const Source source("a.png/b.png");
  const fs::path workspace = source.folder.path() / "new" / "workspace";
  const Status status = WriteNewWorkspace(
      source.model, source.files, CopyPolicy::kCopy, workspace);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr("Cannot write"));
  EXPECT_FALSE(fs::exists(source.folder.path() / "new"));
}

}  // namespace
}  // namespace curvix

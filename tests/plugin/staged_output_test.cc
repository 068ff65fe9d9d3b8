// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/staged_output.h"

#include <fstream>
#include <iterator>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/plugin/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

std::string Read(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Write(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

bool IsEmpty(const fs::path& folder) { return fs::is_empty(folder); }

TEST(StagedOutput, NothingIsLeftWithoutPublish) {
  const TemporaryFolder folder;
  {
    auto output = StagedOutput::Create(folder.path() / "a/b");
    ASSERT_TRUE(output.ok()) << output.status().message();
    Write(output->folder() / "curves.ply", "half");
    EXPECT_TRUE(fs::exists(folder.path() / "a/b"));
  }
  EXPECT_TRUE(IsEmpty(folder.path()));
}

TEST(StagedOutput, PublishesEveryFileAndKeepsStrangers) {
  const TemporaryFolder folder;
  folder.Write("out/curves.ply", "old");
  folder.Write("out/mine.txt", "mine");
  {
    auto output = StagedOutput::Create(folder.path() / "out/");
    ASSERT_TRUE(output.ok());
    Write(output->folder() / "curves.ply", "new");
    Write(output->folder() / "report.json", "{}");
    EXPECT_EQ(Read(folder.path() / "out/curves.ply"), "old");
    EXPECT_TRUE(output->Publish().ok());
  }
  EXPECT_EQ(Read(folder.path() / "out/curves.ply"), "new");
  EXPECT_EQ(Read(folder.path() / "out/report.json"), "{}");
  EXPECT_EQ(Read(folder.path() / "out/mine.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "out"), {}),
            3);
}

TEST(StagedOutput, OlderFilesComeBackWhenOneCannotBeMoved) {
  const TemporaryFolder folder;
  folder.Write("out/a.txt", "old");
  folder.Write("out/b.txt", "old");
  {
    auto output = StagedOutput::Create(folder.path() / "out");
    ASSERT_TRUE(output.ok());
    Write(output->folder() / "a.txt", "new");
    Write(output->folder() / "b.txt", "new");
    // Something stands where the older b.txt is to be kept.
    fs::create_directories(output->folder() / "older/b.txt/x");
    EXPECT_EQ(output->Publish().code(), StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(Read(folder.path() / "out/a.txt"), "old");
  EXPECT_EQ(Read(folder.path() / "out/b.txt"), "old");
}

TEST(StagedOutput, SaysWhereItCannotWrite) {
  const TemporaryFolder folder;
  const fs::path file = folder.Write("file", "text");
  const auto output = StagedOutput::Create(file / "out");
  EXPECT_EQ(output.status().code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(output.status().message(),
              testing::AllOf(testing::HasSubstr(file.string()),
                             testing::HasSubstr("--output_path")));
  EXPECT_EQ(Read(file), "text");
}

}  // namespace
}  // namespace curvix

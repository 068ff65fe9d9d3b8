// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/staged_output.h"

#include <sys/stat.h>
#include <fstream>
#include <iterator>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

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

TEST(StagedOutput, IsPrivateUntilPublished) {
  const TemporaryFolder folder;
  const mode_t old_mask = umask(0);
  const auto output = StagedOutput::Create(folder.path() / "out");
  umask(old_mask);
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(fs::status(output->folder()).permissions(), fs::perms::owner_all);
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
    fs::create_directories(output->folder() / ".older/b.txt/x");
    EXPECT_EQ(output->Publish().code(), StatusCode::kNotFound);
  }
  EXPECT_EQ(Read(folder.path() / "out/a.txt"), "old");
  EXPECT_EQ(Read(folder.path() / "out/b.txt"), "old");
}

TEST(StagedOutput, OneAtATime) {
  const TemporaryFolder folder;
  {
    const auto first = StagedOutput::Create(folder.path());
    ASSERT_TRUE(first.ok());
    const auto second = StagedOutput::Create(folder.path());
    EXPECT_EQ(second.status().code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(second.status().message(), testing::HasSubstr("Another run"));
  }
  EXPECT_TRUE(StagedOutput::Create(folder.path()).ok());
}

TEST(StagedOutput, RemovesWhatAKilledRunDidNotFinish) {
  const TemporaryFolder folder;
  folder.Write("curves.ply", "old");
  folder.Write(".unfinished-abc/curves.ply", "half");
  EXPECT_TRUE(StagedOutput::Create(folder.path()).ok());
  EXPECT_EQ(Read(folder.path() / "curves.ply"), "old");
  EXPECT_FALSE(fs::exists(folder.path() / ".unfinished-abc"));
}

// The run was killed after it had moved a.txt, when b.txt was saved and c.txt
// was not; sparse/ was to go.
TEST(StagedOutput, FinishesWhatAKilledRunBeganToPublish) {
  const TemporaryFolder folder;
  folder.Write("a.txt", "new");
  folder.Write("c.txt", "old");
  folder.Write("sparse/cameras.bin", "old");
  folder.Write("mine.txt", "mine");
  const std::string killed = ".unfinished-abc/";
  folder.Write(killed + "b.txt", "new");
  folder.Write(killed + "c.txt", "new");
  folder.Write(killed + ".older/a.txt", "old");
  folder.Write(killed + ".older/b.txt", "old");
  fs::create_directories(folder.path() / killed / ".obsolete/sparse");
  EXPECT_TRUE(StagedOutput::Create(folder.path()).ok());
  for (const char* name : {"a.txt", "b.txt", "c.txt"}) {
    EXPECT_EQ(Read(folder.path() / name), "new") << name;
  }
  EXPECT_EQ(Read(folder.path() / "mine.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder.path() / "sparse"));
  EXPECT_FALSE(fs::exists(folder.path() / ".unfinished-abc"));
}

TEST(StagedOutput, ReplacesAndRemovesObsoleteOnes) {
  const TemporaryFolder folder;
  folder.Write("out/sparse/cameras.bin", "old");
  folder.Write("out/log", "old");
  {
    auto output = StagedOutput::Create(folder.path() / "out");
    ASSERT_TRUE(output.ok());
    fs::create_directories(output->folder() / "sparse");
    Write(output->folder() / "sparse/cameras.bin", "new");
    EXPECT_TRUE(output->Publish({"sparse", "log"}).ok());
  }
  EXPECT_EQ(Read(folder.path() / "out/sparse/cameras.bin"), "new");
  EXPECT_FALSE(fs::exists(folder.path() / "out/log"));
}

TEST(StagedOutput, LeavesLinksToWhatIsNotThere) {
  const TemporaryFolder folder;
  const fs::path link = folder.path() / "link";
  fs::create_symlink(folder.path() / "not_there", link);
  for (const fs::path& output : {link, link / "sub"}) {
    EXPECT_FALSE(StagedOutput::Create(output).ok());
    EXPECT_TRUE(fs::is_symlink(link));
  }
}

TEST(StagedOutput, SaysWhereItCannotWrite) {
  const TemporaryFolder folder;
  const fs::path file = folder.Write("file", "text");
  const auto output = StagedOutput::Create(file / "out");
  EXPECT_EQ(output.status().code(), StatusCode::kNotFound);
  EXPECT_THAT(output.status().message(),
              testing::AllOf(testing::HasSubstr(file.string()),
                             testing::HasSubstr("--output_path")));
  EXPECT_EQ(Read(file), "text");
}

}  // namespace
}  // namespace curvix

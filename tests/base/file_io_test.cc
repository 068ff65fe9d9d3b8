// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <csignal>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/file_io.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FileIo : public ::testing::Test {
 protected:
  // The sorted names in the folder, one after the other.
  std::string Names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      names.insert(entry.path().filename().string() + " ");
    }
    return std::accumulate(names.begin(), names.end(), std::string());
  }
  fs::path Target() const { return folder_.path() / "target.bin"; }

  const TemporaryFolder folder_;
};

TEST_F(FileIo, WritesAndReplacesWholeFiles) {
  const std::string bytes("a\0b\r\n", 5);
  ASSERT_TRUE(WriteFileAtomically(Target(), "something longer").ok());
  ASSERT_TRUE(WriteFileAtomically(Target(), bytes).ok());
  EXPECT_EQ(*ReadFile(Target()), bytes);
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, DoesNotWriteThroughLinks) {
  const TemporaryFolder outside;
  const fs::path victim = outside.Write("victim", "precious");
  fs::create_symlink(victim, Target());
  ASSERT_TRUE(WriteFileAtomically(Target(), "new").ok());
  EXPECT_EQ(*ReadFile(victim), "precious");
  EXPECT_EQ(*ReadFile(Target()), "new");
  EXPECT_FALSE(fs::is_symlink(Target()));
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, LeavesAloneWhatHasTheNameOfItsTemporaryFile) {
  const TemporaryFolder outside;
  const fs::path victim = outside.Write("victim", "precious");
  // Twice at one place in memory, and so with one name.
  std::optional<FileWriter> file;
  file.emplace(Target());
  const fs::path temporary = fs::directory_iterator(folder_.path())->path();
  file.reset();
  fs::create_symlink(victim, temporary);
  file.emplace(Target());
  file->Append("new");
  ASSERT_TRUE(file->Finish().ok());
  EXPECT_EQ(*ReadFile(victim), "precious");
  EXPECT_TRUE(fs::is_symlink(temporary));
  EXPECT_FALSE(fs::is_symlink(Target()));
  EXPECT_EQ(*ReadFile(Target()), "new");
  FileWriter::RemoveLeftovers(Target());
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, TwoWritersOfOnePathBothWriteAllOfIt) {
  FileWriter first(Target());
  first.Append("all of the ");
  FileWriter second(Target());
  second.Append("half");
  first.Append("first");
  EXPECT_TRUE(first.Finish().ok());
  EXPECT_EQ(*ReadFile(Target()), "all of the first");
  second.Append(" and half");
  EXPECT_TRUE(second.Finish().ok());
  EXPECT_EQ(*ReadFile(Target()), "half and half");
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, ManyWritersOfOnePathLeaveTheFileOfOne) {
  constexpr int kNumWriters = 8;
  const auto content = [](int i) {
    return std::string(100000, static_cast<char>('a' + i));
  };
  std::atomic<int> num_written = 0;
  std::vector<std::thread> writers;
  for (int i = 0; i < kNumWriters; ++i) {
    writers.emplace_back([&, i] {
      for (int k = 0; k < 20; ++k) {
        num_written += WriteFileAtomically(Target(), content(i)).ok() ? 1 : 0;
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(num_written, 20 * kNumWriters);
  const std::string bytes = *ReadFile(Target());
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(bytes, content(bytes[0] - 'a'));
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, LeftoversOfKilledProgramsAreRemovedAndNothingElse) {
  for (const char* name :
       {"target.bin", "target.binary.7-1.tmp", "my.target.bin.7-1.tmp"}) {
    folder_.Write(name, "kept");
  }
  const std::string names = Names();
  folder_.Write("target.bin.tmp", "half");
  folder_.Write("target.bin.7-1.tmp", "half");
  folder_.Write("target.bin.1234567-0.tmp", "half");
  FileWriter::RemoveLeftovers(Target());
  EXPECT_EQ(Names(), names);
  FileWriter::RemoveLeftovers(folder_.path() / "none" / "target.bin");
}

TEST_F(FileIo, AFullDiskLeavesTheTargetAsItWas) {
  ASSERT_TRUE(WriteFileAtomically(Target(), "old").ok());
  rlimit old_limit;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = old_limit;
  limit.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const Status status = WriteFileAtomically(Target(), std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_THAT(status.message(), HasSubstr("free space"));
  EXPECT_EQ(*ReadFile(Target()), "old");
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, AFolderIsNoFile) {
  EXPECT_THAT(ReadFile(folder_.path()).status().message(),
              HasSubstr(" is a folder; name a file."));
  EXPECT_THAT(ReadFile(Target()).status().message(),
              HasSubstr("There is no file"));
}

TEST_F(FileIo, WritesPieceByPiece) {
  FileWriter file(Target());
  const ByteSink sink = file.Sink();
  sink("a");
  sink("");
  sink("bc");
  EXPECT_FALSE(fs::exists(Target()));
  ASSERT_TRUE(file.Finish().ok());
  EXPECT_EQ(*ReadFile(Target()), "abc");
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, AFileThatIsNotFinishedLeavesTheTargetAsItWas) {
  ASSERT_TRUE(WriteFileAtomically(Target(), "old").ok());
  { FileWriter(Target()).Append("new"); }
  EXPECT_EQ(*ReadFile(Target()), "old");
  EXPECT_EQ(Names(), "target.bin ");
}

TEST_F(FileIo, AReadOnlyFolderLeavesTheTargetAsItWas) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  ASSERT_TRUE(WriteFileAtomically(Target(), "old").ok());
  fs::permissions(folder_.path(),
                  fs::perms::owner_read | fs::perms::owner_exec);
  const Status status = WriteFileAtomically(Target(), "new");
  fs::permissions(folder_.path(), fs::perms::owner_all);
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_EQ(*ReadFile(Target()), "old");
}

TEST_F(FileIo, AMissingFolderIsNamed) {
  const Status status =
      WriteFileAtomically(folder_.path() / "none" / "a.ply", "new");
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_THAT(status.message(), HasSubstr("none/a.ply"));
  EXPECT_THAT(status.message(), HasSubstr("No such file"));
}

TEST_F(FileIo, AFolderIsNotReplacedByAFile) {
  fs::create_directories(Target() / "inside");
  const Status status = WriteFileAtomically(Target(), "new");
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_EQ(Names(), "target.bin ");
  EXPECT_TRUE(fs::is_directory(Target() / "inside"));
}

TEST_F(FileIo, ReadingWhatIsNotAFileIsNotFound) {
  EXPECT_EQ(ReadFile(Target()).status().code(), StatusCode::kNotFound);
  EXPECT_EQ(ReadFile(folder_.path()).status().code(), StatusCode::kNotFound);
}

TEST_F(FileIo, ReadsWholeFiles) {
  constexpr std::array<std::size_t, 6> kSizes = {
      0, 1, 65535, 65536, 65537, 200000};
  for (const std::size_t size : kSizes) {
    std::string bytes(size, 'x');
    for (std::size_t i = 0; i < size; i += 1001) bytes[i] = '\n';
    ASSERT_TRUE(WriteFileAtomically(Target(), bytes).ok());
    EXPECT_EQ(*ReadFile(Target()), bytes);
  }
}

TEST_F(FileIo, TellsOfAnErrorWhileReading) {
  // Nothing is at the address 0.
  const fs::path path = "/proc/self/mem";
  if (!fs::exists(path)) GTEST_SKIP() << "there is no " << path;
  const Status status = ReadFile(path).status();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_THAT(status.message(), HasSubstr("Input/output error"));
}

}  // namespace
}  // namespace curvix

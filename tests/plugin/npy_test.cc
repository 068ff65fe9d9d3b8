// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <bit>
#include <limits>

#include "base/file_io.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// The numbers 0 to 15 row by row.
Eigen::Matrix4d Counting() {
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = i;
  return matrix;
}

template <typename T>
std::string Bytes(std::endian order) {
  std::string all;
  for (int number = 0; number < 16; ++number) {
    std::string bytes;
    AppendLittleEndian(static_cast<T>(number), bytes);
    if (order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    all += bytes;
  }
  return all;
}

TEST(Npy, ReadsBothPrecisionsAndByteOrders) {
  const std::pair<std::string, std::string> kinds[] = {
      {"'<f4'", Bytes<float>(std::endian::little)},
      {"'>f4'", Bytes<float>(std::endian::big)},
      {"'<f8'", Bytes<double>(std::endian::little)},
      {"'>f8'", Bytes<double>(std::endian::big)}};
  for (const auto& [descr, values] : kinds) {
    const auto matrix =
        ParseNpy(NpyFile(descr, "False", "(4, 4)", values), "a");
    ASSERT_TRUE(matrix.ok()) << matrix.status().message();
    EXPECT_EQ(*matrix, Counting()) << descr;
  }
}

TEST(Npy, ReadsFortranOrder) {
  const std::string values = Bytes<double>(std::endian::little);
  const auto matrix = ParseNpy(NpyFile("'<f8'", "True", "(4, 4)", values), "a");
  ASSERT_TRUE(matrix.ok()) << matrix.status().message();
  EXPECT_EQ(*matrix, Eigen::Matrix4d(Counting().transpose()));
}

TEST(Npy, ReadsVersionsAndPython2) {
  const std::string values = Bytes<float>(std::endian::little);
  for (const char version : {'\1', '\2', '\3'}) {
    for (const char* shape : {"(4, 4)", "(4,4,)", "(4L, 4L)"}) {
      const std::string file =
          NpyFile("'<f4'", "False", shape, values, version);
      EXPECT_TRUE(ParseNpy(file, "a").ok()) << shape << int{version};
    }
  }
}

TEST(Npy, RefusesEveryTruncation) {
  const std::string file = NpyOfMatrix(Eigen::Matrix4d::Identity());
  ASSERT_TRUE(ParseNpy(file, "a").ok());
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_EQ(ParseNpy(file.substr(0, size), "a").status().code(),
              StatusCode::kDataLoss)
        << size;
  }
}

TEST(Npy, RefusesOtherShapes) {
  for (const char* shape : {"(18446744073709551615,)",
                            "(4294967296, 4294967296, 2)",
                            "(16,)",
                            "(2, 8)",
                            "(1, 4, 4)",
                            "(4, 4, 1)",
                            "()",
                            "(-4, -4)",
                            "(4, x)",
                            "4, 4",
                            "(4, 4"}) {
    const auto matrix = ParseNpy(
        NpyFile("'<f8'", "False", shape, Bytes<double>(std::endian::little)),
        "world_mat_0");
    EXPECT_EQ(matrix.status().code(), StatusCode::kDataLoss) << shape;
    EXPECT_THAT(matrix.status().message(), HasSubstr("world_mat_0"));
  }
}

TEST(Npy, NamesTheTypeThatItDoesNotRead) {
  for (const char* descr : {"'<i8'", "'|O'", "'<c16'", "'f8'", "''"}) {
    const auto matrix =
        ParseNpy(NpyFile(descr, "False", "(1,)", "12345678"), "a");
    EXPECT_EQ(matrix.status().code(), StatusCode::kUnsupported) << descr;
  }
  const auto records =
      ParseNpy(NpyFile("[('x', '<f8')]", "False", "(1,)", "12345678"), "a");
  EXPECT_THAT(records.status().message(), HasSubstr("records"));
}

TEST(Npy, RefusesNaN) {
  Eigen::Matrix4d hole = Counting();
  hole(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ParseNpy(NpyOfMatrix(hole), "a").status().message(),
              HasSubstr("NaN"));
}

const auto kAll = [](const std::string&) { return true; };

TEST(Npz, UnpacksWhatIsWanted) {
  const TemporaryFolder folder;
  const Eigen::Matrix4d matrix = Eigen::Matrix4d::Random();
  const auto path = folder.path() / "a.npz";
  WriteNpz(path, {{"one", NpyOfMatrix(matrix)}, {"other", "no array"}});
  const auto matrices =
      ReadNpz(path, [](const std::string& name) { return name == "one"; });
  ASSERT_TRUE(matrices.ok()) << matrices.status().message();
  ASSERT_EQ(matrices->size(), 1u);
  EXPECT_EQ(matrices->at("one"), matrix);
  EXPECT_EQ(ReadNpz(path, kAll).status().code(), StatusCode::kDataLoss);
}

TEST(Npz, RefusesEveryTruncationAndSurvivesEveryFlippedByte) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.npz";
  WriteNpz(path, {{"one", NpyOfMatrix(Eigen::Matrix4d::Identity())}});
  const std::string file = *ReadFile(path);
  for (std::size_t size = 0; size < file.size(); ++size) {
    folder.Write("cut.npz", file.substr(0, size));
    EXPECT_FALSE(ReadNpz(folder.path() / "cut.npz", kAll).ok()) << size;
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string flipped = file;
    flipped[i] = static_cast<char>(~flipped[i]);
    folder.Write("flipped.npz", flipped);
    const auto matrices = ReadNpz(folder.path() / "flipped.npz", kAll);
    if (!matrices.ok() || !matrices->contains("one")) continue;
    EXPECT_EQ(matrices->at("one"), Eigen::Matrix4d::Identity());
  }
}

TEST(Npz, DoesNotUnpackBombs) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bomb.npz";
  WriteNpz(path, {{"one", std::string(4 << 20, '\0')}});
  EXPECT_LT(std::filesystem::file_size(path), 10000u);
  EXPECT_THAT(ReadNpz(path, kAll).status().message(), HasSubstr("megabyte"));
}

}  // namespace
}  // namespace curvix

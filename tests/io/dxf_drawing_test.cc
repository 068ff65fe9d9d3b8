// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "base/file_io.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

TEST(EncodeDxfDrawing, DeclaresTheUnitThatItKnows) {
  const TemporaryFolder folder;
  const auto written = [&](const char* unit) {
    const auto path = folder.path() / "a.dxf";
    EXPECT_TRUE(WriteDrawing(path, FittedCurves(), unit).ok());
    return *ReadFile(path);
  };
  EXPECT_THAT(written("mm"), HasSubstr("$INSUNITS\n70\n4\n"));
  EXPECT_THAT(written("ft"), HasSubstr("$INSUNITS\n70\n2\n"));
  EXPECT_THAT(written("rods"), HasSubstr("$INSUNITS\n70\n0\n"));
  EXPECT_THAT(written(""), HasSubstr("$INSUNITS\n70\n0\n"));
}

}  // namespace
}  // namespace curvix

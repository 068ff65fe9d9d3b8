// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <iterator>

#include "gtest/gtest.h"
#include "plugin/commands/help_text.h"

namespace curvix {
namespace {

TEST(OptionsDoc, IsWhatTheProgramPrints) {
  std::ifstream file(CURVIX_SOURCE_DIR "/docs/options.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(text, OptionsMarkdown())
      << "Run: colmap_curvix help --markdown > docs/options.md";
}

}  // namespace
}  // namespace curvix

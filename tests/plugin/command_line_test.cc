// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/command_line.h"

#include <sstream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/help_text.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A program with every kind of flag.
class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    sections_.push_back(
        {"Paths",
         {Required(PathFlag("workspace_path", &workspace_path_, "folder")),
          PathFlag("project_path", &project_path_, "file"),
          ChoiceFlag("color", {"red", "blue"}, &color_, "what color"),
          Switch("json", &json_, "machine-readable")}});
    for (FlagSection& section : OptionSections(options_)) {
      sections_.push_back(std::move(section));
    }
  }

  Result<Request> Parse(const std::vector<std::string>& arguments) {
    return ParseFlags(arguments, sections_);
  }
  std::string Error(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--workspace_path", "w"});
    const Result<Request> request = Parse(arguments);
    EXPECT_EQ(request.status().code(), StatusCode::kInvalidArgument);
    return request.status().message();
  }
  std::string ProjectFile(const std::string& text) {
    return folder_.Write("project.ini", text).string();
  }

  TemporaryFolder folder_;
  std::filesystem::path workspace_path_;
  std::filesystem::path project_path_;
  std::string color_ = "red";
  bool json_ = false;
  Options options_;
  std::vector<FlagSection> sections_;
};

TEST_F(CommandLine, SetsFlagsOfEveryKind) {
  const auto request = Parse({"--workspace_path=a b",
                              "--color",
                              "blue",
                              "--json",
                              "--num_threads",
                              "-1",
                              "--CurveRefinement.enabled",
                              "0",
                              "--Hypotheses.view_selection",
                              "unused_edges",
                              "--Hypotheses.location_tolerance_px",
                              "0.4"});
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(*request, Request::kRun);
  EXPECT_EQ(workspace_path_, "a b");
  EXPECT_EQ(color_, "blue");
  EXPECT_TRUE(json_);
  EXPECT_EQ(options_.runtime.num_threads, -1);
  EXPECT_FALSE(options_.curve_refinement.enabled);
  EXPECT_EQ(options_.hypotheses.view_selection, ViewSelection::kUnusedEdges);
  EXPECT_EQ(options_.hypotheses.location_tolerance_px, 0.4);
}

TEST_F(CommandLine, ReadsAProjectFileWithSections) {
  const std::string path = ProjectFile(
      "# comment\nworkspace_path = w x\r\ncolor=blue\n\n"
      "[Validation]\nmax_angle_deg=7\n[EdgeDetection]\nsigma_px=2\n");
  const auto request = Parse({"--project_path", path});
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(workspace_path_, "w x");
  EXPECT_EQ(color_, "blue");
  EXPECT_EQ(options_.validation.max_angle_deg, 7);
  EXPECT_EQ(options_.edge_detection.sigma_px, 2);
}

TEST_F(CommandLine, AProjectFileMayHaveAByteOrderMarkAndOtherComments) {
  const std::string path = ProjectFile(
      "\xEF\xBB\xBFworkspace_path=w\n; comment\n  ;color=red\ncolor=blue\n");
  const auto request = Parse({"--project_path", path});
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(workspace_path_, "w");
  EXPECT_EQ(color_, "blue");
}

TEST_F(CommandLine, PathsInAProjectFileMayHoldAnything) {
  const std::string path =
      ProjectFile("  # comment = 1\nworkspace_path = /a #1/b=c [d]\t\n");
  ASSERT_TRUE(Parse({"--project_path", path}).ok());
  EXPECT_EQ(workspace_path_, "/a #1/b=c [d]");
}

TEST_F(CommandLine, ArgumentsWinOverTheProjectFile) {
  const std::string path = ProjectFile(
      "workspace_path=from_file\n[Validation]\nmax_angle_deg=7\n"
      "min_num_support_views=6\n");
  for (const bool is_first : {true, false}) {
    options_ = Options();
    std::vector<std::string> arguments = {"--Validation.max_angle_deg", "9"};
    arguments.insert(is_first ? arguments.begin() : arguments.end(),
                     {"--project_path", path});
    ASSERT_TRUE(Parse(arguments).ok());
    EXPECT_EQ(options_.validation.max_angle_deg, 9);
    EXPECT_EQ(options_.validation.min_num_support_views, 6);
    EXPECT_EQ(workspace_path_, "from_file");
  }
}

TEST_F(CommandLine, APresetDoesNotChangeAProjectFile) {
  std::string preset;
  sections_.front().flags.push_back(TextFlag("preset", &preset, ""));
  const std::string path = ProjectFile("workspace_path=w\npreset=default\n");
  EXPECT_TRUE(Parse({"--project_path", path, "--preset", "default"}).ok());
  const auto request = Parse({"--project_path", path, "--preset", "paper"});
  EXPECT_THAT(request.status().message(), HasSubstr("would not change"));
}

TEST_F(CommandLine, AWorkspaceTakesThePathsOfTheProjectFileWithIt) {
  std::filesystem::path input_path;
  sections_.front().flags.push_back(PathFlag("input_path", &input_path, ""));
  for (const auto& [written, read] :
       {std::pair("/old/./sparse/0", "new/sparse/0"),
        std::pair("/old", "new/."),
        std::pair("/older/sparse", "/older/sparse"),
        std::pair("/old/../x", "/old/../x")}) {
    const std::string path = ProjectFile(
        std::string("workspace_path=/old/.\ninput_path=") + written);
    ASSERT_TRUE(
        Parse({"--project_path", path, "--workspace_path", "new"}).ok());
    EXPECT_EQ(workspace_path_, "new");
    EXPECT_EQ(input_path, read);
    ASSERT_TRUE(Parse({"--project_path", path}).ok());
    EXPECT_EQ(input_path, written);
  }
}

TEST_F(CommandLine, AProjectFileMayHaveFlagsOfOthers) {
  std::filesystem::path input_path;
  const std::vector<FlagSection> others = {
      {"Paths", {PathFlag("input_path", &input_path, "")}}};
  const std::string path = ProjectFile("workspace_path=w\ninput_path=x\n");
  EXPECT_TRUE(ParseFlags({"--project_path", path}, sections_, others).ok());
  EXPECT_EQ(workspace_path_, "w");
  EXPECT_EQ(input_path, "");
  EXPECT_FALSE(Parse({"--project_path", path}).ok());
  EXPECT_FALSE(
      ParseFlags({"--workspace_path=w", "--input_path=x"}, sections_, others)
          .ok());
}

TEST_F(CommandLine, ErrorsInTheProjectFileNameItsLineAndKey) {
  for (const auto& [text, error] :
       {std::pair("color=red\n[Validation]\nmax_angel_deg=7\n",
                  "line 3: There is no option 'max_angel_deg' in [Validation]; "
                  "did you mean 'max_angle_deg' in [Validation]?"),
        std::pair("colour=red\n",
                  "line 1: There is no option 'colour'; did you mean 'color'?"),
        std::pair("\nhelp=1\n",
                  "line 2: There is no option 'help'; --help_all"),
        std::pair("# a\n\n[Validation]\nmax_angle_deg = -1\n",
                  "line 4: Validation.max_angle_deg is -1; it must be > 0"),
        std::pair("color=\n", "line 1: color is empty; it must be one of"),
        std::pair("no equals sign\n", "line 1 is neither name=value nor"),
        std::pair("color=red\n; b\ncolor=blue\n",
                  "line 3: 'color' is given twice, first in line 1")}) {
    const std::string path = ProjectFile(text);
    EXPECT_THAT(Error({"--project_path", path}),
                StartsWith(path + ", " + error));
  }
  const auto missing = Parse({"--project_path", "/no/such/file.ini"});
  EXPECT_EQ(missing.status().code(), StatusCode::kNotFound);
  EXPECT_THAT(missing.status().message(), HasSubstr("/no/such/file.ini"));
}

TEST_F(CommandLine, SuggestsTheNearestName) {
  EXPECT_THAT(Error({"--workspce_path", "x"}),
              AllOf(HasSubstr("'--workspce_path'"),
                    HasSubstr("did you mean '--workspace_path'?")));
  EXPECT_THAT(Error({"--sigma_px=1"}),
              HasSubstr("did you mean '--EdgeDetection.sigma_px'?"));
  EXPECT_THAT(Error({"--validation.Max_Angle_deg", "3"}),
              HasSubstr("did you mean '--Validation.max_angle_deg'?"));
  EXPECT_THAT(Error({"--completely_different_thing", "3"}),
              AllOf(HasSubstr("--completely_different_thing"),
                    Not(HasSubstr("did you mean"))));
}

TEST_F(CommandLine, SuggestsANameOfTheSameSection) {
  for (const std::string name : {"CurveFilter.min_length",
                                 "curvefilter.min_length_px",
                                 "CurveFiltr.MIN_LENGHT_PX"}) {
    EXPECT_THAT(Error({"--" + name, "3"}),
                HasSubstr("did you mean '--CurveFilter.min_length_px'?"));
  }
  EXPECT_THAT(Error({"--CurveRefinement.max_gap", "3"}),
              HasSubstr("did you mean '--CurveRefinement.max_gap_px'?"));
}

TEST_F(CommandLine, DoesNotGuessAbbreviations) {
  EXPECT_THAT(Error({"--num_thread", "2"}), HasSubstr("'--num_threads'"));
  EXPECT_THAT(Error({"-w", "2"}), HasSubstr("'-w'"));
}

TEST_F(CommandLine, NamesTheMissingOption) {
  const auto request = Parse({"--num_threads", "2"});
  EXPECT_EQ(request.status().message(),
            "The option '--workspace_path' is required but missing");
}

TEST_F(CommandLine, RefusesValuesOutsideTheRange) {
  EXPECT_THAT(Error({"--Validation.max_angle_deg", "-1"}),
              HasSubstr("Validation.max_angle_deg is -1; it must be > 0"));
  EXPECT_THAT(Error({"--color", "green"}),
              HasSubstr("color is green; it must be one of red, blue"));
  EXPECT_THAT(Error({"--num_threads", "two"}), HasSubstr("num_threads is two"));
}

TEST_F(CommandLine, RefusesTwiceNothingAndStrayWords) {
  EXPECT_THAT(Error({"--color", "red", "--color", "blue"}),
              HasSubstr("'--color' is given twice"));
  EXPECT_THAT(Error({"--color"}), HasSubstr("--color"));
  EXPECT_THAT(Error({"stray"}), HasSubstr("'stray' is not expected"));
}

TEST_F(CommandLine, HelpNeedsNothingElse) {
  for (const char* help : {"-h", "--help"}) {
    const auto request = Parse({"--num_threads", "nonsense", help});
    ASSERT_TRUE(request.ok());
    EXPECT_EQ(*request, Request::kHelp);
  }
  const auto request = Parse({"--help_all", "--num_threads", "nonsense"});
  ASSERT_TRUE(request.ok());
  EXPECT_EQ(*request, Request::kHelpAll);
}

TEST_F(CommandLine, ShortHelpLeavesAdvancedOptionsOut) {
  const std::string help =
      HelpText("program [options]", "Does it.", sections_, false);
  EXPECT_THAT(help, HasSubstr("--num_threads arg"));
  EXPECT_THAT(help, HasSubstr("--CurveFilter.max_sigma_px arg"));
  EXPECT_THAT(help, Not(HasSubstr("--Consolidation.")));
  EXPECT_THAT(help, Not(HasSubstr("\nConsolidation\n")));
  EXPECT_THAT(help, HasSubstr("'--help_all' lists "));
}

TEST_F(CommandLine, FullHelpMentionsEveryOptionWithDefaultAndRange) {
  const std::string help =
      HelpText("program [options]", "Does it.", sections_, true);
  for (const FlagSection& section : sections_) {
    EXPECT_THAT(help, HasSubstr("\n" + section.title + "\n"));
  }
  for (const OptionRow& row : OptionTable(options_)) {
    EXPECT_THAT(help,
                HasSubstr("--" + FullName(row) + " arg (=" + ValueText(row)));
    EXPECT_THAT(help, HasSubstr(RangeText(row)));
  }
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 80u) << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
  }
}

}  // namespace
}  // namespace curvix

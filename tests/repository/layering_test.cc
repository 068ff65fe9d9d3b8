// SPDX-License-Identifier: BSD-3-Clause
// Who may include whom: the table of docs/architecture.md, held against every
// #include of src/, plugin/, include/ and examples/.
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/repository/source_tree.h"

namespace curvix {
namespace {

using Names = std::set<std::string>;

// What the files of one folder may include besides <curvix/...>, the standard
// library, Eigen and their own folder.
struct Rule {
  Names folders;    // of src/
  Names libraries;  // first part of <library/...>, or all of <library.hpp>
};

Rule Stage(Names libraries = {}, Names folders = {}) {
  folders.insert({"base", "geometry", "model"});
  return {std::move(folders), std::move(libraries)};
}

// The folders of src/, by name; the others by their path.
const std::map<std::string, Rule>& Rules() {
  static const Names kStages = {"edge_detection",
                                "edge_sketch",
                                "paper",
                                "curve_drawing",
                                "curve_refinement",
                                "curve_kinds"};
  static const std::map<std::string, Rule> rules = {
      {"include/curvix", {}},
      {"base", {{}, {"malloc.h", "nanoflann.hpp"}}},
      {"model", {{"base"}, {}}},
      {"geometry", {{"base", "model"}, {}}},
      {"colmap", {{"base", "geometry"}, {}}},
      {"edge_detection", Stage({"opencv2"})},
      {"edge_sketch", Stage()},
      {"paper", Stage({}, {"edge_sketch"})},
      {"curve_drawing", Stage({}, {"edge_sketch"})},
      {"curve_refinement", Stage({"ceres"})},
      {"curve_kinds", Stage({"opencv2"}, {"edge_detection"})},
      {"poses",
       Stage({"ceres"}, {"edge_detection", "edge_sketch", "pipeline"})},
      {"parts", Stage({}, {"edge_sketch"})},
      {"fitting", Stage({"ceres"})},
      {"measuring", Stage()},
      {"drawing", Stage()},
      {"io", Stage({"pcl"}, {"drawing", "parts"})},
      {"evaluation", Stage({"opencv2"}, {"edge_detection", "synthetic"})},
      {"synthetic", Stage()},
      {"pipeline", Stage({}, kStages)},
      {"plugin",
       {{"base",
         "geometry",
         "colmap",
         "drawing",
         "edge_detection",
         "evaluation",
         "fitting",
         "io",
         "measuring",
         "parts",
         "synthetic"},
        {"boost",
         "cpl_conv.h",
         "gdal_utils.h",
         "glog",
         "nlohmann",
         "ogr_srs_api.h",
         "opencv2",
         "pybind11",
         "zip.h"}}},
      {"examples", {}}};
  return rules;
}

// "src/base/check.h" is in "base", "plugin/base/text.h" in "plugin".
std::string FolderOf(const std::string& file) {
  if (file.rfind("plugin/", 0) == 0) return "plugin";
  const std::string folder = file.substr(0, file.rfind('/'));
  return folder.rfind("src/", 0) == 0 ? folder.substr(4) : folder;
}

std::string FirstPart(const std::string& path) {
  return path.substr(0, path.find('/'));
}

// <vector>, and the headers of POSIX.
bool IsSystemHeader(const std::string& path) {
  static const Names posix = {
      "dlfcn.h", "fcntl.h", "signal.h", "stdlib.h", "unistd.h"};
  return path.find_first_of("/.") == std::string::npos ||
         posix.contains(path) || FirstPart(path) == "sys";
}

bool IsThreadHeader(const std::string& path) {
  static const Names headers = {"thread",
                                "mutex",
                                "shared_mutex",
                                "atomic",
                                "future",
                                "condition_variable",
                                "omp.h",
                                "execution"};
  return headers.contains(path);
}

bool MayUseThreads(const std::string& file) {
  return file == "src/base/parallel.cc" || file.rfind("src/", 0) != 0;
}

std::optional<std::string> WhyNotAngled(const std::string& file,
                                        const std::string& path,
                                        const Rule& rule) {
  if (IsThreadHeader(path) && !MayUseThreads(file)) {
    return "threads belong to src/base/parallel.cc";
  }
  if (path.rfind("curvix/", 0) == 0) {
    if (ExistsInTree("include/" + path)) return std::nullopt;
    return "there is no such public header";
  }
  if (IsSystemHeader(path) || FirstPart(path) == "Eigen" ||
      path.rfind("unsupported/Eigen/", 0) == 0 ||
      rule.libraries.contains(FirstPart(path))) {
    return std::nullopt;
  }
  return "this folder does not own that library";
}

// The folder of plugin/ that a file is in; "" for others.
std::string PluginFolderOf(const std::string& file) {
  static const std::regex pattern(R"(plugin/(\w+)/.*)");
  std::smatch match;
  return std::regex_match(file, match, pattern) ? match[1].str() : "";
}

// In the order of the data: each may use those before it.
bool MayUseInPlugin(const std::string& folder, const std::string& other) {
  static const std::vector<std::string> folders = {"base",
                                                   "imports",
                                                   "export",
                                                   "poses",
                                                   "run",
                                                   "align",
                                                   "draw",
                                                   "commands",
                                                   "python"};
  const auto at = std::find(folders.begin(), folders.end(), folder);
  return folder.empty() ||
         (at != folders.end() &&
          std::find(folders.begin(), at + 1, other) != at + 1);
}

std::optional<std::string> WhyNotQuoted(const std::string& file,
                                        const std::string& path,
                                        const Rule& rule) {
  const std::string own = FolderOf(file);
  const bool in_src = file.rfind("src/", 0) == 0;
  if (own != "plugin" && !in_src) return "only public headers may be used here";
  const std::string other = FolderOf(path);
  if (!ExistsInTree((other == "plugin" ? "" : "src/") + path)) {
    return "includes name the file from src/, those of plugin/ from the root";
  }
  if (own == "plugin" && other == "plugin" &&
      !MayUseInPlugin(PluginFolderOf(file), PluginFolderOf(path))) {
    return "plugin/" + PluginFolderOf(file) + " comes before what it uses";
  }
  if (other == own || rule.folders.contains(other)) return std::nullopt;
  return own + " may not use " + other;
}

// `include` is what follows #include: "<vector>" or "\"base/check.h\"".
// nullopt: allowed.
std::optional<std::string> WhyNot(const std::string& file,
                                  const std::string& include) {
  const auto rule = Rules().find(FolderOf(file));
  if (rule == Rules().end()) {
    return FolderOf(file) + " is in no layer; add it to the table";
  }
  const std::string path = include.substr(1, include.size() - 2);
  return include[0] == '<' ? WhyNotAngled(file, path, rule->second)
                           : WhyNotQuoted(file, path, rule->second);
}

std::vector<std::string> IncludesOf(const std::string& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"][^>"]+[>"]).*)");
  std::vector<std::string> includes;
  std::smatch match;
  for (const std::string& line : Lines(ReadSource(file))) {
    if (std::regex_match(line, match, pattern)) includes.push_back(match[1]);
  }
  return includes;
}

TEST(Layering, EveryIncludeIsAllowed) {
  const auto files = FilesBelow({"src", "plugin", "include", "examples"},
                                {".h", ".cc", ".hpp", ".cpp"});
  int num_includes = 0;
  for (const std::string& file : files) {
    for (const std::string& include : IncludesOf(file)) {
      ++num_includes;
      const auto why_not = WhyNot(file, include);
      EXPECT_FALSE(why_not.has_value())
          << file << " includes " << include << ": " << *why_not;
    }
  }
  EXPECT_GT(num_includes, 500);  // it did read them
}

struct Use {
  std::string file;
  std::string include;
};

TEST(Layering, AllowsWhatTheTableAllows) {
  const std::vector<Use> uses = {
      {"src/curve_refinement/x.cc", "\"base/check.h\""},
      {"src/curve_refinement/x.cc", "\"curve_refinement/curve_ends.h\""},
      {"src/curve_refinement/x.cc", "<Eigen/Core>"},
      {"src/curve_refinement/x.cc", "<curvix/edges.h>"},
      {"src/curve_refinement/x.cc", "<vector>"},
      {"src/base/parallel.cc", "<thread>"},
      {"src/pipeline/x.cc", "\"paper/align_edges.h\""},
      {"src/io/x.cc", "<pcl/point_types.h>"},
      {"plugin/run/x.cc", "\"base/check.h\""},
      {"plugin/run/x.cc", "<boost/program_options.hpp>"},
      {"plugin/run/x.cc", "\"plugin/base/text.h\""},
      {"examples/x.cc", "<curvix/curvix.h>"}};
  for (const Use& use : uses) {
    EXPECT_EQ(WhyNot(use.file, use.include), std::nullopt)
        << use.file << ' ' << use.include;
  }
}

TEST(Layering, RefusesWhatTheTableDoesNotAllow) {
  const std::vector<Use> uses = {
      {"src/curve_refinement/x.cc", "\"curve_drawing/group_edges.h\""},
      {"src/curve_refinement/x.cc", "\"curve_ends.h\""},
      {"src/curve_refinement/x.cc", "\"../base/check.h\""},
      {"src/curve_refinement/x.cc", "\"pipeline/sketch_edges.h\""},
      {"src/curve_refinement/x.cc", "<opencv2/core.hpp>"},
      {"src/curve_refinement/x.cc", "<nanoflann.hpp>"},
      {"src/curve_refinement/x.cc", "<thread>"},
      {"src/curve_refinement/x.cc", "<omp.h>"},
      {"src/curve_refinement/x.cc", "<curvix/no_such_header.h>"},
      {"src/model/x.h", "\"geometry/epipolar.h\""},
      {"src/base/x.h", "\"model/posed_view.h\""},
      {"src/pipeline/x.cc", "\"io/curve_formats.h\""},
      {"src/pipeline/x.cc", "\"synthetic/surfaces.h\""},
      {"src/new_folder/x.cc", "<vector>"},
      {"plugin/run/x.cc", "\"curve_drawing/group_edges.h\""},
      {"plugin/run/x.cc", "<pcl/point_types.h>"},
      {"plugin/base/x.cc", "\"plugin/run/run_report.h\""},
      {"plugin/new_folder/x.cc", "\"plugin/base/text.h\""},
      {"include/curvix/x.h", "\"base/check.h\""},
      {"include/curvix/x.h", "<opencv2/core.hpp>"},
      {"examples/x.cc", "\"plugin/base/text.h\""}};
  for (const Use& use : uses) {
    EXPECT_NE(WhyNot(use.file, use.include), std::nullopt)
        << use.file << ' ' << use.include;
  }
}

}  // namespace
}  // namespace curvix

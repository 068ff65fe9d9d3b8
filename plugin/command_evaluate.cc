// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "plugin/command_parts.h"
#include "plugin/evaluate.h"

namespace curvix {

ExitCode RunEvaluate(const Arguments& arguments) {
  std::filesystem::path curves_path;
  std::filesystem::path truth_path;
  bool json = false;
  EvaluationOptions options;
  const std::optional<ExitCode> code = ParseCommand(
      "evaluate",
      arguments,
      {{"Files",
        {Required(PathFlag("curves_path",
                           &curves_path,
                           "curves.ply, curves.obj or curves.txt")),
         Required(PathFlag("truth_path",
                           &truth_path,
                           "the exact curves: gt.txt of synthesize, say")),
         Switch("json", &json, "print one JSON object instead of a table")}},
       {"Measure",
        {RowFlag({.name = "unit_mm",
                  .field = &options.unit_mm,
                  .min_is_excluded = true,
                  .unit = "mm",
                  .help = "length of a world unit; thresholds are 5, 10 and "
                          "20 mm"}),
         RowFlag({.name = "step",
                  .field = &options.step,
                  .min_is_excluded = true,
                  .unit = "world units",
                  .help = "distance of the samples compared"}),
         RowFlag({.name = "min_num_views",
                  .field = &options.min_num_views,
                  .help = "true samples count as visible if so many views "
                          "show an edge there"})}}});
  if (code) return *code;
  const Status status =
      RunEvaluate(curves_path,
                  truth_path,
                  options,
                  json ? EvaluationFormat::kJson : EvaluationFormat::kTable,
                  std::cout);
  return status.ok() ? kExitSuccess : Fail(status, ExitCodeOf(status));
}

}  // namespace curvix

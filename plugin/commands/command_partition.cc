// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "base/count_text.h"
#include "plugin/base/progress.h"
#include "plugin/commands/commands.h"
#include "plugin/run/run_parts.h"

namespace curvix {
namespace {

FlagSection PartsSection(int* max_views_per_part) {
  return {"Parts",
          {RowFlag({.name = "max_views_per_part",
                    .field = max_views_per_part,
                    .min = 3,
                    .max = 1000000,
                    .help = "most images that a part is reconstructed "
                            "from, those around it included"})}};
}

}  // namespace

ExitCode RunPartitionCommand(const Arguments& arguments) {
  RunSettings settings;
  int max_views_per_part = 150;
  const std::optional<ExitCode> code = ParseCommand(
      "partition",
      arguments,
      {PathsSection(&settings), PartsSection(&max_views_per_part)});
  if (code) return *code;
  const auto partition = WithProgress([&](ProgressPrinter& progress) {
    return RunPartition(settings, max_views_per_part, progress);
  });
  if (!partition.ok()) return Fail(partition.status());
  for (std::size_t i = 0; i < partition->parts.size(); ++i) {
    const ScenePart& part = partition->parts[i];
    std::cout << "part " << i << ": " << Plural(part.view_idxs.size(), "view")
              << ", " << part.own_view_idxs.size() << " of its own\n";
  }
  std::cout << "Next, for each part: colmap_curvix reconstruct --part K, then "
               "colmap_curvix merge, with the same paths and options"
            << std::endl;
  return kExitSuccess;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "plugin/base/progress.h"
#include "plugin/commands/commands.h"
#include "plugin/draw/draw_workspace.h"

namespace curvix {
namespace {

std::vector<FlagSection> Sections(DrawSettings* s) {
  return {
      PathsSection(&s->run),
      {"View",
       {TextFlag(
            "plane",
            &s->plane,
            "xy (plan), xz (front), yz (side), several with commas "
            "between, 'nodes A B C', or auto: which most photographs face"),
        Switch("from_behind", &s->from_behind, "seen from the other side"),
        ChoiceFlag("hidden",
                   {"dashed", "omitted", "solid"},
                   &s->hidden,
                   "lines that the photographs from this side do not show"),
        TextFlag("slice",
                 &s->slice,
                 "FROM,TO: draw only what lies between, along the third axis "
                 "or, of nodes, from their plane towards the viewer"),
        TextFlag("crop",
                 &s->crop,
                 "LEFT,BOTTOM,RIGHT,TOP: draw only what lies between, in the "
                 "coordinates of the drawing; all: draw also what lies far "
                 "from the rest"),
        TextFlag("photograph",
                 &s->photograph,
                 "name of an image to put beneath, rectified; auto: the one "
                 "that shows most")}},
      {"Sheet",
       {TextFlag("scale",
                 &s->scale,
                 "as 1:50 or 2:1; default: the largest round one that fits"),
        ChoiceFlag("paper",
                   {"a4", "a3", "a2", "a1", "a0"},
                   &s->paper,
                   "size of the sheet, broad side down"),
        Switch("dimensions",
               &s->dimensions,
               "1: with the main lengths and radii, as well as they are known"),
        Switch("geopackage",
               &s->geopackage,
               "1: write a GeoPackage, too, for QGIS"),
        Switch("geojson", &s->geojson, "1: write GeoJSON, too"),
        TextFlag("title", &s->title, "default: the name of the workspace"),
        TextFlag("name",
                 &s->name,
                 "of the files; default: drawing_ and the plane, with "
                 "_section and _from_behind where they apply")}},
      RuntimeSection(&s->run)};
}

}  // namespace

Result<ExitCode> RunDraw(const Arguments& arguments) {
  DrawSettings settings;
  const std::optional<ExitCode> code =
      ParseCommand("draw", arguments, Sections(&settings));
  if (code) return *code;
  const Status valid = Check(settings);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);
  CURVIX_ASSIGN_OR_RETURN(const std::string summary,
                          WithProgress([&](RunProgress& progress) {
                            return DrawWorkspace(settings, progress);
                          }));
  std::cout << summary << std::flush;
  return kExitSuccess;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// From a COLMAP workspace to curves, in a program of your own.
//
//   05_curves_in_your_program proj curves.ply
#include <curvix/curvix.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: 05_curves_in_your_program <workspace> <curves.ply>\n";
    return 2;
  }
  const auto scene = curvix::ReadColmapScene(argv[1]);
  if (!scene.ok()) {
    std::cerr << scene.status().message() << '\n';
    return 1;
  }
  const auto result = curvix::ReconstructCurves(*scene);
  if (!result.ok()) {
    std::cerr << result.status().message() << '\n';
    return 1;
  }
  const auto written = curvix::WriteCurves(argv[2], result->curves);
  if (!written.ok()) {
    std::cerr << written.message() << '\n';
    return 1;
  }
  std::cout << result->curves.curves.size() << " curves\n";
  return 0;
}

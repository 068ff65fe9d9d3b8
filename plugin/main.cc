// SPDX-License-Identifier: BSD-3-Clause
#include <glog/logging.h>
#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core/utils/logger.hpp>

#include "plugin/base/progress.h"
#include "plugin/commands/commands.h"

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  // What is wrong with an image, the program says itself.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  curvix::CatchSignals();
  try {
    return curvix::RunProgram({argv + std::min(argc, 1), argv + argc});
  } catch (const std::bad_alloc&) {
    std::cerr << "ERROR: There is not enough memory for this scene. Lower "
                 "--num_threads or --EdgeDetection.max_edges_per_megapixel, or "
                 "divide the scene with 'colmap_curvix partition'.\n";
  } catch (const std::exception& error) {
    std::cerr << "ERROR: Something is wrong in colmap_curvix itself: "
              << error.what() << "\nPlease report it with this sentence.\n";
  }
  return curvix::kExitInternal;
}

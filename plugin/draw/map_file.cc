// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/map_file.h"

#ifdef CURVIX_HAS_GDAL
#include <cpl_conv.h>
#include <gdal_utils.h>

#include <memory>
#include <vector>
#endif

namespace curvix {

#ifdef CURVIX_HAS_GDAL

namespace {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

Status Failed(const std::filesystem::path& map) {
  return Status::ExternalTool("GDAL cannot write " + map.filename().string() +
                              ": " + std::string(CPLGetLastErrorMsg()));
}

}  // namespace

Status WriteMapFile(const std::filesystem::path& dxf,
                    const std::string& crs,
                    const std::filesystem::path& map) {
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  // Else it has the time of writing.
  CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z");
  std::vector<std::string> words = {
      "-f",
      map.extension() == ".gpkg" ? "GPKG" : "GeoJSON",
      "-nln",
      "curves",
      "-where",
      "Layer NOT IN ('FRAME', 'DIMENSIONS')"};
  if (!crs.empty()) words.insert(words.end(), {"-a_srs", crs});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::unique_ptr<GDALVectorTranslateOptions,
                        decltype(&GDALVectorTranslateOptionsFree)>
      options(GDALVectorTranslateOptionsNew(arguments.data(), nullptr),
              GDALVectorTranslateOptionsFree);
  const Dataset source(GDALOpenEx(dxf.c_str(),
                                  GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                  nullptr,
                                  nullptr,
                                  nullptr));
  Status status;
  if (source == nullptr || options == nullptr) {
    status = Failed(map);
  } else {
    GDALDatasetH input = source.get();
    int has_failed = 0;
    const Dataset written(GDALVectorTranslate(
        map.c_str(), nullptr, 1, &input, options.get(), &has_failed));
    if (written == nullptr || has_failed != 0) status = Failed(map);
  }
  CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr);
  CPLPopErrorHandler();
  return status;
}

#else

Status WriteMapFile(const std::filesystem::path& dxf,
                    const std::string& crs,
                    const std::filesystem::path& map) {
  return Status::Unsupported(
      "This program was built without GDAL, which writes GeoPackage and "
      "GeoJSON; draw without them, then 'ogr2ogr " +
      (crs.empty() ? "" : "-a_srs " + crs + " ") + map.filename().string() +
      " " + dxf.filename().string() + "' does the same");
}

#endif

}  // namespace curvix

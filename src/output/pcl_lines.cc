// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as a PCL point cloud and as PCD.
#include "output/pcl_lines.h"

#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <vector>

#include <curvix/curve_style.h>

namespace curvix {
namespace {

CurvePoint MakePoint(const CurveSample& sample, std::size_t id) {
  CurvePoint point{};
  point.getVector3fMap() = sample.position.cast<float>();
  point.data[3] = 1;
  point.tx = static_cast<float>(sample.tangent.x());
  point.ty = static_cast<float>(sample.tangent.y());
  point.tz = static_cast<float>(sample.tangent.z());
  const Rgb color = CurveColor(id);
  point.r = color[0];
  point.g = color[1];
  point.b = color[2];
  point.a = 255;
  point.curve_id = static_cast<std::uint32_t>(id);
  point.confidence = Confidence(sample.support.size());
  point.support = static_cast<std::uint32_t>(sample.support.size());
  return point;
}

}  // namespace

pcl::PointCloud<CurvePoint> ToPointCloud(const CurveSet& curves) {
  pcl::PointCloud<CurvePoint> cloud;
  for (std::size_t id = 0; id < curves.curves.size(); ++id) {
    for (const CurveSample& sample : curves.curves[id].samples) {
      cloud.push_back(MakePoint(sample, id));
    }
  }
  return cloud;
}

// PCDWriter::writeBinary would write the same, but needs PCL's io library,
// which loads VTK; its header is a template and does not.
std::string EncodePcd(const pcl::PointCloud<CurvePoint>& cloud) {
  std::string out = pcl::PCDWriter::generateHeader<CurvePoint>(cloud);
  out += "DATA binary\n";
  const std::vector<pcl::PCLPointField> fields = pcl::getFields<CurvePoint>();
  for (const CurvePoint& point : cloud) {
    std::array<char, sizeof(CurvePoint)> bytes;
    std::memcpy(bytes.data(), &point, sizeof(CurvePoint));
    for (const pcl::PCLPointField& field : fields) {
      const auto size =
          static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
      out.append(bytes.data() + field.offset, size);
    }
  }
  return out;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcl_lines.h"

#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/curve_style.h"

namespace curvix {

CurvePoint ToPoint(const CurveSample& sample, std::size_t id) {
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

// PCDWriter::writeBinary would write the same, but needs PCL's io library,
// which loads VTK; its header is a template and does not.
Status EncodePcd(const CurveSource& curves, const ByteSink& sink) {
  const std::size_t num_points = CountSamples(curves);
  // PCL takes the largest number for none given.
  if (num_points >= std::numeric_limits<int>::max()) {
    return Status::Unsupported("PCL counts points with 32 bits, too few for " +
                               std::to_string(num_points) +
                               " of them; write .txt instead");
  }
  sink(pcl::PCDWriter::generateHeader<CurvePoint>(
           {}, static_cast<int>(num_points)) +
       "DATA binary\n");
  const std::vector<pcl::PCLPointField> fields = pcl::getFields<CurvePoint>();
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    std::string out;
    for (const CurveSample& sample : curve.samples) {
      const CurvePoint point = ToPoint(sample, id);
      std::array<char, sizeof(CurvePoint)> bytes;
      std::memcpy(bytes.data(), &point, sizeof(CurvePoint));
      for (const pcl::PCLPointField& field : fields) {
        const auto size =
            static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
        out.append(bytes.data() + field.offset, size);
      }
    }
    sink(out);
  });
  return {};
}

}  // namespace curvix

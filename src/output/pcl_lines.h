// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as a PCL point cloud and as PCD;
// docs/output_format.md.
#pragma once

#include <curvix/curves.h>

#define PCL_NO_PRECOMPILE  // our own point type
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstdint>
#include <string>

namespace curvix {

// One sample of a curve as PCL sees it.
struct EIGEN_ALIGN16 CurvePoint {
  PCL_ADD_POINT4D;   // x, y, z
  float tx, ty, tz;  // unit tangent
  PCL_ADD_RGB;       // colour of the curve
  std::uint32_t curve_id;
  float confidence;       // Confidence(support)
  std::uint32_t support;  // number of supporting views
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

// All samples, curve by curve, in order: one row, dense.
pcl::PointCloud<CurvePoint> ToPointCloud(const CurveSet& curves);

// The cloud as a binary PCD file: PCL's own header and field layout. Which
// samples are neighbours follows from their order and curve_id; whether a curve
// is closed is not stored.
std::string EncodePcd(const pcl::PointCloud<CurvePoint>& cloud);

}  // namespace curvix

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(
    curvix::CurvePoint,
    (float, x, x)(float, y, y)(float, z, z)
    (float, tx, tx)(float, ty, ty)(float, tz, tz)
    (float, rgb, rgb)
    (std::uint32_t, curve_id, curve_id)
    (float, confidence, confidence)
    (std::uint32_t, support, support))
// clang-format on

// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as the points of PCL, in a PCD file;
// docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/status.h>
#include "base/file_io.h"

#define PCL_NO_PRECOMPILE  // our own point type
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstddef>
#include <cstdint>

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

// A sample of the curve that has this id.
CurvePoint ToPoint(const CurveSample& sample, std::size_t id);

// All samples, curve by curve, in order, as a binary PCD file of one row: PCL's
// own header and field layout. Which samples are neighbours follows from their
// order and curve_id; whether a curve is closed is not stored. More than
// 2^31 - 1 samples are kUnsupported.
Status EncodePcd(const CurveSource& curves, const ByteSink& sink);

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

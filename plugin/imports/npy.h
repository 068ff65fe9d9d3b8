// SPDX-License-Identifier: BSD-3-Clause
// NumPy's files of 4 x 4 matrices: .npy, and .npz archives.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace curvix {

// The 4 x 4 matrix in the bytes of a .npy file, versions 1 to 3: float32 or
// float64 of either byte order, in C or Fortran order. `name` is what errors
// call it. kDataLoss: not .npy, another shape, the shape does not fit the
// bytes, or NaN or infinity. kUnsupported: another type of values.
Result<Eigen::Matrix4d> ParseNpy(std::string_view bytes,
                                 const std::string& name);

// The matrices of a .npz file whose names (without .npy) are `wanted`; others
// are not unpacked. kNotFound: no such file. kDataLoss: not a .npz file,
// damaged (checksums are compared), or a wanted array takes more than a
// megabyte. Else as ParseNpy.
Result<std::map<std::string, Eigen::Matrix4d>> ReadNpz(
    const std::filesystem::path& path,
    const std::function<bool(const std::string& name)>& wanted);

}  // namespace curvix

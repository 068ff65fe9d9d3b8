// SPDX-License-Identifier: BSD-3-Clause
// NumPy's arrays on disk: .npy, and .npz archives.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

struct NpyArray {
  std::vector<std::size_t> shape;  // empty: a single number
  std::vector<double> values;      // the last index runs fastest (C order)
};

// The array in the bytes of a .npy file, versions 1 to 3: float32 or float64 of
// either byte order, in C or Fortran order. `name` is what errors call it.
// kDataLoss: not .npy, or the shape does not fit the bytes, which is found out
// before anything is allocated. kUnsupported: another type of values.
Result<NpyArray> ParseNpy(std::string_view bytes, const std::string& name);

// The array as a rows x cols matrix. kDataLoss, calling it `name`, if it has
// another shape or holds NaN or infinity.
Result<Eigen::MatrixXd> MatrixFromNpy(const NpyArray& array,
                                      int rows,
                                      int cols,
                                      const std::string& name);

// The arrays of a .npz file whose names (without .npy) are `wanted`; others are
// not unpacked. kNotFound: no such file. kDataLoss: not a .npz file, damaged
// (checksums are compared), or a wanted array takes more than a megabyte.
Result<std::map<std::string, NpyArray>> ReadNpz(
    const std::filesystem::path& path,
    const std::function<bool(const std::string& name)>& wanted);

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Known cameras, and data sets written from them.
#pragma once

#include <curvix/scene.h>
#include <zip.h>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/text_fields.h"

namespace curvix {

// The bytes of a PNG as far as its size needs them.
inline std::string PngOfSize(int width, int height) {
  std::string bytes = "\x89PNG\r\n\x1a\n";
  bytes += std::string("\0\0\0\x0dIHDR", 8);
  for (const int number : {width, height}) {
    for (const int shift : {24, 16, 8, 0}) {
      bytes += static_cast<char>(number >> shift & 0xff);
    }
  }
  return bytes + std::string("\x08\x02\0\0\0", 5);
}

// A camera that looks at the origin from somewhere.
inline Rigid3 RandomPose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Rigid3 pose;
  pose.rotation = Eigen::Quaterniond(
      normal(random), normal(random), normal(random), normal(random));
  pose.rotation.normalize();
  pose.translation = {
      0.1 * normal(random), 0.1 * normal(random), 4 + std::abs(normal(random))};
  return pose;
}

// f = (700, 710), principal point (310, 245) where the first pixel's centre is
// (0, 0); 640 x 480.
inline Eigen::Matrix3d TestCalibration() {
  Eigen::Matrix3d k;
  k << 700, 0, 310, 0, 710, 245, 0, 0, 1;
  return k;
}

inline std::string NumberText(double value) {
  std::string text;
  AppendNumber(value, text);
  return text;
}

// "a b c d ...", row by row, exact.
inline std::string MatrixText(const Eigen::MatrixXd& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    text += NumberText(matrix(i / matrix.cols(), i % matrix.cols())) + " ";
  }
  return text;
}

// "[[a, b], [c, d]]"
inline std::string MatrixJson(const Eigen::MatrixXd& matrix) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    text += i > 0 ? ", [" : "[";
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      text += (j > 0 ? ", " : "") + NumberText(matrix(i, j));
    }
    text += "]";
  }
  return text + "]";
}

inline Eigen::MatrixXd Matrix34(const Rigid3& pose) {
  Eigen::MatrixXd matrix(3, 4);
  matrix << pose.rotation.toRotationMatrix(), pose.translation;
  return matrix;
}

// world_from_cam with OpenGL's axes.
inline Eigen::MatrixXd NerfMatrix(const Rigid3& cam_from_world) {
  Eigen::MatrixXd matrix = Eigen::Matrix4d::Identity();
  matrix.topRows(3) = Matrix34(cam_from_world.Inverse());
  matrix.col(1) *= -1;
  matrix.col(2) *= -1;
  return matrix;
}

// A .npy file, version 1, of `descr` and the raw `values`.
inline std::string NpyFile(const std::string& descr,
                           const std::string& fortran_order,
                           const std::string& shape,
                           const std::string& values,
                           char version = 1) {
  const std::string header = "{'descr': " + descr +
                             ", 'fortran_order': " + fortran_order +
                             ", 'shape': " + shape + ", }\n";
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  if (version == 1) {
    AppendLittleEndian(static_cast<std::uint16_t>(header.size()), bytes);
  } else {
    AppendLittleEndian(static_cast<std::uint32_t>(header.size()), bytes);
  }
  return bytes + header + values;
}

inline std::string NpyOfMatrix(const Eigen::MatrixXd& matrix) {
  std::string values;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    AppendLittleEndian(matrix(i / matrix.cols(), i % matrix.cols()), values);
  }
  std::string shape = "(";
  shape += std::to_string(matrix.rows()) + ", ";
  shape += std::to_string(matrix.cols()) + ")";
  return NpyFile("'<f8'", "False", shape, values);
}

// Writes `entries` as a compressed archive, ".npy" added to their names.
inline void WriteNpz(const std::filesystem::path& path,
                     const std::map<std::string, std::string>& entries) {
  int error = 0;
  zip_t* const archive =
      zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  for (const auto& [name, bytes] : entries) {
    zip_source_t* const source =
        zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    zip_file_add(archive, (name + ".npy").c_str(), source, ZIP_FL_OVERWRITE);
  }
  zip_close(archive);
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/alignment_file.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "base/file_io.h"
#include "plugin/base/text.h"

namespace curvix {
namespace {

template <typename Vector>
Json NumbersJson(const Vector& v) {
  return std::vector<double>(v.begin(), v.end());
}

// `numbers` has as many entries as `size`, all finite.
template <typename Vector>
bool TakeNumbers(const Json& json, Vector& numbers) {
  if (json.size() != static_cast<std::size_t>(numbers.size())) return false;
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    numbers(i) = json.at(static_cast<std::size_t>(i)).template get<double>();
  }
  return numbers.allFinite();
}

bool TakeCovariance(const Json& json, Matrix7d& covariance) {
  if (json.size() != 7) return false;
  for (int i = 0; i < 7; ++i) {
    Eigen::Matrix<double, 7, 1> row = Eigen::Matrix<double, 7, 1>::Zero();
    if (!TakeNumbers(json.at(static_cast<std::size_t>(i)), row)) return false;
    covariance.row(i) = row.transpose();
  }
  return (covariance.diagonal().array() >= 0).all();
}

bool TakeSimilarity(const Json& json, Similarity3& similarity) {
  Eigen::Vector4d rotation = Eigen::Vector4d::Zero();  // w, x, y, z
  similarity.scale = json.at("scale").get<double>();
  const bool is_read =
      TakeNumbers(json.at("rotation"), rotation) &&
      TakeNumbers(json.at("translation"), similarity.translation);
  similarity.rotation =
      Eigen::Quaterniond(rotation(0), rotation(1), rotation(2), rotation(3));
  const bool is_unit = std::abs(rotation.norm() - 1) < 1e-6;
  similarity.rotation.normalize();
  return is_read && is_unit && std::isfinite(similarity.scale) &&
         similarity.scale > 0;
}

// What poses move by when COLMAP adds images or adjusts them again, as a share
// of the distance of cameras from their middle, is less.
constexpr double kMaxShareMoved = 0.1;
constexpr int kMinNumCameras = 3;

// Whether the cameras of the model are where `centers` has them. Throws if
// these are no vectors.
bool AreThere(const Json& centers, const Scene& model) {
  std::vector<Eigen::Vector3d> before, after;
  for (const View& view : model.views) {
    const std::string name = ValidUtf8(view.name);
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    if (!centers.contains(name)) continue;
    if (!TakeNumbers(centers.at(name), center)) return false;
    before.push_back(center);
    after.push_back(view.cam_from_world.Inverse().translation);
  }
  if (before.size() < kMinNumCameras) return false;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : before) mean += x;
  mean /= static_cast<double>(before.size());
  double moved = 0, spread = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    moved += (after[i] - before[i]).squaredNorm();
    spread += (before[i] - mean).squaredNorm();
  }
  return moved <= kMaxShareMoved * kMaxShareMoved * spread;
}

bool IsOfAnother(const Json& alignment, const Scene& model) {
  if (!alignment.contains("cameras")) return false;
  try {
    return !AreThere(alignment["cameras"], model);
  } catch (const nlohmann::json::exception&) {
    return true;
  }
}

}  // namespace

Json CentersJson(const Scene& scene) {
  Json centers = Json::object();
  for (const View& view : scene.views) {
    centers[ValidUtf8(view.name)] =
        NumbersJson(view.cam_from_world.Inverse().translation);
  }
  return centers;
}

Json AlignmentJson(const WorldAlignment& alignment) {
  const Similarity3& s = alignment.world_from_model;
  Json known = Json::array();
  if (alignment.has_scale) known.push_back("scale");
  if (alignment.has_rotation) known.push_back("rotation");
  if (alignment.has_translation) known.push_back("translation");
  Json covariance = Json::array();
  for (int i = 0; i < 7; ++i) {
    covariance.push_back(
        NumbersJson(alignment.covariance.row(i).transpose().eval()));
  }
  return {{"format", "curvix alignment"},
          {"version", 1},
          {"unit", alignment.unit},
          {"crs", alignment.crs},
          {"offset", NumbersJson(alignment.offset)},
          {"world_from_model",
           {{"scale", s.scale},
            {"rotation",
             {s.rotation.w(), s.rotation.x(), s.rotation.y(), s.rotation.z()}},
            {"translation", NumbersJson(s.translation)}}},
          {"known", known},
          {"covariance", covariance}};
}

Result<WorldAlignment> AlignmentFromJson(const Json& json) {
  WorldAlignment a;
  try {
    if (json.at("format") != "curvix alignment" || json.at("version") != 1) {
      return Status::DataLoss("it is not an alignment of version 1");
    }
    a.unit = json.at("unit").get<std::string>();
    a.crs = json.at("crs").get<std::string>();
    for (const Json& name : json.at("known")) {
      a.has_scale = a.has_scale || name == "scale";
      a.has_rotation = a.has_rotation || name == "rotation";
      a.has_translation = a.has_translation || name == "translation";
    }
    if (!TakeNumbers(json.at("offset"), a.offset)) {
      return Status::DataLoss("\"offset\" is not three numbers");
    }
    if (!TakeSimilarity(json.at("world_from_model"), a.world_from_model)) {
      return Status::DataLoss("\"world_from_model\" is not a similarity");
    }
    if (!TakeCovariance(json.at("covariance"), a.covariance)) {
      return Status::DataLoss("\"covariance\" is not a 7 x 7 covariance");
    }
  } catch (const nlohmann::json::exception& error) {
    return Status::DataLoss(WhatOf(error));
  }
  return a;
}

Result<std::optional<WorldAlignment>> ReadAlignment(
    const std::filesystem::path& folder, const Scene* model) {
  const std::filesystem::path path = folder / kAlignmentName;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return std::optional<WorldAlignment>();
  }
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  const Json json = Json::parse(text, nullptr, false);
  Result<WorldAlignment> alignment =
      json.is_discarded()
          ? Result<WorldAlignment>(Status::DataLoss("it is not JSON"))
          : AlignmentFromJson(json);
  if (!alignment.ok()) {
    return Status::DataLoss(path.string() +
                            " cannot be used: " + alignment.status().message() +
                            "; run 'colmap_curvix align' again, or remove it");
  }
  if (model != nullptr && IsOfAnother(json, *model)) {
    return Status::DataLoss(
        path.string() +
        " is of another model, whose cameras are elsewhere. Remove it, run "
        "again, and align the new curves");
  }
  return std::optional(*std::move(alignment));
}

}  // namespace curvix

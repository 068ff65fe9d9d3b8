// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/choose_plane.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "base/text_fields.h"
#include "measuring/main_axes.h"

namespace curvix {
namespace {

Status BadPlane(std::string message) {
  return Status::InvalidArgument("--plane: " + std::move(message));
}

bool AxesAreKnown(const CurvesFile& curves) {
  return curves.alignment && curves.alignment->has_rotation;
}

Result<DrawingPlane> AutoPlane(const CurvesFile& curves, const Scene& scene) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (!AxesAreKnown(curves)) {
    const Result<MainAxes> found = FindMainAxes(
        curves.fitted, MeanUp(scene.views), MeanViewDirection(scene.views));
    if (!found.ok()) {
      return Status(found.status().code(),
                    found.status().message() +
                        "; name the plane, as in --plane \"nodes 12 31 7\"");
    }
    axes = found->axes.world_from_model.toRotationMatrix().transpose();
  }
  return MainPlane(curves.fitted, axes, scene.views);
}

// The numbers in "nodes 12 31 7", as they are written; empty: it is not that.
std::vector<std::string_view> NodesIn(std::string_view text) {
  if (TakeWord(text) != "nodes") return {};
  std::vector<std::string_view> words;
  for (auto word = TakeWord(text); !word.empty(); word = TakeWord(text)) {
    if (!ParseNumber<std::size_t>(word)) return {};
    words.push_back(word);
  }
  if (words.size() != 3) return {};
  return words;
}

// The mean direction in which images see the curves next to `points`; of all
// images if none does.
Eigen::Vector3d DirectionTowards(const std::vector<Eigen::Vector3d>& points,
                                 const CurvesFile& curves,
                                 const Scene& scene) {
  constexpr double kNear = 0.1;  // of the distance between the first two points
  const double reach = kNear * (points[1] - points[0]).norm();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto add = [&](const SeenSample& sample) {
    for (const View& view : scene.views) {
      if (!std::ranges::binary_search(sample.image_ids, view.image_id)) {
        continue;
      }
      sum += (sample.position - view.cam_from_world.Inverse().translation)
                 .normalized();
    }
  };
  for (const std::vector<SeenSample>& samples : curves.samples) {
    for (const SeenSample& sample : samples) {
      const auto is_near = [&](const Eigen::Vector3d& point) {
        return (sample.position - point).norm() <= reach;
      };
      if (std::ranges::any_of(points, is_near)) add(sample);
    }
  }
  return sum.isZero(0) ? MeanViewDirection(scene.views) : sum;
}

Result<DrawingPlane> PlaneOfNodes(const std::string& text,
                                  const CurvesFile& curves,
                                  const Scene& scene) {
  const Eigen::Vector3d up =
      AxesAreKnown(curves) ? Eigen::Vector3d::UnitZ() : MeanUp(scene.views);
  std::vector<Eigen::Vector3d> points;
  const std::vector<CurveNode>& nodes = curves.fitted.nodes;
  for (const std::string_view word : NodesIn(text)) {
    const std::size_t id = *ParseNumber<std::size_t>(word);
    if (id >= nodes.size()) return BadPlane(NoSuchNode(word, curves.fitted));
    points.push_back(nodes[id].position);
  }
  Result<DrawingPlane> plane =
      PlaneThrough(points[0],
                   points[1],
                   points[2],
                   up,
                   DirectionTowards(points, curves, scene));
  if (!plane.ok()) return BadPlane(plane.status().message());
  plane->name = text;
  return plane;
}

Result<DrawingPlane> ChoosePlane(const std::string& name,
                                 const CurvesFile& curves,
                                 const Scene& scene) {
  if (name == "auto") return AutoPlane(curves, scene);
  if (!NodesIn(name).empty()) return PlaneOfNodes(name, curves, scene);
  return *AxisPlane(name);
}

}  // namespace

bool HasPlaneOfNodes(const std::string& text) {
  return text.find("nodes") != text.npos;
}

Status CheckPlanes(const std::string& text) {
  std::set<std::string> names;
  for (const std::string_view part : SplitAt(text, ',')) {
    const std::string name(part);
    if (!names.insert(name).second) {
      return BadPlane("it has " + name + " twice");
    }
    if (name == "auto" || AxisPlane(name) || !NodesIn(name).empty()) continue;
    return BadPlane("\"" + name +
                    "\" is no plane; it takes xy, xz, yz, several of these "
                    "with commas between, auto, or three nodes, as in \"nodes "
                    "12 31 7\"");
  }
  return {};
}

Result<std::vector<DrawingPlane>> ChoosePlanes(const std::string& text,
                                               const CurvesFile& curves,
                                               const Scene& scene) {
  std::vector<DrawingPlane> planes;
  for (const std::string_view part : SplitAt(text, ',')) {
    CURVIX_ASSIGN_OR_RETURN(DrawingPlane plane,
                            ChoosePlane(std::string(part), curves, scene));
    planes.push_back(std::move(plane));
  }
  return planes;
}

}  // namespace curvix

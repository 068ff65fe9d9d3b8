// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/undistort_edges.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/check.h"
#include "geometry/detected_edge.h"
#include "geometry/lens.h"
#include "model/posed_view.h"

namespace curvix {
namespace {

// `edge` in another image, into which `carry` carries what it can. In double
// precision, so that a lens without distortion changes no angle.
template <typename Carry>
std::optional<Edge2d> Carried(const Edge2d& edge, const Carry& carry) {
  const double angle = static_cast<double>(edge.angle);
  ImageEdge place = {edge.position, {std::cos(angle), std::sin(angle)}};
  const std::optional<ImageEdge> to = carry(place);
  if (!to) return std::nullopt;
  Edge2d carried = edge;
  carried.position = to->position;
  carried.angle =
      static_cast<float>(std::atan2(to->tangent.y(), to->tangent.x()));
  if (edge.fine_px == Eigen::half(0)) return carried;
  place.position += static_cast<double>(edge.fine_px) * ToBrightSide(edge);
  if (const auto fine = carry(place)) {
    carried.fine_px = Eigen::half(static_cast<float>(
        (fine->position - to->position).dot(ToBrightSide(carried))));
  }
  return carried;
}

using NewIndices = std::vector<std::optional<std::int32_t>>;

std::optional<std::int32_t> Renumbered(const NewIndices& new_idx,
                                       std::optional<std::int32_t> old_idx) {
  if (!old_idx) return std::nullopt;
  return new_idx[static_cast<std::size_t>(*old_idx)];
}

// Whether `pixel` of an image is on a black pixel of its mask.
bool IsBlack(const GrayImage& mask, const Eigen::Vector2d& pixel) {
  const double x = std::floor(pixel.x());
  const double y = std::floor(pixel.y());
  if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) return false;
  return mask.at(static_cast<int>(x), static_cast<int>(y)) == 0;
}

// Whether the photograph shows `pixel` of the ideal pinhole.
bool IsSeen(const Camera& camera,
            const PosedView& view,
            const std::optional<GrayImage>& mask,
            const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d uv = view.Ray(pixel).hnormalized();
  const Eigen::Vector2d in_image = ImageFromIdeal(camera, uv);
  constexpr double kTolerancePx = 1e-6;  // of the border
  if (!(in_image.minCoeff() >= -kTolerancePx &&
        in_image.x() <= camera.width + kTolerancePx &&
        in_image.y() <= camera.height + kTolerancePx)) {
    return false;
  }
  // Beyond where distortion folds over, it leads to pixels of other rays.
  constexpr double kSameRay = 1e-6;
  const auto shown = IdealFromImage(camera, in_image);
  if (!shown || !((*shown - uv).norm() <= kSameRay * (1 + uv.norm()))) {
    return false;
  }
  return !mask || !IsBlack(*mask, in_image);
}

}  // namespace

EdgeMap UndistortEdges(EdgeMap distorted, const Camera& camera) {
  CURVIX_CHECK(distorted.edges.size() == distorted.neighbors.size(),
               distorted.edges.size() << " edges");
  if (IsPinhole(camera)) return distorted;
  EdgeMap ideal = std::move(distorted);
  const std::vector<Edge2d> edges = std::exchange(ideal.edges, {});
  const std::vector<EdgeNeighbors> neighbors =
      std::exchange(ideal.neighbors, {});
  NewIndices new_idx(edges.size());
  ideal.edges.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto edge = Carried(edges[i], [&](const ImageEdge& in_image) {
      return EdgeInIdealImage(in_image, camera);
    });
    if (!edge) continue;
    new_idx[i] = static_cast<std::int32_t>(ideal.edges.size());
    ideal.edges.push_back(*edge);
  }
  ideal.neighbors.reserve(ideal.edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!new_idx[i]) continue;
    ideal.neighbors.push_back({Renumbered(new_idx, neighbors[i].previous),
                               Renumbered(new_idx, neighbors[i].next)});
  }
  return ideal;
}

std::optional<EdgeMap> CarryEdges(const EdgeMap& edges,
                                  const Camera& from,
                                  const Camera& to) {
  if (from == to) return edges;
  EdgeMap carried = edges;
  for (Edge2d& edge : carried.edges) {
    const auto moved = Carried(edge, [&](const ImageEdge& in_image) {
      return CarryEdge(in_image, from, to);
    });
    if (!moved) return std::nullopt;
    edge = *moved;
  }
  return carried;
}

std::int32_t DropMaskedEdges(const GrayImage& mask,
                             std::vector<LocatedEdge>* edges) {
  return static_cast<std::int32_t>(std::erase_if(
      *edges,
      [&](const LocatedEdge& edge) { return IsBlack(mask, edge.position); }));
}

UnseenCells FindUnseenCells(const Camera& camera,
                            const std::optional<GrayImage>& mask) {
  UnseenCells unseen;
  if (IsPinhole(camera) && !mask) return unseen;
  const PosedView view = MakePosedView(camera, {});
  unseen.margin_px = view.margin_px;
  const auto num_cells = [&](int size) {
    return static_cast<int>(
        std::ceil((size + 2 * view.margin_px) / UnseenCells::kCellPx));
  };
  const int num_columns = num_cells(view.width);
  const int num_rows = num_cells(view.height);
  unseen.num_columns = num_columns;
  unseen.cells.resize(static_cast<std::size_t>(num_columns) *
                      static_cast<std::size_t>(num_rows));
  const auto mark = [&](int column, int row) {
    if (column < 0 || column >= num_columns || row < 0 || row >= num_rows) {
      return;
    }
    unseen.cells[static_cast<std::size_t>(row * num_columns + column)] = 1;
  };
  // Each point belongs to up to four cells. Outlines of masks have details.
  const int num_per_side = mask ? 2 : 1;
  const double spacing_px = UnseenCells::kCellPx / num_per_side;
  for (int i = 0; i <= num_per_side * num_rows; ++i) {
    for (int j = 0; j <= num_per_side * num_columns; ++j) {
      // Of the last cells only what is in the image counts.
      const Eigen::Vector2d pixel =
          (spacing_px * Eigen::Vector2d(j, i) -
           Eigen::Vector2d::Constant(view.margin_px))
              .cwiseMin(Eigen::Vector2d(view.width + view.margin_px,
                                        view.height + view.margin_px));
      if (IsSeen(camera, view, mask, pixel)) continue;
      for (const int row :
           {(i + num_per_side - 1) / num_per_side - 1, i / num_per_side}) {
        for (const int column :
             {(j + num_per_side - 1) / num_per_side - 1, j / num_per_side}) {
          mark(column, row);
        }
      }
    }
  }
  return unseen;
}

}  // namespace curvix

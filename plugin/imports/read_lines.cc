// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/read_lines.h"

#include <curvix/curve_io.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "plugin/imports/import_scene.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Outside, a point is less than a pixel away from where it would be seen if it
// were infinitely far, in whichever two images: its distance is not known.
struct KnownSpace {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 0;

  bool Holds(const ImportedLine& line) const {
    return (line.start - middle).norm() <= radius &&
           (line.end - middle).norm() <= radius;
  }
};

KnownSpace KnownSpaceOf(const Scene& scene) {
  Eigen::AlignedBox3d centers;
  double focal_length = 0;
  for (const View& view : scene.views) {
    centers.extend(view.cam_from_world.Inverse().translation);
    focal_length =
        std::max(focal_length, PinholeCalibration(CameraOf(scene, view))(0, 0));
  }
  return {centers.center(), focal_length * centers.diagonal().norm()};
}

bool IsSeenBySome(const ImportedLine& line, const Scene& scene) {
  return std::ranges::any_of(scene.views, [&](const View& view) {
    return ProjectPoint(
               (line.start + line.end) / 2, view, CameraOf(scene, view))
        .has_value();
  });
}

// Where the view, which sees it, sees the sample, and in which direction.
Edge2d EdgeAt(const CurveSample& sample,
              const View& view,
              const Camera& camera) {
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Vector3d position =
      calibration * (view.cam_from_world * sample.position);
  const Eigen::Vector3d tangent =
      calibration * (view.cam_from_world.rotation * sample.tangent);
  Edge2d edge;
  edge.position = position.hnormalized();
  const Eigen::Vector2d along = tangent.head<2>() - tangent.z() * edge.position;
  edge.angle = static_cast<float>(std::atan2(along.y(), along.x()));
  return edge;
}

Curve CurveOf(const ImportedLine& line,
              const Scene& scene,
              const std::map<std::uint32_t, std::int32_t>& view_of_image,
              LineCurves& result) {
  std::vector<std::int32_t> views;
  for (const std::uint32_t image_id : line.image_ids) {
    const auto view = view_of_image.find(image_id);
    if (view == view_of_image.end()) {
      ++result.num_unknown_images;
    } else {
      views.push_back(view->second);
    }
  }
  std::ranges::sort(views);
  views.erase(std::unique(views.begin(), views.end()), views.end());
  Curve curve;
  for (const Eigen::Vector3d& position : {line.start, line.end}) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = position;
    sample.tangent = (line.end - line.start).stableNormalized();
    for (const std::int32_t view_idx : views) {
      const View& view = scene.views[static_cast<std::size_t>(view_idx)];
      const Camera& camera = CameraOf(scene, view);
      if (!ProjectPoint(position, view, camera)) continue;
      EdgeMap& map = result.edge_maps[static_cast<std::size_t>(view_idx)];
      sample.support.push_back(
          {view_idx, static_cast<std::int32_t>(map.edges.size())});
      map.edges.push_back(EdgeAt(sample, view, camera));
      map.neighbors.emplace_back();
    }
  }
  return curve;
}

using Lines = std::vector<ImportedLine>;

// Words of a file, one after the other. After one that is not what was asked
// for, everything is 0 and status() says where that was.
class Words {
 public:
  Words(const fs::path& path, std::string_view text)
      : path_(path), text_(text), words_(text) {}

  bool AtEnd() const { return !ok() || words_.AtEnd(); }
  double Number() {
    const auto number = Take<double>("a number");
    if (std::isfinite(number)) return number;
    Fail("a finite number");
    return 0;
  }
  Eigen::Vector3d Point() {
    Eigen::Vector3d point;
    for (double& number : point) number = Number();
    return point;
  }
  std::uint32_t Id() { return Take<std::uint32_t>("the id of an image"); }
  std::uint32_t Count() { return Take<std::uint32_t>("a count"); }
  void Skip() { Number(); }
  void End() {
    if (!AtEnd()) Fail("the end of the file");
  }
  void Name(std::string_view name) {
    if (ok() && words_.Word() != name) Fail("\"" + std::string(name) + "\"");
  }

  bool ok() const { return status_.ok(); }
  const Status& status() const { return status_; }

 private:
  template <typename T>
  T Take(const std::string& what) {
    const T value = words_.Number<T>();
    if (words_.failed()) Fail(what);
    return value;
  }
  void Fail(const std::string& what) {
    if (!ok()) return;
    const auto rest = static_cast<std::ptrdiff_t>(words_.bytes_left());
    const auto line = 1 + std::count(text_.begin(), text_.end() - rest, '\n');
    status_ = Status::DataLoss(
        path_.string() + ", line " + std::to_string(line) + ", lacks " + what +
        "; write the file again, or name the right one with --input_path.");
  }

  fs::path path_;
  std::string_view text_;
  WordReader words_;
  Status status_;
};

// The lines of a file, at least one.
Result<Lines> SomeLines(const fs::path& path, Lines lines) {
  if (!lines.empty()) return lines;
  return Status::Unsupported(
      path.string() +
      " holds no lines; name the right file with --input_path.");
}

// What `read` finds in a file, at least one line.
template <typename Read>
Result<Lines> ReadWords(const fs::path& path, const Read& read) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  Words words(path, WithoutByteOrderMark(text));
  Lines lines;
  read(words, lines);
  if (!words.ok()) return words.status();
  return SomeLines(path, std::move(lines));
}

Result<Lines> ReadObj(const fs::path& path) {
  CURVIX_ASSIGN_OR_RETURN(const CurveSet set, ReadCurves(path));
  Lines lines;
  for (const Curve& curve : set.curves) {
    for (std::size_t i = 1; i < curve.samples.size(); ++i) {
      lines.push_back(
          {curve.samples[i - 1].position, curve.samples[i].position, {}});
    }
    if (curve.closed) {
      lines.push_back(
          {curve.samples.back().position, curve.samples.front().position, {}});
    }
  }
  return SomeLines(path, std::move(lines));
}

// Per row: a count and as many segments of one line in space; a count and as
// many segments in images, each with the image, its number there, and two
// points.
void ReadLine3dppRows(Words& words, Lines& lines) {
  constexpr int kRestOfSegment = 5;
  while (!words.AtEnd()) {
    Lines segments;
    const std::uint32_t num_segments = words.Count();
    for (std::uint32_t i = 0; i < num_segments && words.ok(); ++i) {
      const Eigen::Vector3d start = words.Point();
      segments.push_back({start, words.Point(), {}});
    }
    std::vector<std::uint32_t> image_ids;
    const std::uint32_t num_images = words.Count();
    for (std::uint32_t i = 0; i < num_images && words.ok(); ++i) {
      image_ids.push_back(words.Id());
      for (int k = 0; k < kRestOfSegment; ++k) words.Skip();
    }
    for (ImportedLine& segment : segments) {
      segment.image_ids = image_ids;
      lines.push_back(std::move(segment));
    }
  }
}

void ReadIds(std::uint32_t count, Words& words, ImportedLine& line) {
  for (std::uint32_t i = 0; i < count && words.ok(); ++i) {
    line.image_ids.push_back(words.Id());
  }
}

// A count; per line: its number, how many segments of how many images show it,
// two points, the images of these segments, their numbers there.
void ReadAllTracks(Words& words, Lines& lines) {
  const std::uint32_t num_lines = words.Count();
  for (std::uint32_t i = 0; i < num_lines && words.ok(); ++i) {
    ImportedLine line;
    words.Skip();
    const std::uint32_t num_segments = words.Count();
    words.Skip();
    line.start = words.Point();
    line.end = words.Point();
    ReadIds(num_segments, words, line);
    for (std::uint32_t k = 0; k < num_segments && words.ok(); ++k) words.Skip();
    lines.push_back(std::move(line));
  }
  words.End();
}

// Two points, how many segments of how many images show the line, the images of
// these segments, and more.
void ReadTrack(Words& words, Lines& lines) {
  ImportedLine line;
  line.start = words.Point();
  line.end = words.Point();
  const std::uint32_t num_segments = words.Count();
  words.Skip();
  words.Name("image_id_list");
  ReadIds(num_segments, words, line);
  lines.push_back(std::move(line));
}

// How many files track_<i>.txt there are in a folder.
std::size_t CountTracks(const fs::path& folder) {
  const std::vector<std::string> names = FileNames(folder);
  return static_cast<std::size_t>(
      std::ranges::count_if(names, [](const std::string& name) {
        return name.starts_with("track_") && name.ends_with(".txt");
      }));
}

Result<Lines> ReadTracks(const fs::path& folder, std::size_t count) {
  Lines lines;
  for (std::size_t i = 0; i < count; ++i) {
    CURVIX_ASSIGN_OR_RETURN(
        const Lines track,
        ReadWords(folder / ("track_" + std::to_string(i) + ".txt"), ReadTrack));
    lines.push_back(track.front());
  }
  return lines;
}

}  // namespace

Result<Lines> ReadLine3dppLines(const fs::path& path) {
  if (IsFolder(path)) {
    const Result<fs::path> file = OnlyFile(path, "Line3D++", ".txt");
    if (file.ok()) return ReadLine3dppLines(*file);
    return Status::NotFound(path.string() +
                            " does not hold just one Line3D++*.txt; name the "
                            ".txt or .obj of Line3D++ with --input_path.");
  }
  if (ExtensionOf(path) == ".obj") return ReadObj(path);
  return ReadWords(path, ReadLine3dppRows);
}

Result<Lines> ReadLimapLines(const fs::path& path) {
  if (!IsFolder(path)) {
    return ExtensionOf(path) == ".obj" ? ReadObj(path)
                                       : ReadWords(path, ReadAllTracks);
  }
  for (const char* const name : {"", "finaltracks", "fitnmerge_finaltracks"}) {
    const fs::path folder = path / name;
    if (const std::size_t count = CountTracks(folder); count > 0) {
      return ReadTracks(folder, count);
    }
  }
  for (const char* const name : {"alltracks.txt", "fitnmerge_alltracks.txt"}) {
    if (IsFile(path / name)) return ReadWords(path / name, ReadAllTracks);
  }
  return Status::NotFound(
      path.string() +
      " holds no finaltracks/, track_<i>.txt or alltracks.txt; name the output "
      "folder of LIMAP with --input_path.");
}

Result<LineCurves> CurvesOfLines(const std::vector<ImportedLine>& lines,
                                 const Scene& scene) {
  LineCurves result;
  result.num_seen = static_cast<int>(std::ranges::count_if(
      lines,
      [&](const ImportedLine& line) { return IsSeenBySome(line, scene); }));
  if (result.num_seen == 0) {
    return Status::InvalidArgument(
        "No image of the model sees any of the lines: they are of another "
        "world; name the workspace that they were made of with "
        "--workspace_path");
  }
  std::map<std::uint32_t, std::int32_t> view_of_image;
  for (const View& view : scene.views) {
    const auto view_idx = static_cast<std::int32_t>(view_of_image.size());
    view_of_image.emplace(view.image_id, view_idx);
  }
  result.edge_maps.resize(scene.views.size());
  const KnownSpace known = KnownSpaceOf(scene);
  for (const ImportedLine& line : lines) {
    if ((line.end - line.start).stableNorm() > 0 && known.Holds(line)) {
      result.curves.curves.push_back(
          CurveOf(line, scene, view_of_image, result));
    } else {
      ++result.num_left_out;
    }
  }
  return result;
}

}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/colmap_io.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "colmap/colmap_model_format.h"
#include "edge_detection/load_image.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"

namespace curvix {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Numbers =
    py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

// Shares the array, which may be freed by any thread.
template <typename T>
std::shared_ptr<const T[]> ValuesOf(const py::array& array) {
  const std::shared_ptr<py::array> kept(new py::array(array), [](auto* owner) {
    const py::gil_scoped_acquire locked;
    delete owner;
  });
  return {kept, static_cast<const T*>(array.data())};
}

// Of an array without gaps, rows x columns x channels, of uint8 or uint16.
ImageInMemory ImageOf(const py::array& array) {
  ImageInMemory image;
  image.height = static_cast<int>(array.shape(0));
  image.width = static_cast<int>(array.shape(1));
  image.num_channels = static_cast<int>(array.shape(2));
  if (array.itemsize() == 1) {
    image.values = ValuesOf<std::uint8_t>(array);
  } else {
    image.values = ValuesOf<std::uint16_t>(array);
  }
  return image;
}

[[noreturn]] void RaiseArgument(const std::string& sentence) {
  Raise(Status::InvalidArgument(sentence));
}

Camera MakeCamera(const std::string& model_name,
                  int width,  // 0: that of the first of its images
                  int height,
                  std::vector<double> params) {
  const auto model = ModelFromName(model_name);
  if (!model) {
    Raise(Status::Unsupported("there is no camera model '" + model_name + "'"));
  }
  return {*model, width, height, std::move(params)};
}

// `quaternion`: x y z w. An `image` takes the place of the file.
View MakeView(std::string name,
              fs::path image_path,
              std::uint32_t image_id,
              int camera_idx,
              const std::array<double, 4>& quaternion,
              const std::array<double, 3>& translation,
              const std::optional<py::array>& image) {
  const auto& [x, y, z, w] = quaternion;
  View view;
  view.cam_from_world = {RotationFromColmap({w, x, y, z}),
                         Eigen::Vector3d(translation.data())};
  if (!view.cam_from_world.rotation.coeffs().allFinite() ||
      !view.cam_from_world.translation.allFinite()) {
    RaiseArgument("the pose of view " + name + " is not finite");
  }
  view.name = std::move(name);
  view.image_path = std::move(image_path);
  view.image_id = image_id;
  view.camera_idx = camera_idx;
  if (image) view.image = ImageOf(*image);
  return view;
}

void CheckViews(const Scene& scene) {
  std::set<std::string> names;
  for (const View& view : scene.views) {
    if (view.camera_idx < 0 ||
        static_cast<std::size_t>(view.camera_idx) >= scene.cameras.size()) {
      RaiseArgument("the camera of view " + view.name + " is not there");
    }
    if (!names.insert(view.name).second) {
      RaiseArgument("two views are named " + view.name);
    }
  }
}

ImageSize SizeOf(const View& view) {
  if (view.image) return {view.image->width, view.image->height};
  return Take(WithoutLock([&] { return ReadImageSize(view.image_path); }));
}

// Cameras without a size take that of their first image.
void FindSizes(Scene& scene) {
  for (const View& view : scene.views) {
    Camera& camera = scene.cameras[static_cast<std::size_t>(view.camera_idx)];
    if (camera.width > 0) continue;
    const ImageSize size = SizeOf(view);
    camera.width = size.width;
    camera.height = size.height;
  }
}

void CheckSizesInMemory(const Scene& scene) {
  for (const View& view : scene.views) {
    const Camera& camera = CameraOf(scene, view);
    const ImageSize of_camera = {camera.width, camera.height};
    if (!view.image || SizeOf(view) == of_camera) continue;
    RaiseArgument("the image of view " + view.name + " has " +
                  SizeText(SizeOf(view)) + " pixels, its camera " +
                  SizeText(of_camera) +
                  "; images of several sizes need a K each");
  }
}

// Observations are the rows (point, view) and pixels, points ascending.
std::vector<ScenePoint> PointsOf(const Doubles& positions,
                                 const Numbers& observations,
                                 const Doubles& pixels,
                                 std::size_t num_views) {
  std::vector<ScenePoint> points(static_cast<std::size_t>(positions.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position =
        Eigen::Map<const Eigen::Vector3d>(positions.data() + 3 * i);
  }
  for (py::ssize_t i = 0; i < observations.shape(0); ++i) {
    const auto point_idx = static_cast<std::size_t>(observations.at(i, 0));
    const auto view_idx = static_cast<std::size_t>(observations.at(i, 1));
    if (point_idx >= points.size() || view_idx >= num_views) {
      RaiseArgument("an observation names a point or a view that is not there");
    }
    ScenePoint& point = points[point_idx];
    point.view_idxs.push_back(static_cast<int>(view_idx));
    point.pixels.emplace_back(pixels.at(i, 0), pixels.at(i, 1));
  }
  return points;
}

PythonScene SceneOf(std::vector<Camera> cameras,
                    std::vector<View> views,
                    const Doubles& positions,
                    const Numbers& observations,
                    const Doubles& pixels) {
  Scene scene = {std::move(cameras), std::move(views), {}};
  CheckViews(scene);
  FindSizes(scene);
  CheckSizesInMemory(scene);
  for (const Camera& camera : scene.cameras) Check(Validate(camera));
  scene.points = PointsOf(positions, observations, pixels, scene.views.size());
  return {std::make_shared<const Scene>(std::move(scene)), nullptr};
}

// Rows x, y, angle, strength.
EdgeMap EdgesOf(const Doubles& rows, double spacing_px) {
  EdgeMap map;
  map.spacing_px = spacing_px;
  map.edges.resize(static_cast<std::size_t>(rows.shape(0)));
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const double* const row = rows.data() + 4 * i;
    Edge2d& edge = map.edges[i];
    edge.position = {row[0], row[1]};
    edge.angle = static_cast<float>(std::remainder(row[2], 2 * EIGEN_PI));
    edge.strength = static_cast<float>(row[3]);
  }
  return map;
}

PythonScene WithEdges(const PythonScene& scene,
                      const std::vector<Doubles>& edges,
                      double spacing_px) {
  auto maps = std::make_shared<std::vector<EdgeMap>>();
  for (const Doubles& rows : edges) {
    maps->push_back(EdgesOf(rows, spacing_px));
  }
  return {scene.scene, std::move(maps)};
}

py::tuple FromColmap(const fs::path& workspace, const fs::path& images) {
  std::vector<std::string> notes;
  Scene scene = Take(
      WithoutLock([&] { return ReadColmapScene(workspace, images, &notes); }));
  return py::make_tuple(
      PythonScene{std::make_shared<const Scene>(std::move(scene)), nullptr},
      notes);
}

void BindInput(py::module_& module) {
  py::class_<Camera>(module, "CameraInput").def(py::init(&MakeCamera));
  py::class_<View>(module, "ViewInput")
      .def(py::init(&MakeView),
           py::arg("name"),
           py::arg("image_path"),
           py::arg("image_id"),
           py::arg("camera_idx"),
           py::arg("quaternion"),
           py::arg("translation"),
           py::arg("image") = py::none());
}

// f(view) of all views.
template <typename F>
auto OfViews(const F& f) {
  return [f](const PythonScene& scene) {
    std::vector<decltype(f(*scene.scene, scene.scene->views.front()))> all;
    for (const View& view : scene.scene->views) {
      all.push_back(f(*scene.scene, view));
    }
    return all;
  };
}

}  // namespace

void BindScene(py::module_& module) {
  BindInput(module);
  py::class_<PythonScene> scenes(module, "Scene");
  scenes.def_static("from_colmap", FromColmap)
      .def_static("make", SceneOf)
      .def("with_edges", WithEdges)
      .def("__len__",
           [](const PythonScene& scene) { return scene.scene->views.size(); })
      .def("num_cameras",
           [](const PythonScene& scene) { return scene.scene->cameras.size(); })
      .def("has_edges",
           [](const PythonScene& scene) { return scene.edge_maps != nullptr; })
      .def("points", [](const PythonScene& scene) {
        std::vector<Eigen::Vector3d> points;
        for (const ScenePoint& point : scene.scene->points) {
          points.push_back(point.position);
        }
        return points;
      });
  const auto of_views = [&](const char* name, const auto& f) {
    scenes.def(name, OfViews(f));
  };
  of_views("names", [](const Scene&, const View& v) {
    return py::bytes(v.name);  // not always UTF-8
  });
  of_views("image_paths",
           [](const Scene&, const View& v) { return v.image_path; });
  of_views("image_ids", [](const Scene&, const View& v) { return v.image_id; });
  of_views("camera_models", [](const Scene& scene, const View& view) {
    return std::string(ModelName(CameraOf(scene, view).model));
  });
  of_views("camera_params", [](const Scene& scene, const View& view) {
    return CameraOf(scene, view).params;
  });
  of_views("sizes", [](const Scene& scene, const View& view) {
    const Camera& camera = CameraOf(scene, view);
    return std::pair(camera.width, camera.height);
  });
  of_views("calibrations", [](const Scene& scene, const View& view) {
    return PinholeCalibration(CameraOf(scene, view));
  });
  of_views("rotations", [](const Scene&, const View& view) {
    return view.cam_from_world.rotation.toRotationMatrix().eval();
  });
  of_views("translations", [](const Scene&, const View& view) {
    return view.cam_from_world.translation;
  });
}

}  // namespace curvix

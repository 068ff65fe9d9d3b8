// SPDX-License-Identifier: BSD-3-Clause
// Models that are broken, hostile or make no sense.
#include <cstring>
#include <limits>

#include "base/infinity.h"
#include "tests/end_to_end/bad_workspace.h"
#include "tests/plugin/posed_points.h"
#include "tests/support/colmap_text.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string InModel(const std::string& name) { return "sparse/0/" + name; }

TEST(BadModels, FilesThatAreNotThereOrNoFiles) {
  std::vector<BadCase> cases = {
      {"no sparse",
       [](auto& w) { fs::remove_all(w.At("sparse")); },
       "No COLMAP model"},
      {"sparse is a file",
       [](auto& w) {
         fs::remove_all(w.At("sparse"));
         w.Write("sparse", "");
       },
       "No COLMAP model"},
      {"a model in halves",
       [](auto& w) {
         fs::rename(w.At(InModel("cameras.bin")), w.At(InModel("cameras.txt")));
       },
       "No COLMAP model"}};
  for (const std::string list : {"cameras", "images", "points3D"}) {
    const std::string file = InModel(list + ".bin");
    const bool is_optional = list == "points3D";
    if (!is_optional) {
      cases.push_back({"no " + list,
                       [=](auto& w) { fs::remove(w.At(file)); },
                       "No COLMAP model"});
    }
    cases.push_back(
        {"empty " + list, [=](auto& w) { w.Write(file, ""); }, file});
    cases.push_back({list + " is a folder",
                     [=](auto& w) {
                       fs::remove(w.At(file));
                       fs::create_directories(w.At(file));
                     },
                     is_optional ? file : "No COLMAP model"});
  }
  ExpectOutcome(cases);
}

TEST(BadModels, FilesThatMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  std::vector<BadCase> cases;
  for (const std::string& file : {InModel("cameras.bin"),
                                  InModel("images.bin"),
                                  InModel("points3D.bin"),
                                  std::string("images/view_000.png")}) {
    cases.push_back(
        {"unreadable " + file,
         [=](auto& w) { fs::permissions(w.At(file), fs::perms::none); },
         file});
  }
  ExpectOutcome(cases);
}

// Sizes of what comes first in each file of the small model.
TEST(BadModels, TruncatedInEverySection) {
  std::vector<BadCase> cases;
  const auto cut = [&](const std::string& list,
                       const std::string& section,
                       std::size_t size) {
    const std::string file = InModel(list + ".bin");
    cases.push_back({list + " cut in " + section,
                     [=](auto& w) {
                       w.WriteModel();
                       w.Write(file, Read(w.At(file)).substr(0, size));
                     },
                     file});
  };
  cut("cameras", "the count", 4);
  cut("cameras", "the id", 8 + 2);
  cut("cameras", "the size", 8 + 4 + 4 + 8 + 3);
  cut("cameras", "the parameters", 8 + 24 + 20);
  cut("images", "the count", 7);
  cut("images", "the pose", 8 + 4 + 30);
  cut("images", "the name", 8 + 64 + 3);
  cut("images", "the count of 2D points", 8 + 64 + 13 + 2);
  cut("images", "the 2D points", 8 + 64 + 13 + 8 + 10);
  cut("points3D", "the count", 3);
  cut("points3D", "the position", 8 + 8 + 12);
  cut("points3D", "the track", 8 + 43 + 8 + 5);
  for (const std::string list : {"cameras", "images", "points3D"}) {
    const std::string file = InModel(list + ".bin");
    cases.push_back({list + " goes on after its end",
                     [=](auto& w) {
                       w.WriteModel();
                       w.Write(file, Read(w.At(file)) + "more");
                     },
                     file});
  }
  ExpectOutcome(cases);
}

TEST(BadModels, CountsBeyondEverything) {
  std::vector<BadCase> cases;
  const auto huge = [&](const std::string& list, std::size_t at) {
    const std::string file = InModel(list + ".bin");
    for (const std::uint64_t count :
         {std::uint64_t{1} << 63, ~std::uint64_t{0}, std::uint64_t{1} << 33}) {
      cases.push_back({list + ", count at " + std::to_string(at),
                       [=](auto& w) {
                         w.WriteModel();
                         std::string bytes = Read(w.At(file));
                         std::memcpy(&bytes[at], &count, sizeof(count));
                         w.Write(file, bytes);
                       },
                       file});
    }
  };
  huge("cameras", 0);
  huge("images", 0);
  huge("images", 8 + 64 + 13);
  huge("points3D", 0);
  huge("points3D", 8 + 43);
  ExpectOutcome(cases);
}

TEST(BadModels, CamerasThatAreNone) {
  const auto camera = [](auto change) {
    return Model([=](ColmapModel& m) { change(m.cameras[0].camera); });
  };
  const auto focal_length = [&](double value) {
    return camera([=](Camera& c) { c.params[0] = value; });
  };
  const std::string file = "cameras.bin";
  ExpectOutcome(
      {{"negative focal length", focal_length(-100), file},
       {"focal length zero", focal_length(0), file},
       {"focal length NaN", focal_length(kNan), file},
       {"focal length infinite", focal_length(kInfinity), file},
       {"principal point NaN",
        camera([](Camera& c) { c.params[2] = kNan; }),
        file},
       {"width zero", camera([](Camera& c) { c.width = 0; }), file},
       {"height negative", camera([](Camera& c) { c.height = -1; }), file},
       {"larger than any image",
        camera([](Camera& c) { c.width = c.height = 2147483647; }),
        "2147483647 x 2147483647"},
       {"unknown model",
        [=](SmallWorkspace& w) {
          std::string bytes = FormatCamerasBinary(w.model.cameras);
          bytes[12] = 99;
          w.Write(InModel(file), bytes);
        },
        "model with id 99"},
       {"no camera",
        Model([](ColmapModel& m) { m.cameras.clear(); }),
        "camera"},
       {"two cameras of one id",
        Model([](ColmapModel& m) { m.cameras.push_back(m.cameras[0]); }),
        "two cameras"}});
}

TEST(BadModels, PosesThatAreNone) {
  const auto pose = [](auto change) {
    return Model([=](ColmapModel& m) { change(m.images[2].cam_from_world); });
  };
  const std::string image = "(view_002.png)";
  ExpectOutcome(
      {{"translation NaN",
        pose([](Rigid3& p) { p.translation.x() = kNan; }),
        image},
       {"translation infinite",
        pose([](Rigid3& p) { p.translation.z() = -kInfinity; }),
        image},
       {"quaternion zero",
        pose([](Rigid3& p) { p.rotation.coeffs().setZero(); }),
        image},
       {"quaternion NaN",
        pose([](Rigid3& p) { p.rotation.w() = kNan; }),
        image},
       {"quaternion infinite",
        pose([](Rigid3& p) { p.rotation.x() = kInfinity; }),
        image},
       {"point NaN",
        Model([](ColmapModel& m) { m.points[0].position.x() = kNan; }),
        "points3D.bin"}});
}

TEST(BadModels, IdsAndReferences) {
  ExpectOutcome(
      {{"two images of one id",
        Model([](ColmapModel& m) {
          m.images[1].image_id = m.images[0].image_id;
        }),
        "two images have the id"},
       {"two images of one name",
        Model([](ColmapModel& m) { m.images[1].name = m.images[0].name; }),
        "two images have the name"},
       {"two points of one id",
        Model([](ColmapModel& m) { m.points.push_back(m.points[0]); }),
        "two points"},
       {"a camera that is not there",
        Model([](ColmapModel& m) { m.images[3].camera_id = 77; }),
        "(view_003.png) was taken by camera 77"},
       {"no images",
        Model([](ColmapModel& m) { m.images.clear(); }),
        "0 images"},
       {"two views",
        Model([](ColmapModel& m) { m.images.resize(2); }),
        "three"},
       {"a track of images that are not there",
        Model([](ColmapModel& m) {
          m.points[0].track = {{99, 7}, {98, 0}};
        }),
        "curves",
        0},
       {"a track of 2D points that are not there",
        Model([](ColmapModel& m) {
          m.points[0].track[0].point2D_idx = 1u << 31;
        }),
        "curves",
        0}});
}

TEST(BadModels, NamesThatLeadOutOfTheFolderOfImages) {
  std::vector<BadCase> cases;
  for (const char* name : {"../view_000.png",
                           "a/../../view_000.png",
                           "/etc/passwd",
                           "",
                           "..",
                           "C:\\view_000.png",
                           "..\\view_000.png"}) {
    cases.push_back({std::string("the name \"") + name + "\"",
                     Model([=](ColmapModel& m) { m.images[0].name = name; }),
                     "images.bin: the name of image"});
  }
  ExpectOutcome(cases);
}

TEST(BadModels, NamesThatTerminalsWouldObey) {
  ExpectOutcome({"escapes and line breaks",
                 Model([](ColmapModel& m) {
                   for (ColmapImage& image : m.images) {
                     image.name += "\033[2J\n";
                   }
                 }),
                 "view_000.png?[2J?"});
}

// Sound by the letter; poses are refined with them, or are not.
TEST(BadModels, PointsThatMakeNoSense) {
  const auto points = [](auto change) {
    return Model([=](ColmapModel& m) {
      m.points.clear();
      m.images[0].points2D.clear();
      std::mt19937 random(1);
      AddPoints(200, 0.3, random, &m);
      change(m);
    });
  };
  const auto seen_at = [&](double value) {
    return points([=](ColmapModel& m) {
      for (ColmapImage& image : m.images) image.points2D[3].x = value;
    });
  };
  const std::vector<BadCase> cases = {
      {"seen at NaN", seen_at(kNan), "curves", 0},
      {"seen infinitely far off", seen_at(kInfinity), "curves", 0},
      {"seen beyond all images", seen_at(1e300), "curves", 0},
      {"beyond all places",
       points([](ColmapModel& m) {
         for (std::size_t i = 0; i < 40; ++i) m.points[i].position *= 1e300;
       }),
       "curves",
       0},
      {"all in one place",
       points([](ColmapModel& m) {
         for (ColmapPoint3D& point : m.points) point.position.setZero();
       }),
       "curves",
       0},
      {"tracks of one view many times",
       points([](ColmapModel& m) {
         for (ColmapPoint3D& point : m.points) {
           point.track.assign(100, point.track.front());
         }
       }),
       "curves",
       0}};
  ExpectOutcome(cases);
}

// Nothing here makes up for it.
TEST(BadModels, AFocalLengthThatIsOffIsTold) {
  SmallWorkspace workspace;
  std::mt19937 random(1);
  workspace.model.points.clear();
  workspace.model.images[0].points2D.clear();
  AddPoints(400, 0.3, random, &workspace.model);
  workspace.model.cameras[0].camera.params[0] *= 1.4;
  workspace.WriteModel();
  const Outcome outcome =
      RunProgram("--workspace_path " + Quoted(workspace.path()) +
                 " --clean --refiner none --refine_poses_with_curves 0");
  const std::string says = "px from their pixels (median)";
  EXPECT_THAT(outcome.output, testing::HasSubstr(says));
  EXPECT_THAT(Read(workspace.At("curvix/0/report.json")),
              testing::HasSubstr(says));
}

TEST(BadModels, Text) {
  std::vector<BadCase> cases;
  const auto add = [&](const std::string& name,
                       const std::string& file,
                       const std::string& text,
                       const std::string& says) {
    cases.push_back(
        {name,
         [=](SmallWorkspace& w) {
           fs::remove_all(w.At("sparse/0"));
           w.Write(InModel("cameras.txt"), FormatCamerasText(w.model.cameras));
           w.Write(InModel("images.txt"), FormatImagesText(w.model.images));
           w.Write(InModel("points3D.txt"), FormatPointsText(w.model.points));
           w.Write(InModel(file), text);
         },
         says});
  };
  const std::string pose = "1 1 0 0 0 0 0 0 1 view_000.png\n\n";
  add("no cameras", "cameras.txt", "# none\n", "taken by camera 1");
  add("no text", "cameras.txt", std::string(3000, '\0'), "cameras.txt, line 1");
  add("a long line", "cameras.txt", std::string(3000000, '1'), "line 1");
  add("too few parameters", "cameras.txt", "1 PINHOLE 64 64 9\n", "line 1");
  add("a width beyond int",
      "cameras.txt",
      "1 PINHOLE 1e9 9 1 1 1 1\n",
      "line 1");
  add("an unknown camera model", "cameras.txt", "1 NONE 9 9 1\n", "NONE");
  add("a pose cut short", "images.txt", "1 1 0 0 0 0\n", "images.txt, line 1");
  add("a rotation NaN", "images.txt", "1 nan" + pose.substr(3), "images.txt");
  add("one line of two",
      "images.txt",
      pose + pose.substr(0, 31) + pose,
      "line");
  add("half a 2D point", "images.txt", pose.substr(0, 31) + "1 2\n", "line 2");
  add("a point cut short", "points3D.txt", "1 2 3\n", "points3D.txt, line 1");
  add("a position infinite", "points3D.txt", "1 inf 0 0 0 0 0 0\n", "points3D");
  ExpectOutcome(cases);
}

}  // namespace
}  // namespace curvix

// SPDX-License-Identifier: BSD-3-Clause
// Images that are broken or unusual, folders and links that lead astray, and
// scenes that show nothing.
#include <sys/stat.h>

#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/end_to_end/bad_workspace.h"
#include "tests/plugin/import_fixtures.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// The small photograph, converted to another type of pixels and encoded.
std::string Encoded(const SmallWorkspace& workspace,
                    const std::string& extension,
                    int channels,
                    int depth) {
  const cv::Mat gray = cv::imread(workspace.At("images/view_000.png").string(),
                                  cv::IMREAD_GRAYSCALE);
  cv::Mat image;
  cv::merge(std::vector<cv::Mat>(static_cast<std::size_t>(channels), gray),
            image);
  image.convertTo(image, depth, depth == CV_16U ? 257 : 1);
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::function<void(SmallWorkspace&)> Image(const std::string& bytes) {
  return [=](SmallWorkspace& w) { w.WriteImage(bytes); };
}

std::function<void(SmallWorkspace&)> Image(const std::string& extension,
                                           int channels,
                                           int depth) {
  return [=](SmallWorkspace& w) {
    w.WriteImage(Encoded(w, extension, channels, depth));
  };
}

std::string Pgm(int width, int height, char value = '\x7f') {
  return "P5\n" + std::to_string(width) + " " + std::to_string(height) +
         "\n255\n" +
         std::string(static_cast<std::size_t>(width * height), value);
}

// A JPEG of 64 x 64 pixels in one colour of four inks: every block is two codes
// of one bit, "as before" and "nothing more".
std::string FlatCmyk() {
  using std::string_literals::operator""s;
  const std::string one_code = "\1"s + std::string(16, '\0');
  return "\xff\xd8\xff\xee\0\x0e"s + "Adobe\0\x64\0\0\0\0\0"s +
         "\xff\xdb\0\x43\0"s + std::string(64, '\1') +
         "\xff\xc0\0\x14\x08\0\x40\0\x40\4\1\x11\0\2\x11\0\3\x11\0\4\x11\0"s +
         "\xff\xc4\0\x14\0"s + one_code + "\xff\xc4\0\x14\x10"s + one_code +
         "\xff\xda\0\x0e\4\1\0\2\0\3\0\4\0\0\x3f\0"s + std::string(64, '\0') +
         "\xff\xd9"s;
}

TEST(BadImages, BrokenOnes) {
  const std::string image = "images/view_000.png";
  std::vector<BadCase> cases = {
      {"empty", Image(""), image},
      {"text", Image("hello"), image},
      {"one pixel", Image(Pgm(1, 1)), "1 x 1"},
      {"wrong size", Image(Pgm(64, 63)), "64 x 63"},
      {"turned", Image(Pgm(63, 64)), "63 x 64"},
      {"fractions", Image(".tiff", 1, CV_32F), image},
      {"only the head of a PNG", Image(PngOfSize(64, 64)), image},
      {"a PNG that unpacks to 3 GB", Image(PngOfSize(32000, 32000)), "32000"},
      {"a PNG beyond all sizes", Image(PngOfSize(2147483647, 7)), image},
      {"a PGM that is not there", Image("P5 30000 30000 255\n"), image}};
  for (const std::string extension : {".png", ".jpg", ".tiff", ".bmp"}) {
    cases.push_back({"half a " + extension,
                     [=](SmallWorkspace& w) {
                       const std::string whole =
                           Encoded(w, extension, 3, CV_8U);
                       w.WriteImage(whole.substr(0, whole.size() / 2));
                     },
                     image});
  }
  ExpectOutcome(cases);
}

// As large as the camera says, and larger than the memory.
TEST(BadImages, TooLargeForAnything) {
  ExpectOutcome({"a million by a million",
                 [](SmallWorkspace& w) {
                   Camera& camera = w.model.cameras[0].camera;
                   camera.width = camera.height = 1 << 20;
                   w.WriteModel();
                   w.WriteImages(PngOfSize(1 << 20, 1 << 20));
                 },
                 "images/view_00"});
}

TEST(BadImages, UnusualOnesAreRead) {
  ExpectOutcome(
      {{"grey", Image(".png", 1, CV_8U), "curves", 0},
       {"16 bits", Image(".png", 1, CV_16U), "curves", 0},
       {"16 bits, colour", Image(".tiff", 3, CV_16U), "curves", 0},
       {"alpha", Image(".png", 4, CV_8U), "curves", 0},
       {"CMYK", Image(FlatCmyk()), "curves", 0},
       {"JPEG by the name of PNG", Image(".jpg", 3, CV_8U), "curves", 0}});
}

TEST(BadImages, NoFiles) {
  const std::string image = "images/view_000.png";
  ExpectOutcome({{"no images/",
                  [](auto& w) { fs::remove_all(w.At("images")); },
                  "No folder of images"},
                 {"images is a file",
                  [](auto& w) {
                    fs::remove_all(w.At("images"));
                    w.Write("images", "");
                  },
                  "No folder of images"},
                 {"empty images/",
                  [](auto& w) {
                    fs::remove_all(w.At("images"));
                    fs::create_directories(w.At("images"));
                  },
                  "Only 0 of the 12 images"},
                 {"folders",
                  [](auto& w) {
                    for (const ColmapImage& i : w.model.images) {
                      fs::remove(w.At("images/" + i.name));
                      fs::create_directories(w.At("images/" + i.name));
                    }
                  },
                  "Only 0 of the 12 images"},
                 {"a pipe that nobody writes to",
                  [=](auto& w) {
                    fs::remove(w.At(image));
                    ASSERT_EQ(mkfifo(w.At(image).c_str(), 0600), 0);
                  },
                  "1 of 12 images is not in",
                  0}});
}

TEST(BadMasks, AreRefused) {
  const std::string argument = "--mask_path ";
  const std::string no_folder = "/no/such/folder";
  ExpectOutcome({{"no folder",
                  [](auto&) {},
                  "--mask_path /no/such/folder",
                  3,
                  argument + no_folder}});
  for (const auto& [name, mask, says] : std::vector<std::array<std::string, 3>>{
           {"wrong shape", Pgm(64, 60), " is 64 x 60 pixels"},
           {"broken", "mask", " is broken"},
           {"empty", "", " is an empty file"}}) {
    const TemporaryFolder masks;
    const fs::path file = masks.Write("view_000.png.png", mask);
    ExpectOutcome({{name + " mask",
                    [](auto&) {},
                    "Mask " + file.string() + says,
                    3,
                    argument + Quoted(masks.path())}});
  }
}

// What someone else may have put into a workspace.
TEST(PlantedLinks, OfModelsAndResultsAreNotFollowed) {
  const auto link = [](const std::string& name) {
    return [=](SmallWorkspace& w) {
      fs::create_directories(w.Outside("private"));
      fs::rename(w.At(name), w.Outside("private/file"));
      fs::create_symlink(w.Outside("private/file"), w.At(name));
    };
  };
  const auto output_link = [](const std::string& name) {
    return [=](SmallWorkspace& w) {
      fs::create_directories(w.Outside("private"));
      fs::create_directories(w.At(name).parent_path());
      fs::create_directory_symlink(w.Outside("private"), w.At(name));
    };
  };
  const std::string out = "is a link that leads out of the workspace";
  ExpectOutcome({{"cameras.bin", link("sparse/0/cameras.bin"), out},
                 {"points3D.bin", link("sparse/0/points3D.bin"), out},
                 {"curvix", output_link("curvix"), "curvix is a link"},
                 {"curvix/0", output_link("curvix/0"), "curvix/0 is a link"}});
}

TEST(PlantedLinks, MayLeadToNothing) {
  ExpectOutcome({{"points that are not there",
                  [](SmallWorkspace& w) {
                    fs::remove(w.At("sparse/0/points3D.bin"));
                    fs::create_symlink("/no/such",
                                       w.At("sparse/0/points3D.bin"));
                  },
                  "curves",
                  0}});
}

TEST(PlantedLinks, OfImagesAreFollowed) {
  SmallWorkspace w;
  fs::create_directories(w.Outside("photographs"));
  for (const ColmapImage& image : w.model.images) {
    const fs::path original = w.Outside("photographs/" + image.name);
    fs::rename(w.At("images/" + image.name), original);
    fs::create_symlink(original, w.At("images/" + image.name));
  }
  const Outcome outcome = RunProgram("--workspace_path " + Quoted(w.path()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

// Links in place of results are replaced, not followed.
TEST(PlantedLinks, DoNotTakeResultsElsewhere) {
  SmallWorkspace w;
  w.Write("victim/file", "precious");
  fs::create_directories(w.At("curvix/0"));
  for (const std::string name : {"curves.ply", "report.json", "project.ini"}) {
    fs::create_symlink(w.At("victim/file"), w.At("curvix/0/" + name));
  }
  for (const std::string name : {"stages", "sparse", ".unfinished-abc"}) {
    fs::create_directory_symlink(w.At("victim"), w.At("curvix/0/" + name));
  }
  const Outcome outcome = RunProgram("--workspace_path " + Quoted(w.path()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(Contents(w.At("victim")),
              testing::ElementsAre(testing::Pair("file", "precious")));
  EXPECT_FALSE(fs::is_symlink(w.At("curvix/0/curves.ply")));
}

TEST(BadProjects, OfColmapAreOverlooked) {
  ExpectOutcome({{"no text",
                  [](auto& w) {
                    w.Write("sparse/0/project.ini", std::string(999, '\xff'));
                  },
                  "curves",
                  0},
                 {"images elsewhere that are not there",
                  [](auto& w) {
                    fs::remove_all(w.At("images"));
                    w.Write("sparse/0/project.ini", "image_path=/no/such\n");
                  },
                  "/no/such"}});
}

// Where every image is the same, so may be some edge; nothing breaks.
TEST(PoorScenes, OneImageInAllPlaces) {
  const SmallWorkspace w;
  w.WriteImages(Encoded(w, ".png", 3, CV_8U));
  const Outcome outcome = RunProgram("--workspace_path " + Quoted(w.path()));
  EXPECT_THAT(outcome.exit_code, testing::AnyOf(0, 5)) << outcome.output;
}

TEST(PoorScenes, ShowNothing) {
  const auto poses = [](auto change) {
    return Model([=](ColmapModel& m) {
      for (ColmapImage& image : m.images) change(image.cam_from_world);
    });
  };
  const auto camera = [](std::size_t param, double value) {
    return Model(
        [=](ColmapModel& m) { m.cameras[0].camera.params[param] = value; });
  };
  const std::string none = "No curves: ";
  ExpectOutcome({{"all cameras in one place",
                  poses([](Rigid3& p) { p = Rigid3(); }),
                  none,
                  5},
                 {"a pure rotation",
                  poses([](Rigid3& p) { p.translation.setZero(); }),
                  none,
                  5},
                 {"very far away",
                  poses([](Rigid3& p) { p.translation *= 1e300; }),
                  none,
                  5},
                 {"very small",
                  poses([](Rigid3& p) { p.translation *= 1e-300; }),
                  none,
                  5},
                 {"a focal length of nothing", camera(0, 1e-300), none, 5},
                 {"a focal length beyond all", camera(0, 1e300), none, 5},
                 {"a principal point far off", camera(2, -1e300), none, 5},
                 {"blank images",
                  [](SmallWorkspace& w) { w.WriteImages(Pgm(64, 64)); },
                  none,
                  5},
                 {"images of one pixel",
                  [](SmallWorkspace& w) {
                    Camera& c = w.model.cameras[0].camera;
                    c.width = c.height = 1;
                    w.WriteModel();
                    w.WriteImages(Pgm(1, 1));
                  },
                  none,
                  5}});
}

}  // namespace
}  // namespace curvix

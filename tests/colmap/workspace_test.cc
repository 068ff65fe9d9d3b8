// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/workspace.h"

#include <curvix/colmap_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A folder in which models and images are laid out.
class WorkspaceTest : public ::testing::Test {
 protected:
  fs::path At(const std::string& name) const { return folder_.path() / name; }

  // A model of `num_images` images image_1.png, image_2.png, ...
  void MakeModel(const std::string& name, int num_images = 4) const {
    folder_.Write(name + "/cameras.txt", "1 PINHOLE 9 9 5 5 4 4\n");
    std::string images;
    for (int i = 1; i <= num_images; ++i) {
      images += std::to_string(i) + " 1 0 0 0 0 0 0 1 image_" +
                std::to_string(i) + ".png\n\n";
    }
    folder_.Write(name + "/images.txt", images);
  }

  void MakeImages(const std::string& name, int num_images = 4) const {
    for (int i = 1; i <= num_images; ++i) {
      folder_.Write(name + "/image_" + std::to_string(i) + ".png", "");
    }
  }

  void Expect(const WorkspacePaths& paths,
              const std::string& model,
              const std::string& images,
              const std::string& output) const {
    const Result<Workspace> found = FindWorkspace(paths);
    ASSERT_TRUE(found.ok()) << found.status().message();
    EXPECT_TRUE(fs::equivalent(found->model_path, At(model)))
        << found->model_path;
    EXPECT_TRUE(fs::equivalent(found->image_path, At(images)))
        << found->image_path;
    EXPECT_EQ(found->output_path, At(output));
  }

  WorkspacePaths Root() const {
    WorkspacePaths paths;
    paths.workspace_path = At("proj");
    return paths;
  }

  TemporaryFolder folder_;
};

TEST_F(WorkspaceTest, FindsSparse0) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/images");
  MakeModel("proj/dense/0/sparse");
  MakeImages("proj/dense/0/images");
  Expect(Root(), "proj/sparse/0", "proj/images", "proj/curvix/0");
  EXPECT_THAT(FindWorkspace(Root())->notes, IsEmpty());
  WorkspacePaths slash = Root();
  slash.workspace_path += "/";
  Expect(slash, "proj/sparse/0", "proj/images", "proj/curvix/0");
}

TEST_F(WorkspaceTest, FindsSparse) {
  MakeModel("proj/sparse");
  MakeImages("proj/images");
  Expect(Root(), "proj/sparse", "proj/images", "proj/curvix");
}

TEST_F(WorkspaceTest, FindsADenseWorkspaceWithItsOwnImages) {
  MakeModel("proj/dense/0/sparse");
  MakeImages("proj/dense/0/images");
  MakeImages("proj/images");
  Expect(Root(),
         "proj/dense/0/sparse",
         "proj/dense/0/images",
         "proj/dense/0/curvix");
  WorkspacePaths dense = Root();
  dense.workspace_path = At("proj/dense/0");
  Expect(dense,
         "proj/dense/0/sparse",
         "proj/dense/0/images",
         "proj/dense/0/curvix");
}

TEST_F(WorkspaceTest, FindsADenseWorkspaceWithoutANumber) {
  MakeModel("proj/dense/sparse");
  MakeImages("proj/dense/images");
  Expect(Root(), "proj/dense/sparse", "proj/dense/images", "proj/dense/curvix");
}

TEST_F(WorkspaceTest, DoesNotTakeDistortedImagesForADenseModel) {
  MakeModel("proj/dense/0/sparse");
  MakeImages("proj/images");
  EXPECT_EQ(FindWorkspace(Root()).status().code(), StatusCode::kNotFound);
}

TEST_F(WorkspaceTest, TheWorkspaceMayBeTheModel) {
  MakeModel("proj");
  MakeImages("proj/images");
  Expect(Root(), "proj", "proj/images", "proj/curvix");
  MakeModel("other/sparse/2");
  MakeImages("other/images");
  WorkspacePaths model;
  model.workspace_path = At("other/sparse/2");
  Expect(model, "other/sparse/2", "other/images", "other/curvix/2");
}

TEST_F(WorkspaceTest, TakesTheModelWithMostImagesAndSaysSo) {
  MakeModel("proj/sparse/0", 3);
  MakeModel("proj/sparse/1", 4);
  MakeModel("proj/sparse/2", 4);
  MakeImages("proj/images");
  for (const fs::path& named : {fs::path(), At("proj/sparse")}) {
    WorkspacePaths paths = Root();
    paths.input_path = named;
    Expect(paths, "proj/sparse/1", "proj/images", "proj/curvix/1");
    const Result<Workspace> found = FindWorkspace(paths);
    ASSERT_EQ(found->notes.size(), 1u);
    EXPECT_THAT(found->notes[0], HasSubstr("the most images (4)"));
    EXPECT_THAT(found->notes[0], HasSubstr("(0, 2), which --input_path"));
  }
}

TEST_F(WorkspaceTest, SaysNothingOfTheModelThatIsNamed) {
  MakeModel("proj/sparse/0", 3);
  MakeModel("proj/sparse/1", 4);
  MakeImages("proj/images");
  WorkspacePaths paths;
  paths.workspace_path = At("proj/sparse/0");
  const Result<Workspace> found = FindWorkspace(paths);
  ASSERT_TRUE(found.ok()) << found.status().message();
  EXPECT_THAT(found->notes, testing::IsEmpty());
}

TEST_F(WorkspaceTest, TakesTheFirstOfModelsThatHaveAsManyImages) {
  for (const std::string k : {"10", "2", "0", "not_a_number"}) {
    MakeModel("proj/sparse/" + k);
  }
  fs::create_directories(At("proj/sparse/1"));  // no model
  MakeImages("proj/images");
  Expect(Root(), "proj/sparse/0", "proj/images", "proj/curvix/0");
  const Result<Workspace> found = FindWorkspace(Root());
  ASSERT_EQ(found->notes.size(), 1u);
  EXPECT_THAT(found->notes[0], HasSubstr("(2, 10), which --input_path"));
}

TEST_F(WorkspaceTest, GivenPathsWin) {
  MakeModel("proj/sparse/0");
  MakeModel("proj/sparse/1");
  MakeModel("proj/sparse_txt");
  MakeModel("elsewhere/sparse/0");
  MakeImages("proj/images");
  MakeImages("photos");
  WorkspacePaths paths = Root();
  paths.input_path = At("proj/sparse/1");
  Expect(paths, "proj/sparse/1", "proj/images", "proj/curvix/1");
  MakeModel("proj/sparse/1/0");
  Expect(paths, "proj/sparse/1", "proj/images", "proj/curvix/1");
  paths.input_path = At("proj/sparse_txt");
  Expect(paths, "proj/sparse_txt", "proj/images", "proj/curvix/sparse_txt");
  paths.input_path = At("elsewhere/sparse/0");
  Expect(paths, "elsewhere/sparse/0", "proj/images", "proj/curvix/0");
  paths.image_path = At("photos");
  paths.output_path = At("results");
  Expect(paths, "elsewhere/sparse/0", "photos", "results");
}

TEST_F(WorkspaceTest, AModelElsewhereMayBringItsImages) {
  fs::create_directories(At("proj"));
  MakeModel("elsewhere/sparse/0");
  MakeImages("elsewhere/images");
  WorkspacePaths paths = Root();
  paths.input_path = At("elsewhere/sparse/0");
  Expect(paths, "elsewhere/sparse/0", "elsewhere/images", "proj/curvix/0");
}

TEST_F(WorkspaceTest, LinkedModelsKeepTheirResultsBesideTheLink) {
  MakeModel("data/sparse/0");
  MakeImages("data/images");
  fs::create_directories(At("proj"));
  fs::create_directory_symlink(At("data/sparse"), At("proj/sparse"));
  fs::create_directory_symlink(At("data/images"), At("proj/images"));
  Expect(Root(), "data/sparse/0", "data/images", "proj/curvix/0");
}

TEST_F(WorkspaceTest, ResultsDoNotFollowLinks) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/images");
  fs::create_directories(At("private/0"));
  fs::create_directory_symlink(At("private"), At("proj/curvix"));
  const Result<Workspace> found = FindWorkspace(Root());
  ASSERT_TRUE(found.ok()) << found.status().message();
  const Status status = CheckOutputLinks(Root(), *found);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr("curvix is a link"));
  WorkspacePaths given = Root();
  given.output_path = At("proj/curvix/0");
  EXPECT_TRUE(CheckOutputLinks(given, *FindWorkspace(given)).ok());
  // Nothing is written.
  EXPECT_TRUE(ReadColmapScene(At("proj")).ok());
}

TEST_F(WorkspaceTest, ResultsOfAModelCalledCurvixDoNotFollowLinks) {
  MakeModel("elsewhere/curvix");
  MakeImages("proj/images");
  WorkspacePaths paths = Root();
  paths.input_path = At("elsewhere/curvix");
  Expect(paths, "elsewhere/curvix", "proj/images", "proj/curvix/curvix");
  EXPECT_TRUE(CheckOutputLinks(paths, *FindWorkspace(paths)).ok());
  fs::create_directories(At("private"));
  fs::create_directory_symlink(At("private"), At("proj/curvix"));
  EXPECT_EQ(CheckOutputLinks(paths, *FindWorkspace(paths)).code(),
            StatusCode::kInvalidArgument);
}

TEST_F(WorkspaceTest, TheWorkspaceMayBeALinkCalledCurvix) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/images");
  fs::create_directory_symlink(At("proj"), At("curvix"));
  WorkspacePaths paths;
  paths.workspace_path = At("curvix");
  Expect(paths, "proj/sparse/0", "proj/images", "curvix/curvix/0");
  EXPECT_TRUE(CheckOutputLinks(paths, *FindWorkspace(paths)).ok());
}

TEST_F(WorkspaceTest, ProjectFileNamesTheImages) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/photos");
  folder_.Write("proj/sparse/0/project.ini",
                "log_level=2\r\nimage_path = photos\r\n[Mapper]\r\n");
  Expect(Root(), "proj/sparse/0", "proj/photos", "proj/curvix/0");
  MakeImages("absolute");
  folder_.Write("proj/sparse/0/project.ini",
                "image_path=" + At("absolute").string() + "\n");
  Expect(Root(), "proj/sparse/0", "absolute", "proj/curvix/0");
}

TEST_F(WorkspaceTest, ErrorsListThePlacesThatWereTried) {
  WorkspacePaths paths;
  EXPECT_EQ(FindWorkspace(paths).status().code(), StatusCode::kInvalidArgument);
  const auto expect = [](const WorkspacePaths& given, const std::string& text) {
    const Status status = FindWorkspace(given).status();
    EXPECT_EQ(status.code(), StatusCode::kNotFound);
    EXPECT_THAT(status.message(), HasSubstr(text));
  };
  expect(Root(), "is not a folder");
  fs::create_directories(At("proj/sparse/3"));
  expect(Root(), At("proj/sparse/3").string());
  expect(Root(), At("proj/sparse").string() + ",");
  expect(Root(), At("proj/dense/0/sparse").string());
  expect(Root(), "--input_path");
  MakeModel("proj/sparse/3");
  folder_.Write("proj/sparse/3/project.ini", "image_path=gone\n");
  expect(Root(), At("proj/images").string());
  expect(Root(), At("proj/gone").string());
  expect(Root(), "--image_path");
  WorkspacePaths given = Root();
  given.input_path = At("proj");
  expect(given, "proj holds no COLMAP model");
  given = Root();
  given.image_path = At("proj/none");
  expect(given, "none is not a folder");
}

TEST_F(WorkspaceTest, BackslashesInNamesMeanFolders) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/images");
  folder_.Write("proj/sparse/0/images.txt",
                "1 1 0 0 0 0 0 0 1 image_1.png\n\n"
                "2 1 0 0 0 0 0 0 1 left\\image_2.png\n\n"
                "3 1 0 0 0 0 0 0 1 a\\b.png\n\n");
  folder_.Write("proj/images/left/image_2.png", "");
  folder_.Write("proj/images/a/b.png", "");
  folder_.Write("proj/images/a\\b.png", "");
  folder_.Write("proj/masks/left/image_2.png.png", "");
  WorkspacePaths paths = Root();
  paths.mask_path = At("proj/masks");
  const Result<Workspace> workspace = FindWorkspace(paths);
  ASSERT_TRUE(workspace.ok()) << workspace.status().message();
  const Result<WorkspaceScene> scene = LoadWorkspaceScene(*workspace);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  ASSERT_EQ(scene->scene.views.size(), 3u);
  // By name; a file of the very name wins.
  EXPECT_EQ(scene->scene.views[0].image_path.filename(), "a\\b.png");
  const View& left = scene->scene.views[2];
  EXPECT_EQ(left.name, "left\\image_2.png");
  EXPECT_TRUE(
      fs::equivalent(left.image_path, At("proj/images/left/image_2.png")));
  EXPECT_TRUE(
      fs::equivalent(left.mask_path, At("proj/masks/left/image_2.png.png")));
}

TEST_F(WorkspaceTest, SceneSkipsAndNamesMissingImages) {
  MakeModel("proj/sparse/0", 12);
  MakeImages("proj/images", 12);
  const Result<Workspace> workspace = FindWorkspace(Root());
  ASSERT_TRUE(workspace.ok());
  Result<WorkspaceScene> scene = LoadWorkspaceScene(*workspace);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->scene.views.size(), 12u);
  EXPECT_THAT(scene->notes, IsEmpty());

  for (const std::string k : {"1", "2", "4", "5", "6", "7"}) {
    fs::remove(At("proj/images/image_" + k + ".png"));
  }
  scene = LoadWorkspaceScene(*workspace);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->model.images.size(), 12u);
  EXPECT_EQ(scene->scene.views.size(), 6u);
  EXPECT_TRUE(fs::exists(scene->scene.views[0].image_path));
  EXPECT_EQ(scene->missing_images.size(), 6u);
  ASSERT_EQ(scene->notes.size(), 1u);
  EXPECT_THAT(scene->notes[0], HasSubstr("6 of 12 images are not in"));
  EXPECT_THAT(scene->notes[0],
              HasSubstr("image_1.png, image_2.png, image_4.png, image_5.png, "
                        "image_6.png and 1 more."));
}

TEST_F(WorkspaceTest, FindsMasksAsColmapNamesThem) {
  MakeModel("proj/sparse/0");
  MakeImages("proj/images");
  for (const std::string name : {"image_1.png.png",
                                 "image_1.png",  // first
                                 "image_2.png"}) {
    folder_.Write("masks/" + name, "");
  }
  WorkspacePaths paths = Root();
  paths.mask_path = At("masks");
  const Result<WorkspaceScene> scene =
      LoadWorkspaceScene(*FindWorkspace(paths));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const std::vector<View>& views = scene->scene.views;
  ASSERT_EQ(views.size(), 4u);
  EXPECT_EQ(views[0].mask_path, At("masks/image_1.png.png"));
  EXPECT_EQ(views[1].mask_path, At("masks/image_2.png"));
  EXPECT_EQ(views[2].mask_path, "");
  ASSERT_EQ(scene->notes.size(), 1u);
  EXPECT_THAT(scene->notes[0], HasSubstr("2 of 4 images have no mask"));
  EXPECT_THAT(scene->notes[0], HasSubstr("image_3.png, image_4.png"));
  EXPECT_THAT(scene->notes[0], HasSubstr("would be called image_3.png.png"));

  paths.mask_path = At("proj/images");
  const Result<WorkspaceScene> without =
      LoadWorkspaceScene(*FindWorkspace(paths));
  ASSERT_TRUE(without.ok()) << without.status().message();
  EXPECT_THAT(without->notes[0], HasSubstr("4 of 4 images have no mask"));

  paths.mask_path = At("no_masks");
  const Status status = FindWorkspace(paths).status();
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_THAT(status.message(), HasSubstr("no_masks is not a folder"));
}

TEST_F(WorkspaceTest, FoldersThatMayNotBeReadAreNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  MakeModel("proj/sparse/0", 4);
  MakeImages("proj/images", 4);
  fs::permissions(At("proj/images"), fs::perms::none);
  const Status status = LoadWorkspaceScene(*FindWorkspace(Root())).status();
  fs::permissions(At("proj/images"), fs::perms::owner_all);
  fs::permissions(At("proj/sparse"), fs::perms::none);
  EXPECT_THAT(
      FindWorkspace(Root()).status().message(),
      testing::AllOf(HasSubstr("sparse"), HasSubstr("may not be read")));
  fs::permissions(At("proj/sparse"), fs::perms::owner_all);
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_THAT(status.message(), HasSubstr("images may not be read (Perm"));
}

TEST_F(WorkspaceTest, FewerThanThreeViewsAreAnError) {
  MakeModel("proj/sparse/0", 4);
  MakeImages("proj/images", 2);
  const Status missing = LoadWorkspaceScene(*FindWorkspace(Root())).status();
  EXPECT_EQ(missing.code(), StatusCode::kNotFound);
  EXPECT_THAT(missing.message(), HasSubstr("Only 2 of the 4 images"));
  EXPECT_THAT(missing.message(), HasSubstr("image_3.png, image_4.png"));
  EXPECT_THAT(missing.message(), HasSubstr("--image_path"));
  MakeModel("proj/sparse/0", 2);
  const Status small = LoadWorkspaceScene(*FindWorkspace(Root())).status();
  EXPECT_EQ(small.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(small.message(), HasSubstr("has 2 images"));
}

}  // namespace
}  // namespace curvix

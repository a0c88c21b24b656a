// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_document.h"
#include "editor/model/expected_view.h"
#include "editor/model/picker.h"
#include "project/verb.h"

namespace standpoint {
namespace {

// A wall of grey 0.5 across +Y at 10 m, 8 m wide and high; the camera looks at it head-on from the station.
struct ExpectedStage {
  std::shared_ptr<const Environment> environment;
  std::shared_ptr<const RayScene> scene;
  Instrument instrument;
  ExpectedRequest request;

  ExpectedStage() {
    auto e = std::make_shared<Environment>();
    e->surfaces.push_back({"grey", {0.5F, 0.5F, 0.5F, 1}});
    e->products.resize(1);
    auto wall = std::make_shared<Mesh>();
    wall->positions = {{-4, 10, -4}, {4, 10, -4}, {4, 10, 4}, {-4, 10, 4}};
    wall->triangles = {{0, 1, 2}, {0, 2, 3}};
    wall->surface_of_triangle = {0, 0};
    e->meshes = {wall};
    e->instances = {{0, 0, Eigen::Affine3d::Identity()}};
    environment = e;
    Progress progress;
    scene = *RayScene::build(environment, progress);
    instrument =
        *readInstrument(std::filesystem::path(dataFolder()) / "scanners" / "instruments" / "leica-rtc360.json");
    KeptExpectation kept;
    request.expectation = kept.of(scene, nullptr, instrument);
    request.scene = scene;
    request.view.camera = {{0, 10, 0}, 10, 0, 0, 0.7, false};
    request.width = 120;
    request.height = 90;
  }
};

TEST(ExpectedView, PaintsEveryPixelOfASurfaceWithWhatComesBackFromIt) {
  ExpectedStage stage;
  std::atomic<int> woken{0};
  ExpectedView view([&] { ++woken; });
  view.want(stage.request);
  view.wait();
  const auto picture = view.picture(stage.request.view.camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 120);  // the finest of three
  EXPECT_EQ(woken.load(), 3);
  const auto expected = stage.request.expectation->from(stage.request.station, {{0, 10, 0}, {0, -1, 0}, 0, 0});
  ASSERT_EQ(expected.fate, ReturnFate::returned);
  EXPECT_EQ(picture->rgba[45 * 120 + 60], expectedColour(ExpectedQuantity::intensity, expected));  // head-on: fully lit
}

TEST(ExpectedView, ShowsAMovedStationThroughTheSameCamera) {
  ExpectedStage stage;
  ExpectedView view({});
  stage.request.quantity = ExpectedQuantity::fate;
  view.want(stage.request);
  view.wait();
  stage.request.station = {0, 20, 0};  // behind the wall
  view.want(stage.request);
  view.wait();
  const auto picture = view.picture(stage.request.view.camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->rgba[45 * 120 + 60], fateColour(ReturnFate::hidden));
}

TEST(ExpectedView, HasNoPictureForAnotherCameraOrAfterItWasDropped) {
  ExpectedStage stage;
  ExpectedView view({});
  view.want(stage.request);
  view.wait();
  Camera other = stage.request.view.camera;
  other.distance_m += 1;
  EXPECT_FALSE(view.picture(other));
  view.drop();
  EXPECT_FALSE(view.picture(stage.request.view.camera));
  view.want(stage.request);  // and it can be asked again
  view.wait();
  EXPECT_TRUE(view.picture(stage.request.view.camera));
}

TEST(ExpectedView, LeavesTheSkyTransparentAndHiddenProductsOut) {
  ExpectedStage stage;
  ExpectedView view({});
  stage.request.view.hidden = std::make_shared<const HiddenProducts>(1, 1);
  view.want(stage.request);
  view.wait();
  const auto picture = view.picture(stage.request.view.camera);
  ASSERT_TRUE(picture);
  for (const auto& pixel : picture->rgba) ASSERT_EQ(pixel[3], 0);
}

}  // namespace
}  // namespace standpoint

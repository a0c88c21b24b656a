// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/model/selection_view.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

class SelectionView : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
  }
  // By rays through all of the picture.
  bool isSeen(std::uint32_t product) const {
    constexpr int kRays = 120;
    const auto state = editor.viewState();
    const auto& size = editor.view.size;
    for (int i = 0; i < kRays; ++i)
      for (int k = 0; k < kRays; ++k) {
        const Eigen::Vector2d pixel((i + 0.5) / kRays * size.x(), (k + 0.5) / kRays * size.y());
        const auto hit = editor.picker.pick(rayThrough(editor.view.camera, pixel, size), state);
        if (hit && hit->product == product) return true;
      }
    return false;
  }
  void lookFromOutside() {
    editor.visibility.cut_height_m.reset();
    look(editor.view.camera, StandardView::corner);
    editor.bringIntoView(editor.buildingBounds());
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(SelectionView, BringsEachProductIntoSightWhateverStandsBeforeIt) {
  const auto& products = editor.environment()->products;
  int cut = 0, shown = 0;
  for (std::uint32_t p = 0; p < products.size(); ++p) {
    lookFromOutside();
    editor.select(p, false);
    if (editor.selectionBounds().empty() || !products[p].inScene()) continue;
    showSelection(editor);
    EXPECT_TRUE(isSeen(p)) << products[p].name;
    ++shown;
    if (editor.visibility.cut_height_m) ++cut;
  }
  EXPECT_GT(shown, 5);
  EXPECT_GT(cut, 0) << "what stands in a room is seen from above only";
  EXPECT_LT(cut, shown) << "what is seen from outside needs no cut";
}

TEST_F(SelectionView, KeepsTheDirectionFromWhichItIsSeenAlready) {
  lookFromOutside();
  const auto hit =
      editor.picker.pick(rayThrough(editor.view.camera, editor.view.size / 2, editor.view.size), editor.viewState());
  ASSERT_TRUE(hit);
  editor.select(hit->product, false);
  const auto before = editor.view.camera;
  showSelection(editor);
  EXPECT_EQ(editor.view.camera.azimuth_rad, before.azimuth_rad);
  EXPECT_EQ(editor.view.camera.elevation_rad, before.elevation_rad);
  EXPECT_FALSE(editor.visibility.cut_height_m);
  goBackInViews(editor);
  EXPECT_EQ(editor.view.camera, before);
}

TEST_F(SelectionView, ACutThatNobodyAskedForGoesWithWhatItWasMadeFor) {
  editor.visibility.cut_height_m.reset();
  editor.visibility.cutForSight(1.4);
  editor.visibility.cutForSight(2.5);
  gui.frames(2);
  EXPECT_EQ(editor.visibility.cut_height_m, 2.5);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.visibility.cut_height_m) << "as it was before the first of them";

  editor.visibility.cutForSight(1.4);
  editor.visibility.cut_height_m = 3.0;  // chosen
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.visibility.cut_height_m, 3.0);
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/widgets/keyboard.h"
#include "editor/widgets/number_field.h"
#include "editor/words/words.h"
#include "item_probe.h"

namespace standpoint {
namespace {

// Two fields and a slider on an otherwise empty window.
class NumberField : public ::testing::Test {
 protected:
  NumberField() {
    gui.draws = [this] {
      ImGui::SetNextWindowSize({400, 300});
      ImGui::SetNextWindowPos({100, 100});
      ImGui::Begin("fields");
      ImGui::SetNextItemWidth(200);
      changes += ui::numberField("###length", length, format) ? 1 : 0;
      ImGui::SetNextItemWidth(200);
      ui::numberField("###other", other, {});
      ImGui::SetNextItemWidth(260);
      ui::numberSlider("###slider", pulled, 0, 10, {.kind = {.unit = "mm", .least = 0, .most = 20}, .decimals = 1});
      bottom = ImGui::GetCursorPosY();
      ImGui::End();
    };
    gui.frames(3);
  }
  void typeInto(const char* id, const char* text) {
    ASSERT_TRUE(gui.click(id)) << id;
    gui.type(text);
  }
  bool edited() { return ImGui::GetIO().WantTextInput; }

  Editor editor{{}, [] {}};
  GuiDriver gui{editor};
  NumberFormat format{.kind = {.unit = "m", .least = 0, .most = 10}, .decimals = 2};
  double length = 1.25, other = 7, pulled = 5;
  int changes = 0;
  float bottom = 0;
};

TEST_F(NumberField, TakesOverWithEnterWithTabAndWithAClickElsewhere) {
  typeInto("###length", "3.05");
  EXPECT_EQ(length, 1.25) << "not while it is typed";
  gui.key(kKeyEnter);
  EXPECT_EQ(length, 3.05);
  typeInto("###length", "3.4-35cm");
  gui.key(kKeyTab);
  gui.frames(2);
  EXPECT_DOUBLE_EQ(length, 3.05);
  typeInto("###length", "2,5");
  gui.moveTo({700, 700});
  gui.press();
  EXPECT_EQ(length, 2.5);
  typeInto("###length", "4");
  typeInto("###other", "1");
  EXPECT_EQ(length, 4) << "a click into the next field";
}

TEST_F(NumberField, TakesBackWithEscape) {
  typeInto("###length", "3.05");
  gui.key(kKeyEscape);
  EXPECT_EQ(length, 1.25);
  EXPECT_EQ(changes, 0);
  EXPECT_FALSE(edited());
}

TEST_F(NumberField, LosesNoDigitWhenItIsOnlyVisited) {
  length = 1.0 / 3;
  ASSERT_TRUE(gui.click("###length"));
  EXPECT_TRUE(edited());
  gui.key(kKeyTab);
  gui.frames(2);
  gui.key(kKeyEnter);
  gui.frames(2);
  EXPECT_EQ(length, 1.0 / 3);
  EXPECT_EQ(changes, 0);
}

TEST_F(NumberField, KeepsWhatItCannotTakeAndSaysWhy) {
  const float without = bottom;
  typeInto("###length", "abc");
  gui.key(kKeyEnter);
  EXPECT_EQ(length, 1.25);
  EXPECT_GT(bottom, without) << "the reason is below the field";
  ASSERT_TRUE(gui.click("###length"));
  gui.key(kKeyTab);
  gui.frames(2);
  EXPECT_GT(bottom, without) << "visiting it cures nothing";
  typeInto("###length", "11");
  gui.key(kKeyEnter);
  EXPECT_EQ(length, 1.25) << "out of range";
  EXPECT_GT(bottom, without);
  typeInto("###length", "9");
  gui.key(kKeyEnter);
  gui.frames(2);
  EXPECT_EQ(length, 9);
  EXPECT_EQ(bottom, without);
}

TEST_F(NumberField, ForgetsWhatItCannotTakeWithEscapeAndWhenTheValueChanges) {
  const float without = bottom;
  typeInto("###length", "abc");
  gui.key(kKeyEnter);
  ASSERT_TRUE(gui.click("###length"));
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(bottom, without);
  typeInto("###length", "abc");
  gui.key(kKeyEnter);
  length = 2;  // an undo
  gui.frames(2);
  EXPECT_EQ(bottom, without);
}

TEST_F(NumberField, SelectsAllWhenItIsEntered) {
  typeInto("###length", "5");
  gui.key(kKeyEnter);
  EXPECT_EQ(length, 5) << "not 1.255";
}

TEST_F(NumberField, IsSteppedByItsButtonsWithinItsRange) {
  format.step = 0.1;
  length = 9.95;
  gui.frames(2);
  ASSERT_TRUE(gui.click("+###more"));
  EXPECT_EQ(length, 10);
  ASSERT_TRUE(gui.click("-###less"));
  EXPECT_EQ(length, 9.9);
}

TEST_F(NumberField, IsDraggedByItsUnitAndPutBackByEscape) {
  format.drag = 0.01;
  gui.frames(2);
  const auto* unit = gui.find("###length-drag");
  ASSERT_NE(unit, nullptr);
  gui.moveTo(unit->rect.GetCenter());
  ImGui::GetIO().MouseDown[0] = true;
  gui.frame();
  ImGui::GetIO().MousePos.x += 50;
  gui.frame();
  EXPECT_NEAR(length, 1.75, 0.02);
  gui.key(kKeyEscape);
  EXPECT_EQ(length, 1.25);
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  EXPECT_EQ(length, 1.25);
}

TEST_F(NumberField, ASlidersFieldIsExactBeyondItsBar) {
  typeInto("###slider", "12.3456");
  gui.key(kKeyEnter);
  EXPECT_EQ(pulled, 12.3456);
  gui.frames(5);
  EXPECT_EQ(pulled, 12.3456) << "the bar does not pull it back";
}

TEST_F(NumberField, ASlidersBarIsPulledAndPutBackByEscape) {
  const auto* bar = gui.find("###slider-bar");
  ASSERT_NE(bar, nullptr);
  const auto box = bar->rect;
  gui.moveTo({box.Min.x + box.GetWidth() * 0.8F, box.GetCenter().y});
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  EXPECT_NEAR(pulled, 8, 0.5);
  EXPECT_DOUBLE_EQ(pulled * 10, std::round(pulled * 10)) << "in the places that are shown";
  gui.key(kKeyEscape);
  EXPECT_EQ(pulled, 5);
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
}

TEST_F(NumberField, AClickWithControlOnTheBarGoesIntoTheField) {
  const auto* bar = gui.find("###slider-bar");
  ASSERT_NE(bar, nullptr);
  gui.moveTo({bar->rect.Min.x + bar->rect.GetWidth() * 0.8F, bar->rect.GetCenter().y});
  keyboard::change(kKeyControl, true);
  gui.press();
  keyboard::change(kKeyControl, false);
  gui.frames(2);
  EXPECT_EQ(pulled, 5);
  EXPECT_TRUE(edited());
  gui.type("2");
  gui.key(kKeyEnter);
  EXPECT_EQ(pulled, 2);
}

TEST_F(NumberField, HasTheDecimalSignOfTheLanguageAndReadsEither) {
  speak("de");
  EXPECT_TRUE(gui.says("1,25"));
  EXPECT_TRUE(gui.says("5,0")) << "a slider";
  ASSERT_TRUE(gui.click("###length"));
  EXPECT_TRUE(gui.says("1,25")) << "while it is edited";
  for (const auto* typed : {"2,5", "2.5"}) {
    gui.type(typed);
    gui.key(kKeyEnter);
    EXPECT_EQ(length, 2.5) << typed;
    EXPECT_TRUE(gui.says("2,50"));
    length = 1.0 / 3;
    gui.frames(2);
    ASSERT_TRUE(gui.click("###length"));
  }
  gui.key(kKeyTab);
  gui.frames(2);
  EXPECT_EQ(length, 1.0 / 3) << "only visited";
  speak("en");
  EXPECT_TRUE(gui.says("0.33"));
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/shell/shell.h"
#include "item_probe.h"

namespace standpoint {
namespace {

class LogPanel : public ::testing::Test {
 protected:
  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(LogPanel, TheLogOpensAtItsNewestLineAndFollowsItUnlessSomebodyScrollsUp) {
  open();
  for (int i = 0; i < 200; ++i) editor.session.say(LogLevel::note, "", "Entry " + std::to_string(i));
  editor.workspace = Workspace::environment;
  const auto shows = [&](const std::string& text) {
    itemProbe().texts.clear();
    itemProbe().listens = true;
    gui.frames(2);
    itemProbe().listens = false;
    return std::find(itemProbe().texts.begin(), itemProbe().texts.end(), text) != itemProbe().texts.end();
  };
  openPanel(editor, Workspace::environment, "log");
  gui.frames(4);
  EXPECT_TRUE(shows("Entry 199"));
  EXPECT_FALSE(shows("Entry 0"));
  editor.session.say(LogLevel::note, "", "Entry 200");
  gui.frames(2);
  EXPECT_TRUE(shows("Entry 200"));
  openPanel(editor, Workspace::environment, "tasks");
  gui.frames(3);
  for (int i = 201; i < 300; ++i) editor.session.say(LogLevel::note, "", "Entry " + std::to_string(i));
  gui.frames(3);
  openPanel(editor, Workspace::environment, "log");
  gui.frames(4);
  EXPECT_TRUE(shows("Entry 299")) << "also after it was behind another panel";
  const auto* table = gui.find("###log-clear");
  ASSERT_NE(table, nullptr);
  gui.moveTo({table->rect.Min.x, table->rect.Max.y + 40});
  for (int i = 0; i < 8; ++i) {
    ImGui::GetIO().MouseWheel = 1;
    gui.frame();
    ImGui::GetIO().MouseWheel = 0;
    gui.frame();
  }
  EXPECT_FALSE(shows("Entry 299"));
  editor.session.say(LogLevel::note, "", "Entry 300");
  gui.frames(3);
  EXPECT_FALSE(shows("Entry 300")) << "what somebody reads stays in place";
}

TEST_F(LogPanel, ARowOfTheLogIsCopiedByItsMenu) {
  open();
  editor.session.clearLog();
  editor.session.say(LogLevel::warning, "house.ifc line 7", "An opening is not cut");
  openPanel(editor, Workspace::environment, "log");
  gui.frames(4);
  const auto* row = gui.find("###log-row");
  ASSERT_NE(row, nullptr);
  gui.moveTo(row->rect.GetCenter());
  gui.press(1);
  gui.frames(2);
  ASSERT_TRUE(gui.click("###copy-log-row"));
  gui.frames(2);
  const std::string copied = ImGui::GetClipboardText();
  EXPECT_TRUE(copied.ends_with("\thouse.ifc line 7\tAn opening is not cut\n")) << copied;
}

TEST_F(LogPanel, AMessageOfTheLogHasTheRoomThatTheSourcesDoNotNeed) {
  open();
  editor.session.clearLog();
  editor.session.say(LogLevel::note, "#12", "short");
  openPanel(editor, Workspace::environment, "log");
  gui.frames(4);
  const auto* row = gui.find("###log-row");
  ASSERT_NE(row, nullptr);
  const auto scale = editor.px(1);
  const float room = row->rect.GetWidth() - (18 + 62 + 6 * 8) * scale - ImGui::CalcTextSize("#12").x;
  std::string message = "Cut";
  while (ImGui::CalcTextSize((message + " a").c_str()).x < room - 20 * scale) message += " a";
  editor.session.say(LogLevel::note, "#13", message);
  gui.frames(3);
  EXPECT_TRUE(gui.says(message));
  editor.session.say(LogLevel::note, std::string(120, 'x'), "An opening is not cut");
  gui.frames(3);
  EXPECT_TRUE(gui.says("An opening is not cut")) << "a long source leaves it two thirds";
  EXPECT_FALSE(gui.says(std::string(120, 'x')));
}

TEST_F(LogPanel, AMessageOfTheLogCallsProductsAsTheEditorDoes) {
  open();
  openPanel(editor, Workspace::environment, "log");
  editor.session.say(LogLevel::note, "", "Met IfcDoor #9 'A'");
  itemProbe().texts.clear();
  itemProbe().listens = true;
  gui.frames(4);
  itemProbe().listens = false;
  const auto& texts = itemProbe().texts;
  EXPECT_NE(std::find(texts.begin(), texts.end(), "Met Door #9 'A'"), texts.end());
}

TEST_F(LogPanel, SaysWhatWasUndoneInALanguageThatIsChosenAfterwards) {
  open();
  openPanel(editor, Workspace::environment, "log");
  ASSERT_TRUE(editor.session.start("target", {{"add", "D"}, {"at", {500004, 5800002, 51.5}}}));
  gui.settle();
  editor.session.undo();
  gui.frames(2);
  EXPECT_TRUE(gui.says("Undone: Added target D"));
  speak("de");
  gui.frames(2);
  EXPECT_TRUE(gui.says("Rückgängig gemacht: Zielmarke D hinzugefügt"));
  speak("en");
}

TEST_F(LogPanel, AMessageThatTheLogHasNoRoomForIsWholeInItsTooltip) {
  std::string text = "Scanned";
  for (int i = 0; i < 60; ++i) text += " word" + std::to_string(i);
  editor.session.say(LogLevel::note, "", text);
  editor.workspace = Workspace::instrument;
  gui.frames(3);
  const ImGuiWindow* panel = nullptr;
  for (const auto* window : ImGui::GetCurrentContext()->Windows)
    if (window->WasActive && std::string(window->Name).find("entries") != std::string::npos) panel = window;
  ASSERT_NE(panel, nullptr);
  gui.moveTo({panel->Pos.x + panel->Size.x - 60, panel->Pos.y + ImGui::GetTextLineHeight()});
  gui.frames(30);
  const auto* tooltip = ImGui::FindWindowByName("##Tooltip_00");
  ASSERT_NE(tooltip, nullptr);
  EXPECT_TRUE(tooltip->WasActive || tooltip->Active);
  EXPECT_GT(tooltip->Size.y, 3 * ImGui::GetTextLineHeight()) << "all of it, in lines";
}

}  // namespace
}  // namespace standpoint

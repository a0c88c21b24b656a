// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/graphics_choice.h"

#include <fmt/format.h>
#include <imgui.h>

#include "editor/shell/editor.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

void chooseGraphics(Editor& editor, GraphicsChoice choice) {
  editor.settings.graphics = choice;
  editor.graphics.choose(choice);
  const auto& means = editor.graphics.means();
  if (choice == GraphicsChoice::automatic)
    editor.say(trf("Graphics: Automatic, now {}", tr(graphicsName(editor.graphics.level()))));
  else if (means && means->by_processor)
    editor.say(trf("Graphics: {}. Without a graphics card, its full effect shows once the view is at rest.",
                   tr(graphicsName(choice))));
  else
    editor.say(trf("Graphics: {}", tr(graphicsName(choice))));
}

void drawGraphicsChoices(Editor& editor, float width_pt) {
  editor.costs_wanted = editor.shown() && editor.graphics.notMeasured();
  for (const auto choice : kGraphicsChoices) {
    if (ui::radioButton(fmt::format("{}###graphics-{}", tr(graphicsName(choice)), graphicsKey(choice)).c_str(),
                        editor.settings.graphics == choice))
      chooseGraphics(editor, choice);
    const float inset = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::Indent(inset);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - editor.px(6));
    const std::string about = editor.graphics.about(choice);
    const auto height = [&](const std::string& text) {
      return ImGui::CalcTextSize(text.c_str(), nullptr, false, editor.px(width_pt) - inset).y;
    };
    // So that nothing moves under the pointer when the costs come in.
    const float left_free = editor.shown() ? height(editor.graphics.aboutMeasured(choice)) - height(about) : 0;
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + editor.px(width_pt) - inset);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(about.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    if (left_free > 0) ImGui::SetCursorPosY(ImGui::GetCursorPosY() + left_free);
    ImGui::Unindent(inset);
  }
}

std::string aboutGraphics(const Editor& editor, std::string_view command) {
  constexpr std::string_view kPrefix = "graphics-";
  if (!command.starts_with(kPrefix)) return {};
  const auto choice = graphicsChoice(command.substr(kPrefix.size()));
  return choice ? editor.graphics.about(*choice) : std::string();
}

}  // namespace standpoint

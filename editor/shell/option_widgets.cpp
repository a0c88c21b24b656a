// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

std::string_view shownUnit(const Parameter& p) { return std::string_view(p.unit) == "deg" ? "°" : p.unit; }

void drawNumber(OptionField& field) {
  const auto& p = *field.parameter;
  const bool whole = p.kind == ParameterKind::integer;
  ui::numberField("###value", field.number,
                  {.kind = {.unit = shownUnit(p), .least = p.minimum, .most = p.maximum, .whole = whole},
                   .step = whole ? 1.0 : 0.0});
}

void drawChoice(OptionField& field) {
  if (!ImGui::BeginCombo("###value", field.text.c_str())) return;
  for (const char* choice : field.parameter->choices)
    if (ImGui::Selectable(choice, field.text == choice)) field.text = choice;
  ImGui::EndCombo();
}

void drawPath(Editor& editor, OptionField& field) {
  const float browse = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(-browse);
  ImGui::InputText("###value", &field.text);
  ImGui::SameLine();
  if (!ui::iconButton(ICON_FOLDER_OPEN "###browse", "Choose…")) return;
  const std::string name = field.parameter->name;
  // The form gives way to the browser and comes back with what was chosen.
  editor.dialogs.verb.open = false;
  const bool written = name == "o" || name == "output";
  const auto purpose = written ? FileDialogState::Purpose::saveFile : FileDialogState::Purpose::openFile;
  askForFile(editor, purpose, readableOption(field.parameter->name), "Choose", {},
             std::filesystem::path(field.text).filename().string(),
             [&editor, name](const std::filesystem::path& chosen) {
               if (auto* again = editor.dialogs.verb.form.find(name.c_str()))
                 again->text = chosen.string(), again->given = true;
               editor.dialogs.verb.open = true;
             });
  editor.dialogs.file.cancelled = [&editor] { editor.dialogs.verb.open = true; };
}

void drawValue(Editor& editor, OptionField& field) {
  switch (field.parameter->kind) {
    case ParameterKind::text: ImGui::InputText("###value", &field.text); break;
    case ParameterKind::number:
    case ParameterKind::integer: drawNumber(field); break;
    case ParameterKind::flag: ui::checkbox("###value", &field.flag); break;
    case ParameterKind::choice: drawChoice(field); break;
    case ParameterKind::path: drawPath(editor, field); break;
    case ParameterKind::triple:
      for (std::size_t i = 0; i < field.triple.size(); ++i) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        ui::numberField(fmt::format("###value{}", i).c_str(), field.triple[i],
                        {.kind = {.unit = shownUnit(*field.parameter)}, .decimals = 3});
      }
      break;
    case ParameterKind::pairs:
    case ParameterKind::list:
      ImGui::InputTextMultiline("###value", &field.text, {-FLT_MIN, ImGui::GetTextLineHeight() * 3.4F});
      ui::tooltip(field.parameter->kind == ParameterKind::pairs ? "key=value, one per line" : "One per line");
      break;
  }
}

}  // namespace

void drawOptionForm(Editor& editor, OptionForm& form) {
  if (!ui::beginProperties("options", 0.34F)) return;
  for (auto& field : form.fields()) {
    const auto& p = *field.parameter;
    ImGui::PushID(p.name);
    ui::propertyLabel(readableOption(p.name).c_str());
    const bool optional = !p.required && p.default_value.is_null() && p.kind != ParameterKind::flag;
    if (optional) {
      ui::checkbox("###given", &field.given);
      ui::tooltip("Unticked: set automatically");
      ImGui::SameLine();
      ImGui::SetNextItemWidth(-FLT_MIN);
    }
    if (p.kind == ParameterKind::flag) field.given = true;
    ImGui::BeginDisabled(!field.given);
    drawValue(editor, field);
    ImGui::EndDisabled();
    if (editor.fonts.small != nullptr) ImGui::PushFont(editor.fonts.small);
    ui::dimWrapped(p.help);
    if (editor.fonts.small != nullptr) ImGui::PopFont();
    ImGui::PopID();
  }
  ui::endProperties();
}

}  // namespace standpoint

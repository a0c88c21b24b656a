// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/inspect/inspected_clouds.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

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

// Units, axes and the names of formats and datasets stay as they are.
std::string readableChoice(const Parameter& parameter, const std::string& choice) {
  const std::string_view of = parameter.name;
  return choice.size() > 2 && of != "format" && of != "dataset" ? tr(readableOption(choice.c_str())) : choice;
}

void drawChoice(OptionField& field) {
  const auto& parameter = *field.parameter;
  if (!ui::beginDropDown("###value", readableChoice(parameter, field.text).c_str())) return;
  for (const char* choice : parameter.choices)
    if (ui::choice((readableChoice(parameter, choice) + "###" + choice).c_str(), field.text == choice))
      field.text = choice;
  ui::endDropDown();
}

void browse(Editor& editor, const OptionField& field) {
  if (!ui::iconButton(ICON_FOLDER_OPEN "###browse", "Choose…")) return;
  const std::string name = field.parameter->name;
  // The form gives way to the browser and comes back with what was chosen.
  editor.dialogs.verb.open = false;
  const bool written = name == "o" || name == "output" || name == "out";
  const auto purpose = written ? FileDialogState::Purpose::saveFile : FileDialogState::Purpose::openFile;
  askForFile(editor, purpose, optionLabel(*field.parameter), "Choose", {},
             std::filesystem::path(field.text).filename().string(),
             [&editor, name](const std::filesystem::path& chosen) {
               if (auto* again = editor.dialogs.verb.form.find(name.c_str())) {
                 const auto* kind = kindOf(again->kinds, again->text);
                 const bool bare = kind != nullptr && !chosen.has_extension();
                 again->text = bare ? chosen.string() + kind->extension : chosen.string();
                 again->given = true;
                 auto* const with = name == "in" ? editor.dialogs.verb.form.find("with") : nullptr;
                 if (with != nullptr) with->given = false;
               }
               editor.dialogs.verb.open = true;
             });
  editor.dialogs.file.cancelled = [&editor] { editor.dialogs.verb.open = true; };
}

void drawPath(Editor& editor, OptionField& field) {
  ImGui::SetNextItemWidth(-(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x));
  ImGui::InputText("###value", &field.text);
  ImGui::SameLine();
  browse(editor, field);
}

// By the file's ending, which follows what is chosen.
void drawFormat(OptionField& field) {
  const auto* kind = kindOf(field.kinds, field.text);
  const auto label = [](const FileKind& k) { return fmt::format("{} ({})", tr(k.label), k.extension); };
  ui::propertyLabel("Format");
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ui::beginDropDown("###format", kind != nullptr ? label(*kind).c_str() : tr("Choose a format").c_str())) return;
  for (const auto& offered : field.kinds)
    if (ui::choice((label(offered) + "###" + offered.extension).c_str(), kind == &offered))
      field.text = withKind(field.kinds, offered, field.text).string();
  ui::endDropDown();
}

struct CloudFile {
  std::filesystem::path file;
  std::string names;  // of the stations whose scans are in it, or of the underlay
};

std::vector<CloudFile> cloudFilesOf(const Document& document) {
  std::vector<CloudFile> files;
  for (const auto& cloud : inspectedClouds(document)) {
    const auto& name =
        cloud.station < 0 ? cloud.label : document.job->stations[static_cast<std::size_t>(cloud.station)].name;
    const auto known = std::find_if(files.begin(), files.end(), [&](const auto& f) { return f.file == cloud.file; });
    if (known == files.end())
      files.push_back({cloud.file, name});
    else if (!known->names.ends_with(name))
      known->names += ", " + name;
  }
  return files;
}

// One of the project's scans and underlays, another file, or the newest scans of all stations where the verb takes more
// than one.
void drawCloudPath(Editor& editor, OptionForm& form, OptionField& field) {
  const auto files = cloudFilesOf(editor.session.document());
  if (files.empty()) return drawPath(editor, field);
  auto* const with = form.find("with");
  const bool all = with != nullptr && with->given;
  std::string shown = std::filesystem::path(field.text).filename().string();
  for (const auto& f : files)
    if (f.file == field.text) shown = f.names + "   " + shown;
  const auto newest = newestOfStations(inspectedClouds(editor.session.document()));
  const auto every = trn("All stations: {} scan", "All stations: {} scans", newest.size(), newest.size());
  ImGui::SetNextItemWidth(-(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x));
  if (ui::beginDropDown("###value", all ? every.c_str() : shown.c_str())) {
    if (with != nullptr && newest.size() > 1 && ui::choice((every + "###all").c_str(), all))
      form.fill(pointsOf(newest));
    for (std::size_t i = 0; i < files.size(); ++i)
      if (ui::choice(fmt::format("{}   {}###{}", files[i].names, files[i].file.filename().string(), i).c_str(),
                     !all && files[i].file == field.text)) {
        field.text = files[i].file.string();
        if (with != nullptr) with->given = false;  // those alone
      }
    ui::endDropDown();
  }
  ui::tooltip(field.text);
  ImGui::SameLine();
  browse(editor, field);
}

// What a professional calls what the label says plainly, and how the command line has it.
std::string termsOf(const Parameter& p) {
  const auto option = p.positional ? std::string() : fmt::format("--{}", p.name);
  if (*p.term == 0) return option;
  return option.empty() ? tr(p.term) : tr(p.term) + "\n" + option;
}

void drawValue(Editor& editor, OptionForm& form, OptionField& field) {
  switch (field.parameter->kind) {
    case ParameterKind::text: ImGui::InputText("###value", &field.text); break;
    case ParameterKind::number:
    case ParameterKind::integer: drawNumber(field); break;
    case ParameterKind::flag: ui::checkbox("###value", &field.flag); break;
    case ParameterKind::choice: drawChoice(field); break;
    case ParameterKind::path:
      std::strcmp(field.parameter->name, "in") == 0 ? drawCloudPath(editor, form, field) : drawPath(editor, field);
      break;
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
    if (!form.offers(field)) continue;
    const auto& p = *field.parameter;
    ImGui::PushID(p.name);
    if (!field.kinds.empty()) drawFormat(field);
    ui::propertyLabel(optionLabel(p).c_str());
    ui::tooltip(termsOf(p));
    const bool optional = !p.required && p.default_value.is_null() && p.kind != ParameterKind::flag;
    if (optional) {
      ui::checkbox("###given", &field.given);
      ui::tooltip("Unticked: set automatically");
      ImGui::SameLine();
      ImGui::SetNextItemWidth(-FLT_MIN);
    }
    if (p.kind == ParameterKind::flag) field.given = true;
    ImGui::BeginDisabled(!field.given);
    drawValue(editor, form, field);
    ImGui::EndDisabled();
    if (editor.fonts.small != nullptr) ImGui::PushFont(editor.fonts.small);
    const auto* kind = kindOf(field.kinds, field.text);
    if (kind != nullptr)
      ui::dimWrapped(kind->note);
    else
      ui::dimWrapped(shownSentence(p.help));
    if (editor.fonts.small != nullptr) ImGui::PopFont();
    ImGui::PopID();
  }
  ui::endProperties();
}

}  // namespace standpoint

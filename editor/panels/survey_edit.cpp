// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/survey_edit.h"

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

// Of the newest scan with the way to make it anew.
void drawAge(const Model& model, Actions& actions, const std::string& age, bool newest) {
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kWarning);
  ui::wrapped(std::string(ICON_WARNING "  ") + trf("Scan is {}", trSentence(age)));
  ImGui::PopStyleColor();
  if (newest && ui::button(ICON_PLAY "  Scan again…###scan-again", model.session.whyNot("scan"), {-FLT_MIN, 0}))
    actions.run("scan");
}

}  // namespace

void takeRefusal(SurveyEdit& edit, Actions& actions) {
  if (edit.asked.empty()) return;
  if (auto why = actions.refused(edit.asked); !why.empty()) edit.problem = std::move(why), edit.asked.clear();
}

bool begins(SurveyEdit& edit, const void* of, Actions& actions) {
  takeRefusal(edit, actions);
  if (edit.of == of) return false;
  edit = {.of = of};
  return true;
}

void startEdit(Actions& actions, SurveyEdit& edit, const VerbOptions& options, std::string title) {
  edit.problem.clear();
  edit.asked = title;
  actions.start(options, std::move(title));
}

bool nameRow(const Model& model, Actions& actions, SurveyEdit& edit) {
  ui::propertyLabel("Name");
  if (model.rename_wanted) {
    ui::focusNext();
    actions.renameBegun();
  }
  return ui::textField("###inspected-name", edit.name);
}

bool placeRows(SurveyEdit& edit, const char* id, bool focus_first) {
  static constexpr const char* kAxes[] = {"X", "Y", "Z"};
  bool changed = false;
  edit.refused = false;
  for (Eigen::Index i = 0; i < 3; ++i) {
    ui::propertyLabel(kAxes[i]);
    if (focus_first && i == 0) ui::focusNext();
    const auto field = fmt::format("{}-{}", id, kAxes[i]);
    changed = ui::numberField(field.c_str(), edit.at[i], {.kind = {.unit = "m"}, .decimals = 3}) || changed;
    edit.refused = ui::isNumberRefused(field.c_str()) || edit.refused;
  }
  return changed;
}

namespace {

// What a remedy says for the command line alone: " (--on 8,3,1.6)".
std::string withoutOptions(std::string text) {
  for (auto begin = text.find(" (--"); begin != std::string::npos; begin = text.find(" (--")) {
    const auto end = text.find(')', begin);
    text.erase(begin, end == std::string::npos ? end : end + 1 - begin);
  }
  return text;
}

}  // namespace

void drawProblem(SurveyEdit& edit) {
  if (edit.problem.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
  ui::wrapped(withoutOptions(shownSentence(edit.problem)));
  ImGui::PopStyleColor();
  if (ui::button("Revert###revert-inspected")) edit = {};
}

void bringNear(Actions& actions, const Eigen::Vector3d& place) {
  Bounds around;
  around.extend(place - Eigen::Vector3d(3, 3, 2));
  around.extend(place + Eigen::Vector3d(3, 3, 2));
  actions.bringIntoView(around);
}

float columnWidth(int columns) {
  return (ImGui::GetContentRegionAvail().x - static_cast<float>(columns - 1) * ImGui::GetStyle().ItemSpacing.x) /
         static_cast<float>(columns);
}

bool smallButton(const char* icon, const char* text, const char* id, float width, const std::string& why,
                 const char* help) {
  return ui::button(ui::fittingLabel(icon, text, id, width).c_str(), why, {width, 0}, help);
}

void drawLocate(const Model& model, Actions& actions, const std::filesystem::path& missing) {
  if (ui::button(ICON_SEARCH "  Locate…###locate", model.session.whyNot("locate"), {-FLT_MIN, 0},
                 "Choose where the file is now"))
    actions.locate(missing);
}

void drawScans(const Model& model, Actions& actions, const std::vector<Scan>& scans,
               const std::function<std::string(const Scan&)>& age_of) {
  if (scans.empty()) return;
  ui::heading(model, trf("Scans  {}", scans.size()).c_str());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto& scan = scans[i];
    const std::filesystem::path file = scan.file;
    ImGui::PushID(static_cast<int>(i));
    const bool open =
        ImGui::TreeNodeEx("###scan", ImGuiTreeNodeFlags_SpanAvailWidth, "%s   %s", file.filename().string().c_str(),
                          trf("{} points", groupedDigits(scan.points)).c_str());
    if (const auto age = age_of(scan); !age.empty()) drawAge(model, actions, age, i + 1 == scans.size());
    if (open) {
      if (ui::beginProperties("scan", 0.36F)) {
        ui::property("Instrument", scan.instrument);
        for (const auto& [key, value] : scan.settings) ui::property(key, value);
        ui::property("Points", groupedDigits(scan.points));
        ui::property("Pulses", groupedDigits(scan.pulses));
        ui::property("Instrument time", durationText(scan.instrument_seconds));
        ui::property("Noise seed", std::to_string(scan.seed));
        ui::property("File", scan.file);
        ui::endProperties();
      }
      std::error_code ignored;
      const bool there = std::filesystem::is_regular_file(file, ignored);
      if (ui::button(ICON_EYE "  Show points###show-scan",
                     there ? std::string() : trf("The file is missing: {}", scan.file), {-FLT_MIN, 0}))
        actions.showScans({file});
      if (!there) drawLocate(model, actions, file);
      ImGui::TreePop();
    }
    ImGui::PopID();
  }
}

}  // namespace standpoint

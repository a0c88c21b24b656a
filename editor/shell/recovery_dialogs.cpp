// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/recovery_dialogs.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include <imgui.h>

#include "editor/panels/quality_panel.h"
#include "editor/recovery/differences.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/panel_actions.h"
#include "editor/widgets/modal.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/fields.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

// As the job was started, but with what it had finished.
Result<ScanVerbOptions> resumed(const Session& session, const LeftJob& job) {
  TRY_ASSIGN(const auto checked, checkOptions(*session.verb("scan"), job.options));
  TRY_ASSIGN(auto options, optionsFrom(scanFields(), checked));
  options.resume = true;
  return options;
}

// "" when what was left can be opened.
std::string whyNotOpen(const Editor& editor, const LeftWork& left) {
  if (left.project.empty() && left.mark.saved_in.empty()) return "The project was never saved, and nothing was kept";
  return editor.session.whyNot("open-project");
}

void beginComparison(Editor& editor, const LeftWork& left) {
  auto work = [project = std::filesystem::path(left.mark.saved_in), copy = left.project](Progress& progress) {
    return differencesOf(project, copy, progress);
  };
  editor.dialogs.comparison = {
      left.folder, std::make_unique<Task<std::vector<std::string>>>("Compare", std::move(work), editor.wake)};
}

void drawComparison(Editor& editor, const LeftWork& left) {
  const auto& comparison = editor.dialogs.comparison;
  if (!comparison.task || comparison.folder != left.folder) return;
  ui::gap(editor, 6);
  if (!comparison.task->done()) return ui::dimText("Comparing the copy with the project …");
  const auto& lines = comparison.task->result();
  if (!lines) return ui::wrapped(trf("They cannot be compared: {}", trError(lines.error())));
  if (lines->empty()) return ui::wrapped("The copy and the project hold the same.");
  const float row = ImGui::GetTextLineHeightWithSpacing();
  constexpr float kMostRows = 10;
  ImGui::BeginChild("differences", {0, row * std::min(static_cast<float>(lines->size()) + 0.5F, kMostRows)});
  for (const auto& line : *lines) ui::wrapped(line);
  ImGui::EndChild();
}

}  // namespace

void drawBareStart(Editor& editor) {
  if (!ui::beginModal(editor, "Started without your settings###bare-start", editor.dialogs.bare, 520)) return;
  ui::wrapped(
      "The editor closed unexpectedly twice within a minute of starting. It has now started with default "
      "preferences and low graphics, and has opened nothing.");
  ui::gap(editor, 2);
  ui::wrapped("Unsaved work is kept: File › Recover unsaved work.");
  ui::gap(editor, 6);
  if (ui::primaryButton("Continue###continue", {}, {editor.px(110), 0}) || ui::modalCancelled(true)) {
    editor.dialogs.bare = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button(ui::Label("Start as usual###as-usual"), {editor.px(130), 0})) {
    editor.dialogs.bare = false;
    ImGui::CloseCurrentPopup();
    if (const auto start = std::exchange(editor.dialogs.start_as_usual, nullptr)) start();
  }
  ImGui::EndPopup();
}

void drawRecovery(Editor& editor) {
  auto& found = editor.dialogs.recovery;
  if (!ui::beginModal(editor, "Recover unsaved work###recovery", !found.empty(), 640)) return;
  const LeftWork left = found.front();
  const LeftJob* scan = leftScan(left);
  for (const auto& sentence : sentencesOf(left)) ui::wrapped(sentence);
  if (!left.mark.saved_in.empty()) ui::dimWrapped(trf("Saved in {}", left.mark.saved_in));
  const bool copy = !left.project.empty();
  if (copy) ui::dimWrapped("The steps of undo and redo are not part of a copy: the history begins anew.");
  drawComparison(editor, left);
  ui::gap(editor, 6);
  const auto why = whyNotOpen(editor, left);
  const auto close = [&] {
    found.erase(found.begin());
    editor.dialogs.deletes.clear();
    editor.dialogs.comparison = {};
    ImGui::CloseCurrentPopup();
  };
  const auto open = [&](bool resume) {
    if (resume) editor.dialogs.resume = *scan;
    editor.dialogs.shown_before = left.mark.shown;
    editor.session.recover(left);
    if (!copy) removeRecovery(left.folder);  // the project itself has all there is
    close();
  };
  const char* const opens = copy ? "Open the copy###open" : "Open project###open";
  bool done = false;
  if (scan != nullptr) {
    if ((done = ui::primaryButton("Open and resume scan###resume", why, {editor.px(180), 0}))) open(true);
    ImGui::SameLine();
  }
  if (!done) {
    done = scan != nullptr ? ui::button(opens, why, {editor.px(120), 0})
                           : ui::primaryButton(opens, why, {editor.px(120), 0});
    if (done) open(false);
  }
  if (!done && copy && !left.mark.saved_in.empty()) {
    ImGui::SameLine();
    if (ui::button("Compare###compare", {}, {editor.px(90), 0}, "What differs between the copy and the project"))
      beginComparison(editor, left);
  }
  if (ImGui::SameLine(),
      !done && (ImGui::Button(ui::Label("Later###later"), {editor.px(80), 0}) || ui::modalCancelled(true))) {
    done = true;
    close();
  }
  auto& confirmed = editor.dialogs.deletes;  // a press that another dialog was meant to get deletes nothing
  const bool asked = confirmed == left.folder;
  const char* const deletes = asked  ? "Press again to delete###delete"
                              : copy ? "Delete the copy###delete"
                                     : "Forget it###delete";
  if (ImGui::SameLine(), !done && ImGui::Button(ui::Label(deletes))) {
    confirmed = left.folder;
    if (asked || !copy) {
      removeRecovery(left.folder);
      close();
    }
  }
  ImGui::EndPopup();
}

namespace {

// Switches of the view that are kept, by the beginnings of their actions' ids.
bool isKept(std::string_view action) { return action.starts_with("colour-") || action.starts_with("points-by-"); }

nlohmann::json howShown(Editor& editor) {
  auto on = nlohmann::json::array();
  for (const auto& action : actions())
    if (isKept(action.id) && action.on != nullptr && action.on(editor)) on.push_back(action.id);
  nlohmann::json shown = {{"on", std::move(on)}};
  // Also while it is made, which takes minutes, and of a project that has changed since.
  const auto& running = editor.session.running();
  const bool assesses = std::any_of(running.begin(), running.end(),
                                    [](const auto& task) { return std::string_view(task->verb().name) == "assess"; });
  if (!assesses && editor.session.lastOf("assess") == nullptr) return shown;
  for (const auto& choice : choices(QualityProfile{}))
    if (choice.value == editor.panels.of<QualityState>().profile) shown["assessed"] = choice.name;
  return shown;
}

void assessAsBefore(Editor& editor, const std::string& profile) {
  auto& state = editor.panels.of<QualityState>();
  for (const auto& choice : choices(QualityProfile{}))
    if (profile == choice.name) state.profile = choice.value;
  PanelActions actions(editor);
  if (whyNotAssess(editor).empty()) assess(state, actions);
}

}  // namespace

void keepHowShown(Editor& editor) {
  if (!editor.session.shown_as) editor.session.shown_as = [&editor] { return howShown(editor); };
}

void showAsBefore(Editor& editor) {
  auto& wanted = editor.dialogs.shown_before;
  if (wanted.empty() || !editor.session.running().empty() || editor.dialogs.resume) return;
  const auto shown = std::exchange(wanted, nullptr);
  if (!editor.environment()) return;  // it could not be opened
  if (const auto on = shown.find("on"); on != shown.end() && on->is_array())
    for (const auto& id : *on)
      if (id.is_string() && isKept(id.get_ref<const std::string&>()) && findAction(id.get<std::string>().c_str()))
        invoke(editor, id.get<std::string>().c_str());
  if (const auto assessed = shown.find("assessed"); assessed != shown.end() && assessed->is_string())
    assessAsBefore(editor, assessed->get<std::string>());
}

void resumeLeftScan(Editor& editor) {
  auto& job = editor.dialogs.resume;
  if (!job || !editor.session.errors().empty() || !editor.session.running().empty()) {
    if (job && !editor.session.errors().empty()) job.reset();  // it could not be opened
    return;
  }
  const auto wanted = *std::exchange(job, std::nullopt);
  const auto options = resumed(editor.session, wanted);
  if (!options)
    editor.session.errors().push_back({"The scan cannot be resumed", options.error()});
  else if (const auto why = editor.session.whyNot("scan"); !why.empty())
    editor.session.errors().push_back({"The scan cannot be resumed", {ErrorKind::usage, why, wanted.title}});
  else
    editor.startScan(*options, trSentence(wanted.title));
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>
#include <utility>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/instrument/desk.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "emulated-ui/hand_over.h"
#include "emulated-ui/rehearsal/office_cleaning.h"
#include "pointclouds/filters/point_filter.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

fs::path officeOf(const InstrumentDesk& desk) { return officeBeside(desk.rehearsal->folder() / "scans"); }

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::string whyNotClean(const InstrumentDesk& desk) {
  if (desk.rehearsal->host().busy()) return "The instrument is busy. Wait until it has finished.";
  if (wordsOf(desk.filters).empty()) return "Enter a filter.";
  return officeCopies(std::as_const(*desk.rehearsal).device(), officeOf(desk)).empty()
             ? "Copy a scan to the office first."
             : "";
}

}  // namespace

void startCleaning(InstrumentDesk& desk, Editor& editor, const std::vector<std::string>& filters) {
  const auto office = officeOf(desk);
  desk.said.clear();
  desk.cleaning_action = {RehearsalAction::Kind::verb, "clean", "", 0, {{"filters", filters}}};
  desk.cleaning = std::make_unique<Task<fs::path>>(
      tr("Clean the copies"),
      [copies = officeCopies(std::as_const(*desk.rehearsal).device(), office), filters,
       office](Progress& progress) -> Result<fs::path> {
        TRY(cleanCopies(copies, filters, office, progress));
        return cleanedIn(office);
      },
      editor.wake);
}

bool asksForCleaning(const Exercise& exercise) {
  return std::any_of(exercise.rules.begin(), exercise.rules.end(), [](const ExerciseRule& rule) {
    const auto facts = rule.holds.facts();
    return std::any_of(facts.begin(), facts.end(), isCleaningFact);
  });
}

void takeCleaning(InstrumentDesk& desk) {
  if (!desk.cleaning || !desk.cleaning->done()) return;
  const auto cleaned = std::exchange(desk.cleaning, nullptr)->take();
  if (cleaned)
    desk.rehearsal->did(desk.cleaning_action, desk.rehearsal->document().job);
  else if (cleaned.error().kind != ErrorKind::cancelled)
    desk.said = trSentence(cleaned.error().message);
}

void drawCleaning(InstrumentDesk& desk, Editor& editor) {
  ui::gap(editor);
  ui::dimText("Cleaning in the office");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("###filters", "name:option=value", &desk.filters);
  ui::tooltip(trf("Filters in this order, separated by spaces: {}", filterList()));
  if (desk.cleaning) {
    if (ui::button("Cancel###cancel-cleaning")) desk.cleaning->progress().cancel();
    ImGui::SameLine();
    ImGui::ProgressBar(static_cast<float>(desk.cleaning->progress().fraction()));
    return;
  }
  if (ui::primaryButton("Clean the copies###clean", whyNotClean(desk)))
    startCleaning(desk, editor, wordsOf(desk.filters));
  std::error_code error;
  if (const auto cleaned = cleanedIn(officeOf(desk)); fs::exists(cleaned, error)) {
    ImGui::SameLine();
    if (ui::button("Show the cleaned cloud###show-cleaned")) editor.showClouds({cleaned});
  }
}

}  // namespace standpoint

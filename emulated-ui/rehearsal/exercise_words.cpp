// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/exercise_words.h"

#include <set>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "emulated-ui/device/words.h"

namespace standpoint {

Result<ExerciseWords> ExerciseWords::read(const std::filesystem::path& folder) {
  ExerciseWords words;
  for (const auto& file : languageFiles(folder, "exercises")) TRY(words.take(file));
  return words;
}

Result<void> ExerciseWords::take(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  root.skip("about");
  auto& texts = texts_[root.text("language", "pl")];
  root.each("exercises", [&](const std::string& english, const nlohmann::json& text, const std::string& at) {
    if (!texts.emplace(english, textAt(fault, text, at)).second) fault.say(at, "already defined in another file");
  });
  root.close();
  return fault.result();
}

void ExerciseWords::addTo(Exercise& exercise) const {
  eachText(exercise, [this](Spoken& spoken, const std::string&) {
    const auto english = spoken.in("en");
    for (const auto& [language, texts] : texts_)
      if (const auto text = texts.find(english); text != texts.end()) spoken.texts.emplace(language, text->second);
  });
}

Report ExerciseWords::check(const std::vector<KnownExercise>& exercises) const {
  Report report;
  std::set<std::string> said;
  for (auto [exercise, file] : exercises)
    eachText(exercise, [&, &file = file](const Spoken& spoken, const std::string& place) {
      if (spoken.texts.empty()) return;
      said.insert(spoken.in("en"));
      for (const auto& [language, texts] : texts_)
        if (!spoken.texts.contains(language))
          report.lose(fmt::format("{} {}", nameWithFolder(file), place),
                      fmt::format("no text in '{}' for '{}'", language, spoken.in("en")));
    });
  for (const auto& [language, texts] : texts_)
    for (const auto& [english, text] : texts)
      if (!said.contains(english))
        report.lose(fmt::format("exercises ({})", language), fmt::format("no exercise says '{}'", english));
  return report;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/exercise_words.h"

#include <set>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "emulated-ui/device/words.h"
#include "emulated-ui/menus.h"

namespace standpoint {

namespace {

const std::string& keyOf(const Spoken& spoken) { return spoken.english.empty() ? spoken.in("en") : spoken.english; }

}  // namespace

Result<ExerciseWords> ExerciseWords::read(const std::filesystem::path& folder) {
  ExerciseWords words;
  for (const auto& file : languageFiles(folder, "exercises")) TRY(words.take(file));
  return words;
}

const Result<ExerciseWords>& ExerciseWords::shipped() {
  static const auto kShipped = read(wordsFolder());
  return kShipped;
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
  eachText(exercise, [&](Spoken& spoken, const std::string&) {
    for (const auto& [language, texts] : texts_)
      if (const auto text = texts.find(keyOf(spoken)); text != texts.end())
        if (auto filled = withFigures(text->second, exercise.figures, exercise.file); filled && filled->is_string())
          spoken.texts.emplace(language, std::move(*filled));
  });
}

Report ExerciseWords::check(const std::vector<KnownExercise>& exercises) const {
  Report report;
  std::set<std::string> said;
  for (auto [exercise, file] : exercises)
    eachText(exercise, [&, &file = file](const Spoken& spoken, const std::string& place) {
      if (spoken.texts.empty()) return;
      said.insert(keyOf(spoken));
      for (const auto& [language, texts] : texts_)
        if (!spoken.texts.contains(language))
          report.lose(fmt::format("{} {}", nameWithFolder(file), place),
                      fmt::format("no text in '{}' for '{}'", language, keyOf(spoken)));
    });
  for (const auto& [language, texts] : texts_)
    for (const auto& [english, text] : texts) {
      const auto place = fmt::format("exercises ({})", language);
      if (!said.contains(english)) report.lose(place, fmt::format("no exercise says '{}'", english));
      if (figuresIn(text) != figuresIn(english))
        report.lose(place, fmt::format("'{}' names other figures than '{}'", text, english));
    }
  return report;
}

}  // namespace standpoint

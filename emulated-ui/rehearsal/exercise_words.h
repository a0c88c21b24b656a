// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/result.h"
#include "emulated-ui/rehearsal/exercise.h"

namespace standpoint {

// Texts of exercises in languages that their own files lack, by the English text, so that what several exercises say is
// said once. exercises.json in the folder of a language is
//   {"language": "pl", "exercises": {"Answer the question.": "Odpowiedz na pytanie."}}
// An English text with places of figures, "Scan at ${resolution}.", is written with them, and so is its translation.
class ExerciseWords {
 public:
  static Result<ExerciseWords> read(const std::filesystem::path& folder);  // of the folders of the languages
  static const Result<ExerciseWords>& shipped();                           // of the program's own; read once

  // What the exercise's own file says stays.
  void addTo(Exercise& exercise) const;
  // What these exercises, to which they were added, lack in a language, and what none of them says any more.
  Report check(const std::vector<KnownExercise>& exercises) const;

 private:
  Result<void> take(const std::filesystem::path& file);

  std::map<std::string, std::map<std::string, std::string>> texts_;  // language: English: text
};

}  // namespace standpoint

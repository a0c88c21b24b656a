// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "core/result.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "project/document.h"

namespace standpoint {

// Something that a recorded exercise may ask: to be ticked or left out.
struct RecordedDemand {
  bool is_rule = false;
  std::string text;  // in the language of the device
  nlohmann::json row;
  bool wanted = true;
};

// What somebody does on a device, to become an exercise: with the stations and targets that stood there at the
// beginning, where the instrument stood, and how long was waited in between.
class Recording {
 public:
  // `exercise`: the one that runs, whose environment and start the recorded one gets; null on the open project.
  Recording(const Device& device, const Document& document, const Exercise* exercise);
  // After each action that was done.
  void note(const RehearsalAction& action, const Device& device);
  const std::vector<RehearsalAction>& actions() const { return actions_; }
  const std::filesystem::path& modelFile() const { return model_file_; }  // empty: a sample

 private:
  friend nlohmann::json recordedExercise(const Recording& recording, const Device& device,
                                         const std::vector<RecordedDemand>& demands, const std::string& id);
  std::vector<RehearsalAction> actions_;
  nlohmann::json setup_ = nlohmann::json::array(), start_ = nlohmann::json::array();
  std::string model_ = "house";       // a sample, or the name of
  std::filesystem::path model_file_;  // a file that is to lie beside the exercise
  double clock_s_ = 0;                // of the device, after the action before
  bool was_busy_ = false;             // then
};

// What was reached on the device: steps for settings, scans with what they were made with, previews, copies, accepted
// set-ups and links; rules that the recorded work holds to.
std::vector<RecordedDemand> demandsOf(const Recording& recording, const Device& device);

// Texts in the device's languages, all of them English where nothing better is known: to be edited.
nlohmann::json recordedExercise(const Recording& recording, const Device& device,
                                const std::vector<RecordedDemand>& demands, const std::string& id);
// Checks it and carries its own solution out; `file` is there afterwards only if all its steps and rules are reached by
// it, else the error says which are not. `model` is copied beside it; empty: a sample.
Result<void> writeRecorded(const nlohmann::json& exercise, const std::filesystem::path& model,
                           const std::filesystem::path& file, Progress& progress);

}  // namespace standpoint

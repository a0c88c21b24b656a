// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/verbs.h"

#include <fmt/format.h>

#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/marks.h"

namespace standpoint {

namespace {

using nlohmann::json;
using K = ParameterKind;

json listOf(const std::vector<KnownExercise>& known, const std::string& language) {
  json rows = json::array();
  for (const auto& one : known)
    rows.push_back({{"id", one.exercise.id}, {"title", one.exercise.title.in(language)}, {"devices", one.exercise.devices}, {"file", one.file.string()}});
  return rows;
}

Result<Outcome> listExercises(const Document& document, const std::string& language) {
  const auto known = knownExercises();
  if (!known) return failure(known.error());
  Outcome outcome{document, {{"exercises", listOf(*known, language)}}, {}, {}, {}};
  outcome.description = fmt::format("{} exercises", known->size());
  for (const auto& one : *known)
    outcome.text += fmt::format("{:6} {}  ({})\n", one.exercise.id, one.exercise.title.in(language), fmt::join(one.exercise.devices, ", "));
  return outcome;
}

Result<Outcome> runRehearse(const Document& document, const json& options, Progress& progress) {
  const auto language = options.at("language").get<std::string>();
  if (!options.contains("exercise")) return listExercises(document, language);
  auto known = findExercise(options["exercise"].get<std::string>());
  if (!known) return failure(known.error());
  if (const auto faults = checkExercise(known->exercise); !faults.empty()) return failure(faults.front());
  std::vector<RehearsalAction> actions;
  const bool solution = options.value("solution", false);
  if (solution == options.contains("actions"))
    return failure(ErrorKind::usage, "say what is done: --actions FILE, or --solution for the exercise's own", "--actions");
  if (solution) {
    actions = known->exercise.solution;
  } else {
    auto read = readActions(options["actions"].get<std::string>());
    if (!read) return failure(read.error());
    actions = *std::move(read);
  }
  const std::filesystem::path folder = options.at("output").get<std::string>();
  auto rehearsal = Rehearsal::start(known->exercise, options.value("device", std::string()), folder, {}, progress);
  if (!rehearsal) return failure(rehearsal.error());
  Outcome outcome{document, json::object(), {}, {}, {}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto done = (*rehearsal)->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      outcome.report.warn(fmt::format("action {}", i), describe(done.error()));   // the device refused; the student goes on
    }
  outcome.answer = marksOf(**rehearsal, options.value("student", std::string()), language);
  if (auto written = writeMarks(**rehearsal, outcome.answer, folder); !written) return failure(written.error());
  outcome.text = marksText(outcome.answer);
  outcome.description = fmt::format("Rehearsed {}: {}", known->exercise.id, outcome.answer["passed"].get<bool>() ? "passed" : "not passed");
  return outcome;
}

const std::vector<Verb>& table() {
  static const std::vector<Verb> verbs = {
      {"rehearse", "Carries out an exercise on an emulated instrument from a list of actions, and marks it; without one it lists them", VerbScope::files,
       {{.name = "exercise", .kind = K::text, .help = "its file, or its id such as E03", .positional = true},
        {.name = "actions", .kind = K::path, .help = "what is done, as a list of actions; a result that was exported replays"},
        {.name = "solution", .kind = K::flag, .help = "does what the exercise itself gives as a way to do it"},
        {.name = "device", .kind = K::text, .help = "id of the device, where the exercise is for several"},
        {.name = "student", .kind = K::text, .help = "name on the certificate"},
        {.name = "language", .kind = K::text, .help = "of the texts", .standard = "en"},
        {.name = "output", .kind = K::path, .help = "folder for the scans and the result (JSON, CSV, HTML)", .standard = "rehearsal"}},
       runRehearse},
  };
  return verbs;
}

}  // namespace

std::span<const Verb> rehearsalVerbs() { return table(); }

std::span<const Verb> allVerbs() {
  static const std::vector<Verb> all = [] {
    std::vector<Verb> both(verbs().begin(), verbs().end());
    both.insert(both.end(), table().begin(), table().end());
    return both;
  }();
  return all;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/device/screen.h"
#include "emulated-ui/rehearsal/variants.h"

namespace standpoint {

// A text in several languages, by language; English where one is missing.
class Spoken {
 public:
  std::map<std::string, std::string> texts;
  std::string english;  // before the figures of a variant were filled in: "Scan at ${resolution}."
  const std::string& in(const std::string& language) const;
};

// What a student, or the lecturer in the student's place, does. Written as one object of a list:
//   {"press": "resolution", "value": "6mm"}   a widget of the screen, a key, or a dialogue's button
//   {"press": "plan", "value": "1,0", "by": "join"}   another gesture than a tap: hold, join, part, lay
//   {"hand": "level"}                         what hands do, see handRows()
//   {"wait": 30}                              seconds of the device's clock
//   {"finish": true}                          until the device and the simulation behind it rest
//   {"verb": "target", "options": {…}}        station, target or plan, on the environment
//   {"verb": "clean", "options": {"filters": […]}}   the copies in the office: office_cleaning.h
//   {"answer": "usable", "value": "yes"}      to a question of the exercise
//   {"walk": [[x, y, seconds], …]}            the way of a handheld scanner, planned on the plan
//   {"hint": "step id"}                       asks for a hint
struct RehearsalAction {
  enum class Kind { press, hand, wait, finish, verb, answer, hint, walk } kind = Kind::press;
  std::string name, value;
  double seconds = 0;
  nlohmann::json options;
  Gesture by = Gesture::tap;  // of a press
};
// Whether a student may do it in an exercise: station, target, plan.
bool isFieldVerb(std::string_view verb);
bool isOfficeVerb(std::string_view verb);  // clean

Result<RehearsalAction> actionFrom(const nlohmann::json& json, const std::string& file, const std::string& pointer);
nlohmann::json toJson(const RehearsalAction& action);
Result<std::vector<RehearsalAction>> readActions(const std::filesystem::path& file);

// Something that befalls the student once a condition holds.
struct ExerciseEvent {
  Condition when;
  std::string trouble;
};

// Done when its condition has held once, after the steps before it where the exercise keeps order.
struct ExerciseStep {
  std::string id;
  Spoken text, hint;
  std::string widget;  // that the hint points to
  Condition done;
  double points = 0;
};

// A demand on how it is done. When it is asked:
//   end     when the exercise ends
//   once    it must have held at some time
//   always  it must hold all the time
//   each    whenever `event` is logged: "each scan_started"
struct ExerciseRule {
  std::string id;
  Spoken text;
  std::string when;   // "end", "once", "always", "each"
  std::string event;  // of each
  Condition holds;
  double points = 0;
  bool must = false;     // without it the exercise is not passed
  std::string mistake;   // of the reference's list: "M08"
  Spoken because;        // what the mistake does to the data
  Spoken cost;           // what it costs in the field and in the office
  std::string proof;     // fact that shows it in the points
  std::string shown_at;  // part, place or target where they show it; empty: by its facts; kNowhere: nothing shows it
};

inline constexpr const char* kNowhere = "nowhere";

struct AnswerNumber {
  double minimum = 0, maximum = 0;
  std::string unit;  // beside it
};
struct ExerciseQuestion {
  std::string id;
  Spoken text;
  std::vector<std::string> choices;
  std::vector<Spoken> choice_texts;
  std::optional<AnswerNumber> number;  // is typed: then there are no choices
};
const ExerciseQuestion* findQuestion(const std::vector<ExerciseQuestion>& questions, std::string_view id);
// Nothing where it is an answer to the question.
std::optional<std::string> wrongAnswer(const ExerciseQuestion& question, const std::string& value);

// A part of the environment that facts part.NAME.* are of; what is left out is anything.
struct ExercisePart {
  std::string product;      // name, GlobalId or id
  std::vector<double> box;  // x, y, z of its least and of its greatest corner
  std::string floor;        // of the storey of that name: its slabs from above
};

// What its author expects of its own solution; nothing stated: that it is passed.
struct ExpectedOutcome {
  bool passed = true;
  std::optional<double> score;      // share of the points
  std::vector<std::string> broken;  // ids of the rules that it does not hold to, such as one of a bad example
};

// What must not pass: a mistake that students often make, as a list of actions. Checked for each variant.
struct KnownMistake {
  std::string id;  // "M03"
  std::vector<RehearsalAction> actions;
};

struct Exercise {
  std::string file;              // name, for messages
  std::filesystem::path folder;  // that the file is in
  std::string hash;              // of its content without solution and mistakes: see exerciseHash
  Figures figures;               // that its places "${...}" were filled with
  std::string id;
  bool tutorial = false;  // it is listed before the others
  Spoken title, goal;
  std::string source;                // what it is based on
  std::vector<std::string> devices;  // ids; the first is the standard
  std::string instrument;            // of the device; empty: its first
  std::string model;                 // of the samples: "house"; else a file beside the exercise: "hut.ifc"
  std::vector<double> area;  // x, y, z of its least and of its greatest corner: what survey.* asks of; empty: all
  std::map<std::string, std::vector<double>> places;   // x, y of what place.NAME asks of
  std::map<std::string, ExercisePart> parts;           // what part.NAME.* asks of
  std::vector<nlohmann::json> setup;                   // verbs that prepare the environment: station, mover
  std::vector<RehearsalAction> start;                  // done by nobody: how the device is found
  std::map<std::string, std::vector<double>> control;  // x, y, z of known places, by the names of targets
  std::optional<double> battery;                       // share, from the start; nothing: full
  std::optional<double> card_free_gb;                  // 1e9 bytes, from the start; nothing: an empty card
  std::vector<std::string> troubles;                   // that are there from the start
  std::vector<ExerciseEvent> events;
  bool in_order = true;
  std::vector<ExerciseStep> steps;
  std::vector<ExerciseRule> rules;
  std::vector<ExerciseQuestion> questions;
  double time_limit_s = 0;                // of the device's clock; 0 = none
  double pass_mark = 0.7;                 // share of the points
  std::vector<RehearsalAction> solution;  // one way to do it: to be watched, and it is tested
  ExpectedOutcome expect;                 // of the solution
  std::vector<KnownMistake> mistakes;
};
// Of its environment; a file that is not there is an error, with its place in the exercise.
Result<std::filesystem::path> modelOf(const Exercise& exercise);

// Every text of it that is said, with its place in the file: "/steps/2/hint".
void eachText(Exercise& exercise, const std::function<void(Spoken& text, const std::string& place)>& visit);

// Whether it can be done on the device; "*" stands for all.
bool isFor(const Exercise& exercise, const std::string& device);

// One with variants is read with the figures that are given, and with its standard ones for the others.
Result<Exercise> readExercise(const std::filesystem::path& file);
Result<Exercise> exerciseFrom(const nlohmann::json& json, const std::filesystem::path& file, Figures figures = {});
// Without what students must not see: solution and mistakes.
nlohmann::json withoutSolution(nlohmann::json exercise);
// Two exercises of the same hash ask and mark the same; 64 hexadecimal digits.
std::string exerciseHash(const nlohmann::json& exercise);
// Everything that is wrong with it beyond its form, each with file and JSON pointer: unknown devices, widgets, facts,
// events, stations, hands, troubles, samples, options that a verb does not take, conditions that can never hold, texts
// without a translation. Nothing is carried out for it.
std::vector<Error> checkExercise(const Exercise& exercise);
// Brings it to its start on each of its devices, as for a student. What cannot be prepared is an error, and so is a
// step that is done before the student comes; a later step that holds already is a warning in `report`.
Result<void> checkStart(const Exercise& exercise, Report& report, Progress& progress);
// Carries its solution out on each device that it names. An outcome other than what its author expects is an error that
// says which steps and rules it is about; that there is no solution is a warning.
Result<void> checkSolution(const Exercise& exercise, Report& report, Progress& progress);

struct KnownExercise {
  Exercise exercise;
  std::filesystem::path file;
};
struct KnownExercises {
  std::vector<KnownExercise> readable;  // each id once; the tutorials stand before all others
  std::vector<Error> refused;           // files that are none, or whose id another one has
};
// The shipped ones and those of the user's folder (STANDPOINT_EXERCISES, else XDG_CONFIG_HOME/standpoint/exercises), by
// file within each; with what ExerciseWords have for their texts.
KnownExercises knownExercises();
KnownExercises shippedExercises();  // without the user's own
std::filesystem::path ownExercisesFolder();
// Another number once a file of the user's folder is new, gone or written anew.
std::uint64_t ownExercisesStamp();
// A file, or the id of a known one.
Result<KnownExercise> findExercise(const std::string& name);

}  // namespace standpoint

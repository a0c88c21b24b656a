// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/verbs/rehearse_verb.h"
#include "project/verb.h"
#include "tests/temporary_folder.h"

namespace standpoint {

// An exercise without a scan, which is carried out in a moment: switch a scanner on, level it, answer a question whose
// answer each variant has its own of.
inline nlohmann::json classExercise() {
  return nlohmann::json::parse(R"({
    "id": "C1",
    "title": {"en": "Switch on", "de": "Einschalten"},
    "goal": {"en": "Switch on; the answer is ${number}.", "de": "Einschalten; die Antwort ist ${number}."},
    "devices": ["generic"],
    "model": "house",
    "variants": {"number": {"choices": ["one", "two", "three"]}, "lean": {"from": 3, "to": 4, "step": 0.5}},
    "setup": [{"verb": "station", "options": {"add": "S1", "on": [4.3, 1.6, 0]}}],
    "start": [{"hand": "stand_at", "value": "S1"}, {"hand": "tilt", "value": "${lean},1"}],
    "in_order": false,
    "steps": [
      {"id": "on", "text": {"en": "Switch on.", "de": "Einschalten."}, "done": "screen == home", "points": 1},
      {"id": "answer", "text": {"en": "Answer.", "de": "Antworten."}, "done": "answer.count == ${number}",
       "points": 2}],
    "rules": [
      {"id": "level", "text": {"en": "It is level.", "de": "Es ist horizontiert."}, "when": "end", "holds": "tilt <= 2",
       "points": 1, "must": true, "mistake": "M03"}],
    "questions": [{"id": "count", "text": {"en": "How many?", "de": "Wie viele?"},
      "choices": [{"value": "one", "text": {"en": "1", "de": "1"}}, {"value": "two", "text": {"en": "2", "de": "2"}},
                  {"value": "three", "text": {"en": "3", "de": "3"}}]}],
    "solution": [{"hand": "level"}, {"press": "power"}, {"wait": 20}, {"answer": "count", "value": "${number}"}],
    "mistakes": [{"id": "M03", "actions": [
      {"press": "power"}, {"wait": 20}, {"answer": "count", "value": "${number}"}]}]
  })");
}

// A lecturer's folder: exercise, class list s-001 …, key, and the file for the class. Keys of students are made in it.
class Classroom {
 public:
  explicit Classroom(std::size_t students, const std::string& deadline = "2099-01-01T00:00Z") {
    setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
    folder.write("exercise.json", classExercise().dump());
    std::string list = "id,name,username\n";
    for (std::size_t i = 1; i <= students; ++i) list += id(i) + ",Student " + std::to_string(i) + ",u" + id(i) + "\n";
    folder.write("class.csv", list);
    const auto done = verb("assign", {{"exercise", path("exercise.json")},
                                      {"class", path("class.csv")},
                                      {"deadline", deadline},
                                      {"key", path("class.key")},
                                      {"new-key", true},
                                      {"variants", 3},
                                      {"output", path("C1.json")}});
    EXPECT_TRUE(done) << describe(done.error());
    auto read = readAssignment(path("C1.json"));
    EXPECT_TRUE(read) << describe(read.error());
    if (read) assignment = *std::move(read);
  }

  static std::string id(std::size_t n) { return "s-" + std::string(n < 10 ? "00" : "0") + std::to_string(n); }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  static Result<Outcome> verb(const char* name, const nlohmann::json& options) {
    Progress quiet;
    return runVerb(*findVerb(allVerbs(), name), {}, options, quiet);
  }

  std::string numberOf(const std::string& student) const {
    const auto* variant = assignment.variantOf(student);
    return variant == nullptr ? "" : variant->figures.at("number").get<std::string>();
  }
  // Twenty actions that have full marks.
  nlohmann::json goodActions(const std::string& student) const {
    auto actions = nlohmann::json::parse(R"([{"hand": "level"}, {"press": "power"}, {"wait": 20}])");
    for (int i = 0; i < 16; ++i) actions.push_back({{"wait", 1 + i}});
    actions.push_back({{"answer", "count"}, {"value", numberOf(student)}});
    return actions;
  }

  // As a student does: carries the actions out, and hands the result in.
  std::filesystem::path handIn(const std::string& student, const nlohmann::json& actions,
                               const std::string& to = "results") const {
    folder.write("actions.json", actions.dump());
    const auto out = path("work-" + student);
    const auto done =
        verb("rehearse",
             {{"exercise", path("C1.json")}, {"student", student}, {"actions", path("actions.json")}, {"output", out}});
    EXPECT_TRUE(done) << describe(done.error());
    std::filesystem::create_directories(folder / to);
    const auto name = "C1-" + student + ".result.json";
    std::filesystem::rename(out + "/" + name, folder / to / name);
    return folder / to / name;
  }

  // The file as somebody leaves it who changes what it says; the seal stays, unless a key is given.
  static void tamper(const std::filesystem::path& file, const std::function<void(nlohmann::json&)>& change,
                     const SigningKey* key = nullptr) {
    auto json = *readJsonFile(file);
    auto payload = nlohmann::json::parse(json["payload"].get<std::string>());
    change(payload);
    if (key != nullptr)
      std::ofstream(file) << fileText(sealed(json["format"], payload.dump(), *key));
    else
      json["payload"] = payload.dump(), std::ofstream(file) << json.dump();
  }

  Result<Outcome> collect(const std::string& from = "results") const {
    return verb("collect", {{"folder", path(from)},
                            {"assignment", path("C1.json")},
                            {"class", path("class.csv")},
                            {"key", path("class.key")},
                            {"home-page", "https://school.example/moodle"},
                            {"output", path("table")}});
  }
  std::string text(const std::string& name) const {
    const auto read = readWholeFile(folder / name, 1U << 28U);
    EXPECT_TRUE(read) << name;
    return read ? *read : std::string();
  }

  TemporaryFolder folder;
  Assignment assignment;
};

}  // namespace standpoint

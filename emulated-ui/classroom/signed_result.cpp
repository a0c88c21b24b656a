// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/signed_result.h"

#include <type_traits>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/part_file.h"
#include "emulated-ui/classroom/dates.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr std::uintmax_t kLargestModel = 1U << 30U;
constexpr double kMostPoints = 1e6;

std::string chainStart(const SignedResult& r) {
  return digestOf(fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", kResultKind, r.assignment_hash, r.exercise_hash, r.model,
                              r.program, r.student, r.seed));
}

std::string nextLink(const std::string& before, const ResultAction& a) {
  return digestOf(fmt::format("{}\n{}\n{}\n{}", before, a.action, a.wall_ms, a.state));
}

template <class Marked>
ResultCriterion criterion(const Marked& m, bool rule, bool held) {
  ResultCriterion c{m.id, rule, held, false, m.points, m.of, {}};
  if constexpr (std::is_same_v<Marked, MarkedRule>) c.must = m.must, c.mistake = m.mistake.value_or("");
  return c;
}

json toJson(const ResultCriterion& c) {
  json one = {{"id", c.id}, {"kind", c.rule ? "rule" : "step"}, {"held", c.held}, {"points", c.points}, {"of", c.of}};
  if (c.must) one["must"] = true;
  if (!c.mistake.empty()) one["mistake"] = c.mistake;
  return one;
}

json payloadOf(const SignedResult& r) {
  json criteria = json::array(), actions = json::array();
  for (const auto& c : r.criteria) criteria.push_back(toJson(c));
  for (const auto& a : r.actions)
    actions.push_back({{"action", a.action}, {"ms", a.wall_ms}, {"state", a.state}, {"hash", a.hash}});
  return {{"assignment", r.assignment},
          {"assignment_hash", r.assignment_hash},
          {"exercise", r.exercise},
          {"exercise_hash", r.exercise_hash},
          {"student", r.student},
          {"seed", r.seed},
          {"device", r.device},
          {"program", r.program},
          {"model", r.model},
          {"started", r.started},
          {"finished", r.finished},
          {"score", r.score},
          {"points", r.points},
          {"of", r.of},
          {"seconds", r.seconds},
          {"hints", r.hints},
          {"passed", r.passed},
          {"criteria", std::move(criteria)},
          {"actions", std::move(actions)},
          {"head", r.head}};
}

}  // namespace

std::string modelHash(const Exercise& exercise) {
  const auto file = modelOf(exercise);
  const auto model = file ? readWholeFile(*file, kLargestModel) : failure(file.error());
  return model ? digestOf(*model) : std::string("unknown");
}

std::optional<std::size_t> SignedResult::brokenAt() const {
  auto before = chainStart(*this);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (actions[i].hash != nextLink(before, actions[i])) return i + 1;
    before = actions[i].hash;
  }
  return head == before ? std::nullopt : std::optional(actions.size() + 1);
}

Result<std::filesystem::path> writeResult(const Rehearsal& rehearsal, const Marks& marks, const Assignment& assignment,
                                          const std::string& started, const std::filesystem::path& folder) {
  TRY_ASSIGN(const auto key, ownKey());
  const auto* variant = assignment.variantOf(marks.student);
  if (variant == nullptr)
    return failure(ErrorKind::usage, fmt::format("the class has no student '{}'", marks.student), "student");
  SignedResult r;
  r.assignment = fileText(assignment.seal);
  r.assignment_hash = assignment.hash;
  r.exercise = marks.exercise;
  r.exercise_hash = marks.exercise_hash;
  r.student = marks.student;
  r.seed = seedText(variant->seed);
  r.device = rehearsal.device().type().definition.id;
  r.program = STANDPOINT_VERSION;
  r.model = modelHash(rehearsal.exercise());
  r.started = started;
  r.finished = utcNow();
  r.score = marks.score, r.points = marks.points, r.of = marks.of;
  r.seconds = marks.seconds, r.hints = marks.hints, r.passed = marks.passed;
  for (const auto& s : marks.steps) r.criteria.push_back(criterion(s, false, s.done));
  for (const auto& rule : marks.rules) r.criteria.push_back(criterion(rule, true, rule.held));
  auto link = chainStart(r);
  for (std::size_t i = 0; i < rehearsal.actions().size(); ++i) {
    const auto& trace = rehearsal.traces()[i];
    ResultAction a{standpoint::toJson(rehearsal.actions()[i]).dump(), trace.wall_ms, trace.state, {}};
    link = a.hash = nextLink(link, a);
    r.actions.push_back(std::move(a));
  }
  r.head = link;
  const auto file = folder / fmt::format("{}-{}.result.json", r.exercise, r.student);
  TRY(writeWholeText(file, fileText(sealed(kResultKind, payloadOf(r).dump(), key))));
  return file;
}

Result<SignedResult> resultFrom(Sealed seal, const std::string& file_name) {
  TRY_ASSIGN(const auto payload, parseJson(seal.text, file_name));
  JsonFault fault(file_name);
  JsonFields f(fault, payload, "");
  SignedResult r;
  r.assignment = f.text("assignment");
  r.assignment_hash = f.text("assignment_hash");
  r.exercise = f.text("exercise");
  r.exercise_hash = f.text("exercise_hash");
  r.student = f.text("student");
  r.seed = f.text("seed");
  r.device = f.text("device");
  r.program = f.text("program");
  r.model = f.text("model");
  r.started = f.text("started");
  r.finished = f.text("finished");
  r.score = f.number("score", 0, 1);
  r.points = f.number("points", 0, kMostPoints);
  r.of = f.number("of", 0, kMostPoints);
  r.seconds = f.number("seconds", 0, 1e9);
  r.hints = f.number("hints", 0, 1e6);
  r.passed = f.flagOr("passed", false);
  f.list("criteria", [&](JsonFields& one) {
    ResultCriterion c;
    c.id = one.text("id");
    c.rule = one.wordOf("kind", {"step", "rule"}) == "rule";
    c.held = one.flagOr("held", false);
    c.must = one.flagOr("must", false);
    c.points = one.number("points", 0, kMostPoints);
    c.of = one.number("of", 0, kMostPoints);
    c.mistake = one.textOr("mistake", "");
    r.criteria.push_back(std::move(c));
  });
  f.list("actions", [&](JsonFields& one) {
    ResultAction a;
    a.action = one.text("action");
    a.wall_ms = static_cast<std::int64_t>(one.number("ms", 0, 1e12));
    a.state = one.text("state");
    a.hash = one.text("hash");
    r.actions.push_back(std::move(a));
  });
  r.head = f.text("head");
  f.close();
  TRY(fault.result());
  r.seal = std::move(seal);
  return r;
}

Result<SignedResult> readResult(const std::filesystem::path& file) {
  TRY_ASSIGN(auto seal, readSeal(file, kResultKind));
  return resultFrom(std::move(seal), file.filename().string());
}

}  // namespace standpoint

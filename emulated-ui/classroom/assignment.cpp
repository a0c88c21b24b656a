// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/assignment.h"

#include <charconv>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "emulated-ui/rehearsal/exercise_words.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr std::size_t kHashDigits = 24;

// What a seed or a variant belongs to: the exercise with its limits, so that another text of it draws anew.
std::string exerciseKey(const json& exercise) { return digestOf(exercise.dump()); }

std::uint64_t seedFrom(JsonFields& f) {
  const auto text = f.text("seed");
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed, 16);
  if (error != std::errc() || end != text.data() + text.size() || text.size() != 16)
    f.wrong("seed", "must be 16 hexadecimal digits");
  return seed;
}

}  // namespace

std::string seedText(std::uint64_t seed) { return fmt::format("{:016x}", seed); }

std::string studentHash(const std::string& salt, const std::string& student) {
  return digestOf("standpoint student\n" + salt + '\n' + student).substr(0, kHashDigits);
}

const Variant* Assignment::variantOf(const std::string& student) const {
  const auto found = students.find(studentHash(salt, student));
  return found == students.end() ? nullptr : &variants[found->second];
}

Result<Exercise> Assignment::exerciseWith(const Variant& variant) const {
  TRY_ASSIGN(auto given, exerciseFrom(exercise, id(), variant.figures));
  if (const auto& words = ExerciseWords::shipped(); words) words->addTo(given);
  return given;
}

std::uint64_t seedFor(const json& exercise, std::size_t n, const SigningKey& key) {
  return key.drawn(fmt::format("seed\n{}\n{}", exerciseKey(exercise), n));
}

Assignment assign(const AssignmentOrder& order, const SigningKey& key) {
  const auto exercise_key = exerciseKey(order.exercise);
  const auto salt = seedText(key.drawn("salt\n" + exercise_key + '\n' + order.class_name));
  json variants = json::array(), students = json::object();
  for (const auto& variant : order.variants)
    variants.push_back({{"seed", seedText(variant.seed)}, {"figures", variant.figures}});
  for (const auto& student : order.students)
    students[studentHash(salt, student.id)] =
        key.drawn("variant\n" + exercise_key + '\n' + student.id) % order.variants.size();
  auto exercise = withoutSolution(order.exercise);
  exercise.erase("variants");
  const json payload = {{"class", order.class_name},       {"program", STANDPOINT_VERSION},
                        {"deadline", order.deadline},      {"exercise", std::move(exercise)},
                        {"variants", std::move(variants)}, {"salt", salt},
                        {"students", std::move(students)}};
  return *assignmentFrom(sealed(kAssignmentKind, payload.dump(), key), "assignment");
}

Result<Assignment> assignmentFrom(Sealed seal, const std::string& file_name) {
  if (!seal.intact())
    return failure(ErrorKind::unusable, "was changed after the lecturer signed it; ask for the file as it was given",
                   file_name);
  TRY_ASSIGN(const auto payload, parseJson(seal.text, file_name));
  JsonFault fault(file_name);
  JsonFields f(fault, payload, "");
  Assignment a;
  a.class_name = f.text("class");
  a.program = f.text("program");
  a.deadline = f.anyText("deadline");
  a.salt = f.text("salt");
  if (const auto* exercise = f.required("exercise")) a.exercise = *exercise;
  f.list("variants", [&](JsonFields& one) {
    Variant variant{seedFrom(one), {}};
    one.each("figures",
             [&](const std::string& name, const json& value, const std::string&) { variant.figures[name] = value; });
    a.variants.push_back(std::move(variant));
  });
  if (a.variants.empty()) fault.say("/variants", "one at least is needed");
  f.each("students", [&](const std::string& hash, const json& index, const std::string& pointer) {
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= a.variants.size())
      fault.say(pointer, "is no index of a variant");
    else
      a.students[hash] = index.get<std::size_t>();
  });
  f.close();
  TRY(fault.result());
  if (!a.exercise.is_object() || !a.exercise.contains("id") || !a.exercise["id"].is_string())
    return failure(ErrorKind::unusable, "has no exercise with an id", file_name + " /exercise");
  TRY(a.exerciseWith(a.variants.front()));
  a.hash = digestOf(seal.text);
  a.seal = std::move(seal);
  return a;
}

Result<Assignment> readAssignment(const std::filesystem::path& file) {
  TRY_ASSIGN(auto seal, readSeal(file, kAssignmentKind));
  return assignmentFrom(std::move(seal), file.filename().string());
}

bool isAssignment(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && readSeal(file, kAssignmentKind).has_value();
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"
#include "emulated-ui/classroom/class_list.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "emulated-ui/rehearsal/variants.h"
#include "emulated-ui/seals/seal.h"

namespace standpoint {

constexpr const char* kAssignmentKind = "standpoint-assignment-1";

struct Variant {
  std::uint64_t seed = 0;
  Figures figures;
};
std::string seedText(std::uint64_t seed);  // 16 hexadecimal digits

// An exercise as a class gets it: one file, signed by the lecturer, without its solution. Which student has which
// variant is in it, but no student's name or id: only a hash by which each finds the own one.
struct Assignment {
  Sealed seal;       // the file
  std::string hash;  // of what was signed
  std::string class_name;
  std::string program;   // version that made it
  std::string deadline;  // UTC; empty: none
  nlohmann::json exercise;
  std::vector<Variant> variants;  // one at least
  std::string salt;
  std::map<std::string, std::size_t> students;  // hash of the id, index of the variant

  std::string id() const { return exercise.at("id").get<std::string>(); }
  // Null where the class has no such student.
  const Variant* variantOf(const std::string& student) const;
  // The exercise with that variant's figures.
  Result<Exercise> exerciseWith(const Variant& variant) const;
};

// How an id is named in the file: nobody else's can be read from it.
std::string studentHash(const std::string& salt, const std::string& student);

struct AssignmentOrder {
  nlohmann::json exercise;  // with solution, variants and mistakes
  std::string class_name;
  std::vector<Student> students;
  std::string deadline;  // UTC; empty: none
  std::vector<Variant> variants;
};
// The same order and key give the same variants to the same students, so that giving it out again is no new draw.
Assignment assign(const AssignmentOrder& order, const SigningKey& key);

// Seeds that only the key's owner can draw: the n-th for this exercise.
std::uint64_t seedFor(const nlohmann::json& exercise, std::size_t n, const SigningKey& key);

// One that was changed after it was signed is refused, and so is one without a sound exercise.
Result<Assignment> readAssignment(const std::filesystem::path& file);
Result<Assignment> assignmentFrom(Sealed seal, const std::string& file_name);
bool isAssignment(const std::filesystem::path& file);

}  // namespace standpoint

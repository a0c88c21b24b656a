// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "project/answers.h"

namespace standpoint {

struct Taken;  // pointclouds/filters/cleaning.h

struct CleanCount {  // of points of a kind
  std::uint64_t in = 0, removed = 0;
  std::optional<double> fraction;  // of those there were
};
const AnswerFields<CleanCount>& answerFields(const CleanCount*);
CleanCount countOf(const Taken& taken);
struct CleanCause {  // of points by what is wrong with them in truth
  std::uint64_t in = 0, removed = 0;
  std::optional<double> recall, precision;
};
const AnswerFields<CleanCause>& answerFields(const CleanCause*);
CleanCause causeOf(const Taken& taken, std::uint64_t removed);  // `removed`: all that was, whatever is wrong with it
struct CleanedClassRow {
  std::string name;
  CleanCount good, flawed;
};
const AnswerFields<CleanedClassRow>& answerFields(const CleanedClassRow*);
struct CleanedMoverRow {
  std::string id, name;
  CleanCount points;
};
const AnswerFields<CleanedMoverRow>& answerFields(const CleanedMoverRow*);
// What somebody's cleaning removed of a scan with truth.
struct CleaningAnswer {
  std::filesystem::path truth, cleaned;                 // as they were given
  std::uint64_t points = 0, cleaned_points = 0;         // of the files
  std::uint64_t removed = 0, doubled = 0, unknown = 0;  // unknown: the cleaned cloud has them where the truth has none
  std::optional<std::uint64_t> thinned;                 // not in the cleaned cloud, but others of their kind close by
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  CleanCause flawed;  // that should go
  CleanCount good;
  std::map<std::string, CleanCause> causes;  // by flag
  CleanCount plainly_mixed;
  std::vector<CleanedClassRow> classes;
  std::vector<CleanedMoverRow> movers;
};
const AnswerFields<CleaningAnswer>& answerFields(const CleaningAnswer*);

}  // namespace standpoint

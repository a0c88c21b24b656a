// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "project/answers.h"
#include "project/dataset/cleaning_answer.h"
#include "project/fields.h"

namespace standpoint {

// Scores anybody's labels of points, or what somebody's cleaning removed, against the truth.
struct ScoreOptions {
  std::filesystem::path truth;                   // a cloud with labels, a file of labels, or the folder of a set
  std::filesystem::path predicted;               // a file of labels; for a set, a folder of them; or a cleaned cloud
  std::string classes;                           // a shipped map or a file; empty: the only one of the set
  std::string split;                             // of a set; empty: all
  std::filesystem::path output;                  // .html, .json or .csv
  bool cleaning = false;                         // the next three are of such
  std::optional<double> tolerance_m, spacing_m;  // of rounding; of a cloud that was thinned, too
  std::optional<Eigen::Vector3d> shift_m;        // that the program took off; nothing: found
};
const Fields<ScoreOptions>& scoreFields();

struct ScoreRow {  // of a class; as in ClassScore
  std::string name;
  std::uint32_t id = 0;
  std::uint64_t truth = 0, predicted = 0, both = 0;  // points
  std::optional<double> iou, precision, recall;
};
const AnswerFields<ScoreRow>& answerFields(const ScoreRow*);
struct InstanceRow {  // of a class; as in InstanceScore
  std::string name;
  std::uint32_t id = 0;
  std::uint64_t truth = 0, predicted = 0;  // instances
  std::optional<double> ap, ap_50, ap_25;
};
const AnswerFields<InstanceRow>& answerFields(const InstanceRow*);
struct ScoreAnswer {
  std::filesystem::path truth, predicted;          // as they were given
  std::string map;                                 // name of the classes
  std::size_t files = 0;                           // of labels that were scored
  std::uint64_t points = 0;                        // scored
  std::uint64_t ignored = 0, given_up = 0;         // not scored; scored, but predicted as an ignored class
  std::optional<double> accuracy, mean_iou;        // of points; of the classes below
  std::size_t classes_in_mean = 0;                 // that truth or prediction has
  std::optional<double> mean_recall;               // of the classes that the truth has
  std::vector<ScoreRow> classes;                   // that are scored, by id
  std::vector<std::vector<std::uint64_t>> matrix;  // [truth][predicted]: points; the last column is `given_up`
  // Of instances, where the labels have such; means of the classes that the truth has instances of.
  std::optional<double> instance_ap, instance_ap_50, instance_ap_25;
  std::optional<std::size_t> classes_in_instance_mean;
  std::vector<InstanceRow> instances;  // of the classes that are scored, by id
};
const AnswerFields<ScoreAnswer>& answerFields(const ScoreAnswer*);
using ScoredAnswer = std::variant<ScoreAnswer, CleaningAnswer>;
Result<Answered<ScoredAnswer>> runScore(const Document& document, const ScoreOptions& options, Progress& progress);

// .html (one page without anything from elsewhere, at its end `pictures`, a part of it), .json (the answer) or .csv (a
// class a line).
Result<void> writeScoreReport(const ScoreAnswer& answer, const std::string& pictures,
                              const std::filesystem::path& file);

}  // namespace standpoint

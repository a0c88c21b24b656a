// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/score_verb.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/json_file.h"
#include "core/output_place.h"
#include "pointclouds/scores/class_scores.h"
#include "pointclouds/scores/instance_scores.h"
#include "project/dataset/cleaning_score.h"
#include "project/dataset/score_pictures.h"
#include "project/dataset/scored_labels.h"
#include "project/dataset/set_scans.h"
#include "project/dataset/share_text.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

struct ScorePlan {
  ClassMap map;
  std::vector<ScoredPair> pairs;
};

Result<void> checkScoreOutput(const fs::path& file) {
  if (file.empty()) return {};
  const auto ending = file.extension();
  if (ending != ".html" && ending != ".json" && ending != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .html, .json or .csv", "--output");
  return checkFolderOf(file, "--output");
}

Result<void> checkScoredClasses(const ClassMap& map) {
  for (std::size_t k = 0; k < map.classes.size(); ++k)
    if (map.withId(map.classes[k].id) != k)
      return failure(ErrorKind::unusable,
                     fmt::format("the classes '{}' and '{}' have the same id, so labels cannot tell them apart",
                                 map.classes[*map.withId(map.classes[k].id)].name, map.classes[k].name),
                     map.name);
  return {};
}

Result<RecipeClasses> classesOfSet(const Recipe& recipe, const ScoreOptions& options) {
  std::string all;
  for (const auto& classes : recipe.classes) {
    if (classes.id == options.classes || (options.classes.empty() && recipe.classes.size() == 1)) return classes;
    all += (all.empty() ? "" : ", ") + classes.id;
  }
  return failure(ErrorKind::usage, fmt::format("specify the classes of the set: {}", all), "--classes");
}

// What somebody has written of a scan, under `folder`.
Result<fs::path> predictionOf(const fs::path& folder, const std::string& scan, const std::string& classes) {
  std::vector<fs::path> found;
  for (const auto& ending : {"." + classes + ".npy", std::string(".npy"), std::string(".label"), std::string(".labels"),
                             std::string(".txt")}) {
    std::error_code error;
    if (const auto file = folder / (scan + ending); fs::exists(file, error)) found.push_back(file);
  }
  if (found.empty())
    return failure(ErrorKind::file_system,
                   fmt::format("this scan has no labels; it may have .{}.npy, .npy, .label, .labels or .txt", classes),
                   (folder / scan).string());
  if (found.size() > 1)
    return failure(ErrorKind::unusable,
                   fmt::format("this scan has labels in two files, {} and {}; keep one", found[0].filename().string(),
                               found[1].filename().string()),
                   (folder / scan).string());
  return found.front();
}

Result<ScorePlan> planOfSet(const ScoreOptions& options, Report& report) {
  std::error_code error;
  if (!fs::exists(options.truth / "recipe.json", error))
    return failure(ErrorKind::usage, "the folder is no set: specify a cloud, a file of labels or a set",
                   options.truth.string());
  if (!fs::is_directory(options.predicted, error))
    return failure(ErrorKind::usage, "labels of a set must be in a folder, in files that are named as its scans",
                   options.predicted.string());
  TRY_ASSIGN(const auto recipe, readRecipeOfSet(options.truth));
  TRY_ASSIGN(const auto classes, classesOfSet(recipe, options));
  const auto of_map = static_cast<std::size_t>(
      std::find_if(recipe.classes.begin(), recipe.classes.end(), [&](const auto& c) { return c.id == classes.id; }) -
      recipe.classes.begin());
  ScorePlan plan{classes.map, {}};
  std::size_t not_there = 0;
  const auto variants = variantsOf(recipe);
  for (const auto& place : placesOf(recipe)) {
    if (!options.split.empty() && recipe.splitOf(recipe.environments[place.environment]) != options.split) continue;
    for (const auto& variant : variants) {
      const auto files = filesOf(recipe, place, variant);
      if (!fs::exists(options.truth / files.record, error)) {
        ++not_there;
        continue;
      }
      TRY_ASSIGN(auto predicted, predictionOf(options.predicted, files.scan, classes.id));
      plan.pairs.push_back({options.truth / files.labels[of_map], std::move(predicted), options.truth / files.instances,
                            options.truth / files.cloud, recipe.environments[place.environment].id});
    }
  }
  if (plan.pairs.empty())
    return failure(ErrorKind::unusable, "the set has no scans to score in this split", options.truth.string());
  if (not_there > 0)
    report.note(recipe.name,
                fmt::format("scans of the recipe that are not in the set and were not scored: {}", not_there));
  return plan;
}

Result<ScorePlan> planOfFile(const ScoreOptions& options) {
  std::error_code error;
  if (!fs::exists(options.truth, error))
    return failure(ErrorKind::file_system, "file not found", options.truth.string());
  if (!options.split.empty()) return failure(ErrorKind::usage, "belongs to the folder of a set", "--split");
  if (options.classes.empty())
    return failure(ErrorKind::usage, "specify the classes that the labels are of, a name or a file (.json)",
                   "--classes");
  TRY_ASSIGN(auto map, classMapNamed(options.classes));
  return ScorePlan{
      std::move(map),
      {{options.truth, options.predicted, {}, isLabelFile(options.truth) ? fs::path() : options.truth, {}}}};
}

tl::unexpected<Error> noneOfTheClasses(const ScoredPair& pair, const UnknownLabel& label, const ClassMap& map) {
  const auto& file = label.predicted ? pair.predicted : pair.truth;
  const auto ending = file.extension();
  const auto place = ending == ".txt" || ending == ".labels" ? fmt::format("{} line {}", file.string(), label.at + 1)
                                                             : fmt::format("{} index {}", file.string(), label.at);
  if (label.id == PointLabels::kNone)
    return failure(ErrorKind::unusable, fmt::format("the label is no number that the classes of {} can have", map.name),
                   place);
  return failure(ErrorKind::unusable, fmt::format("the label {} is none of the classes of {}", label.id, map.name),
                 place);
}

// How sure the predicted instances are, from a file beside them: a line for each with its number and its confidence.
Result<std::map<std::uint32_t, double>> confidencesOf(fs::path predicted) {
  constexpr std::uintmax_t kLargest = std::uintmax_t{1} << 26U;
  std::map<std::uint32_t, double> confidences;
  const auto file = predicted.replace_extension(".confidence.txt");
  std::error_code error;
  if (!fs::exists(file, error)) return confidences;
  TRY_ASSIGN(const auto text, readWholeFile(file, kLargest));
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const char* const end = text.data() + std::min(text.find('\n', from), text.size());
    const char* at = text.data() + from;
    from = static_cast<std::size_t>(end - text.data()) + 1;
    ++number;
    const auto skip = [&] {
      while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    };
    std::uint32_t instance = 0;
    double confidence = 0;
    skip();
    if (at == end) continue;
    const auto first = std::from_chars(at, end, instance);
    at = first.ptr;
    skip();
    const auto second = std::from_chars(at, end, confidence);
    at = second.ptr;
    skip();
    if (first.ec != std::errc() || second.ec != std::errc() || at != end || !std::isfinite(confidence))
      return failure(ErrorKind::unusable, "must be the number of an instance and its confidence",
                     fmt::format("{} line {}", file.string(), number));
    confidences[instance] = confidence;
  }
  return confidences;
}

struct Tallies {
  ClassTally classes;
  InstanceTally instances;
  bool with_instances = false;       // somebody predicted one
  std::vector<std::uint64_t> wrong;  // points of each pair
  PairLabels last;                   // that were read
};

Result<void> addPair(const ScoredPair& pair, const ClassMap& map, Tallies& tallies, Progress& progress) {
  tallies.last = {};
  TRY_ASSIGN(tallies.last, readPair(pair, map, progress));
  const auto &truth = tallies.last.truth, &predicted = tallies.last.predicted;
  const auto wrong = tallies.classes.wrong();
  if (const auto unknown = tallies.classes.add(truth.ids, predicted.ids)) return noneOfTheClasses(pair, *unknown, map);
  tallies.wrong.push_back(tallies.classes.wrong() - wrong);
  const auto isOne = [](std::uint32_t instance) { return instance != 0; };
  tallies.with_instances |= std::any_of(predicted.instances.begin(), predicted.instances.end(), isOne);
  TRY_ASSIGN(const auto confidences, confidencesOf(pair.predicted));
  tallies.instances.add({truth.ids, truth.instances}, {predicted.ids, predicted.instances}, confidences);
  return {};
}

void takeInstances(const InstanceScores& scores, ScoreAnswer& answer) {
  answer.instance_ap = scores.ap;
  answer.instance_ap_50 = scores.ap_50;
  answer.instance_ap_25 = scores.ap_25;
  answer.classes_in_instance_mean = scores.counted;
  for (const auto& c : scores.classes)
    answer.instances.push_back({c.name, c.id, c.truth, c.predicted, c.ap, c.ap_50, c.ap_25});
}

ScoreAnswer scoreAnswerOf(const ClassScores& scores, const ScorePlan& plan, const ScoreOptions& options) {
  ScoreAnswer answer;
  answer.truth = options.truth;
  answer.predicted = options.predicted;
  answer.map = plan.map.name;
  answer.files = plan.pairs.size();
  answer.points = scores.points;
  answer.ignored = scores.ignored;
  answer.given_up = scores.given_up;
  answer.accuracy = scores.accuracy;
  answer.mean_iou = scores.mean_iou;
  answer.classes_in_mean = scores.counted;
  answer.mean_recall = scores.mean_accuracy;
  answer.matrix = scores.confusion;
  for (const auto& c : scores.classes)
    answer.classes.push_back({c.name, c.id, c.truth, c.predicted, c.both, c.iou(), c.precision(), c.recall()});
  return answer;
}

std::string scoreText(const ScoreAnswer& answer) {
  std::string text = fmt::format("{:24} {:>12} {:>12} {:>10} {:>10} {:>10}\n", "class", "truth", "predicted", "IoU",
                                 "precision", "recall");
  for (const auto& c : answer.classes)
    text += fmt::format("{:24} {:>12} {:>12} {:>10} {:>10} {:>10}\n", c.name, c.truth, c.predicted, shareText(c.iou),
                        shareText(c.precision), shareText(c.recall));
  if (!answer.instances.empty())
    text += fmt::format("\n{:24} {:>12} {:>12} {:>10} {:>10} {:>10}\n", "instances", "truth", "predicted", "AP",
                        "AP 50", "AP 25");
  for (const auto& c : answer.instances)
    text += fmt::format("{:24} {:>12} {:>12} {:>10} {:>10} {:>10}\n", c.name, c.truth, c.predicted, shareText(c.ap),
                        shareText(c.ap_50), shareText(c.ap_25));
  if (!answer.instances.empty())
    text += fmt::format("{:24} {:>12} {:>12} {:>10} {:>10} {:>10}\n\n", "mean", "", "", shareText(answer.instance_ap),
                        shareText(answer.instance_ap_50), shareText(answer.instance_ap_25));
  return text +
         fmt::format("mean recall {}; {} points with an ignored truth left out, {} predicted as an ignored class\n",
                     shareText(answer.mean_recall), answer.ignored, answer.given_up);
}

}  // namespace

const Fields<ScoreOptions>& scoreFields() {
  using O = ScoreOptions;
  static const Fields<O> fields = {
      {"truth",
       &O::truth,
       "a simulated cloud, a file of labels (.npy, .label, .labels, .txt) or the folder of a set",
       {.positional = true, .required = true}},
      {"predicted",
       &O::predicted,
       "file with a label for each point of the truth, in its order; for a set, a folder with one for each scan; with "
       "--cleaning, the cleaned cloud",
       {.positional = true, .required = true, .label = "Labels or cleaned cloud"}},
      {"classes", &O::classes, "classes of the labels, by name or file (.json); of a set, one of its own"},
      {"split", &O::split, "score only this split of a set", {.choices = {"train", "validation", "test"}}},
      {"output", &O::output, "report to write (.html to print, .json, .csv)"},
      {"cleaning", &O::cleaning,
       "score what somebody removed from a scan with true values in any program: what was found, what good was lost"},
      {"tolerance",
       &O::tolerance_m,
       "of a cleaned cloud: how far its program may have rounded a point (0.001 m unless given)",
       {.unit = "m", .minimum = 1e-6, .maximum = 0.02}},
      {"shift", &O::shift_m,
       "of a cleaned cloud: what its program took off the coordinates; found by itself where it is whole metres"},
      {"spacing",
       &O::spacing_m,
       "of a cleaned cloud that was also thinned: a point is removed where none of its kind is left within this",
       {.unit = "m", .minimum = 1e-4, .maximum = 1}}};
  return fields;
}

const AnswerFields<ScoreRow>& answerFields(const ScoreRow*) {
  using A = ScoreRow;
  static const AnswerFields<A> fields = {{"class", &A::name},          {"id", &A::id},        {"truth", &A::truth},
                                         {"predicted", &A::predicted}, {"both", &A::both},    {"iou", &A::iou},
                                         {"precision", &A::precision}, {"recall", &A::recall}};
  return fields;
}

const AnswerFields<InstanceRow>& answerFields(const InstanceRow*) {
  using A = InstanceRow;
  static const AnswerFields<A> fields = {{"class", &A::name},          {"id", &A::id}, {"truth", &A::truth},
                                         {"predicted", &A::predicted}, {"ap", &A::ap}, {"ap_50", &A::ap_50},
                                         {"ap_25", &A::ap_25}};
  return fields;
}

const AnswerFields<ScoreAnswer>& answerFields(const ScoreAnswer*) {
  using A = ScoreAnswer;
  static const AnswerFields<A> fields = {{"truth", &A::truth},
                                         {"predicted", &A::predicted},
                                         {"map", &A::map},
                                         {"files", &A::files},
                                         {"points", &A::points},
                                         {"ignored", &A::ignored},
                                         {"given_up", &A::given_up},
                                         {"accuracy", &A::accuracy},
                                         {"mean_iou", &A::mean_iou},
                                         {"classes_in_mean", &A::classes_in_mean},
                                         {"mean_recall", &A::mean_recall},
                                         {"classes", &A::classes},
                                         {"confusion", &A::matrix},
                                         {"instance_ap", &A::instance_ap, kLeftOut},
                                         {"instance_ap_50", &A::instance_ap_50, kLeftOut},
                                         {"instance_ap_25", &A::instance_ap_25, kLeftOut},
                                         {"classes_in_instance_mean", &A::classes_in_instance_mean, kLeftOut},
                                         {"instances", &A::instances, kLeftOut}};
  return fields;
}

namespace {

Result<Answered<ScoreAnswer>> scoreLabels(const Document& document, const ScoreOptions& options, Progress& progress) {
  Answered<ScoreAnswer> outcome{document};
  std::error_code error;
  progress.stage("Score the labels");
  TRY_ASSIGN(const auto plan,
             fs::is_directory(options.truth, error) ? planOfSet(options, outcome.report) : planOfFile(options));
  TRY(checkScoredClasses(plan.map));
  Tallies tallies{ClassTally(plan.map), InstanceTally(plan.map), false, {}, {}};
  for (std::size_t k = 0; k < plan.pairs.size(); ++k) {
    progress.advance(static_cast<double>(k) / static_cast<double>(plan.pairs.size()));
    TRY(addPair(plan.pairs[k], plan.map, tallies, progress));
  }
  outcome.answer = scoreAnswerOf(tallies.classes.scores(), plan, options);
  if (tallies.with_instances) takeInstances(tallies.instances.scores(), outcome.answer);
  const auto& answer = outcome.answer;
  if (answer.points == 0)
    return failure(ErrorKind::unusable, "no point has a class that is scored", options.truth.string());
  std::string pictures;
  if (options.output.extension() == ".html") {
    TRY_ASSIGN(pictures, picturesOfErrors(answer,
                                          {plan.map, plan.pairs, std::move(tallies.wrong), std::move(tallies.last),
                                           tallies.with_instances ? &tallies.instances : nullptr},
                                          outcome.report, progress));
  }
  if (!options.output.empty()) TRY(writeScoreReport(answer, pictures, options.output));
  outcome.description = fmt::format("Scored {} points: mean IoU {} of {} classes, accuracy {}", answer.points,
                                    shareText(answer.mean_iou), answer.classes_in_mean, shareText(answer.accuracy));
  outcome.text = scoreText(answer);
  return outcome;
}

// An answer as one of those that the verb can give.
template <class A>
Answered<ScoredAnswer> oneOf(Answered<A> of) {
  return {std::move(of.document), std::move(of.answer), std::move(of.report), std::move(of.description),
          std::move(of.text)};
}

}  // namespace

Result<Answered<ScoredAnswer>> runScore(const Document& document, const ScoreOptions& options, Progress& progress) {
  TRY(checkScoreOutput(options.output));
  if (options.cleaning) {
    if (!options.classes.empty()) return failure(ErrorKind::usage, "belongs to labels, not to a cleaning", "--classes");
    if (!options.split.empty()) return failure(ErrorKind::usage, "belongs to labels, not to a cleaning", "--split");
    TRY_ASSIGN(auto outcome, scoreCleaning(document, options, progress));
    return oneOf(std::move(outcome));
  }
  for (const auto& [is_given, option] :
       {std::pair(options.tolerance_m.has_value(), "--tolerance"),
        std::pair(options.spacing_m.has_value(), "--spacing"), std::pair(options.shift_m.has_value(), "--shift")})
    if (is_given) return failure(ErrorKind::usage, "belongs to a cleaning; add --cleaning", option);
  TRY_ASSIGN(auto outcome, scoreLabels(document, options, progress));
  return oneOf(std::move(outcome));
}

}  // namespace standpoint

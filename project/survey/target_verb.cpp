// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "project/answers.h"
#include "project/survey/survey_verbs.h"
#include "survey/targets/target_placing.h"

namespace standpoint {

namespace {

using SightsByTarget = std::map<std::string, TargetSights>;

TargetAnswerRow targetRow(const Target& t, const Georeference& g) {
  const bool plate = t.kind == TargetKind::checkerboard;
  return {t.name,
          plate ? "checkerboard" : "sphere",
          t.centre + g.shift_m,
          t.size_m,
          plate ? std::optional(t.normal) : std::nullopt,
          {}};
}

std::optional<double> wholePoints(const std::optional<double>& points) {
  return points ? std::optional(std::round(*points)) : std::nullopt;
}

Result<void> checkTargetName(const std::vector<Target>& targets, const std::string& name) {
  if (name.empty() || name.find_first_of(",= \t") != std::string::npos)
    return failure(ErrorKind::usage,
                   fmt::format("invalid target name '{}': spaces, commas and equals signs are not allowed", name));
  if (std::any_of(targets.begin(), targets.end(), [&](const Target& t) { return t.name == name; }))
    return failure(ErrorKind::usage, fmt::format("target '{}' already exists; remove it, or use another name", name));
  return {};
}

// Shape and size as said by --type, --kind and --size; place and normal are not set.
Result<Target> targetArticleFrom(const TargetKinds& kinds, const TargetOptions& options) {
  Target t;
  t.name = options.add.value_or("");
  const auto& type = options.type;
  const auto kind = options.kind;
  const auto found = std::find_if(kinds.articles.begin(), kinds.articles.end(), [&](const TargetArticle& a) {
    if (!type.empty()) return a.id == type;
    return !kind || *kind == a.shape;
  });
  if (found == kinds.articles.end()) {
    std::vector<std::string> ids;
    for (const auto& a : kinds.articles) ids.push_back(a.id);
    return failure(ErrorKind::usage, fmt::format("unknown target '{}'; available: {}", type, fmt::join(ids, ", ")),
                   "--type");
  }
  if (!type.empty() && kind && *kind != found->shape)
    return failure(ErrorKind::usage,
                   fmt::format("'{}' is not a {}: leave out the kind", type,
                               *kind == TargetKind::sphere ? "sphere" : "checkerboard"),
                   "--kind");
  t.kind = found->shape;
  t.size_m = options.size_m.value_or(found->size_m);
  return t;
}

Result<SightsByTarget> sightsByTarget(const Document& document, const RayScene& scene, const TargetKinds& kinds,
                                      const std::vector<Target>& targets, const TargetOptions& options,
                                      Report& report) {
  const SightRequest request{options.instrument, options.settings};
  SightsByTarget by_target;
  for (const auto& t : targets) {
    TRY_ASSIGN(auto sights, sightsOf(*document.job, scene, t, kinds.rules, request));
    tell(t, sights, report);
    by_target[t.name] = std::move(sights);
  }
  return by_target;
}

Result<Target> settled(const Document& document, const Job& others, const TargetKinds& kinds, Target target_to_place,
                       const TargetOptions& options, Answered<TargetAnswer>& outcome, Progress& progress) {
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), progress));
  std::string stands;
  auto target = placedTarget(others, document.georeference->shift_m, *scene, std::move(target_to_place), options,
                             stands, outcome.report);
  if (!target) return target;
  TRY_ASSIGN(auto sights, sightsByTarget(document, *scene, kinds, {*target}, options, outcome.report));
  auto& row = outcome.answer.placed.emplace(targetRow(*target, *document.georeference));
  if (!stands.empty()) row.stands_on = stands;
  outcome.answer.seen_from = std::move(sights[target->name]);
  return target;
}

Result<Target> addedTarget(const Document& document, const TargetOptions& options, Answered<TargetAnswer>& outcome,
                           Progress& progress) {
  TRY(checkTargetName(document.job->targets, *options.add));
  TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
  TRY_ASSIGN(auto article, targetArticleFrom(kinds, options));
  return settled(document, *document.job, kinds, std::move(article), options, outcome, progress);
}

// Without itself in the job it does not stand in its own way. A plate that is given no other direction keeps its own.
Result<Target> movedTarget(const Document& document, const Target& target, TargetOptions options,
                           Answered<TargetAnswer>& outcome, Progress& progress) {
  TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
  Job others = *document.job;
  std::erase_if(others.targets, [&](const Target& t) { return t.name == target.name; });
  if (!options.normal && !options.on_surface && target.kind == TargetKind::checkerboard) options.normal = target.normal;
  return settled(document, others, kinds, target, options, outcome, progress);
}

Result<SightsByTarget> sightsOfAll(const Document& document, const TargetOptions& options, Report& report,
                                   Progress& progress) {
  TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), progress));
  return sightsByTarget(document, *scene, kinds, document.job->targets, options, report);
}

}  // namespace

std::span<const Choice<TargetKind>> choices(TargetKind) {
  static constexpr std::array kKinds = {Choice<TargetKind>{"sphere", TargetKind::sphere},
                                        Choice<TargetKind>{"checkerboard", TargetKind::checkerboard}};
  return kKinds;
}

const Fields<TargetOptions>& targetFields() {
  using O = TargetOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new target"},
      {"move", &O::move, "name of the target to move; it keeps its kind and size"},
      {"rename", &O::rename, "name of the target to rename"},
      {"name", &O::name, "its new name"},
      {"remove", &O::remove, "name of the target to remove"},
      {"at", &O::at, "X,Y,Z of its centre, in the file's frame", {.unit = "m", .label = "Centre at"}},
      {"on",
       &O::on,
       "X,Y[,Z] of the floor for its tripod or pole; without Z the lowest with room",
       {.unit = "m", .label = "On the floor at"}},
      {"height", &O::height_m, "height of its centre above that floor", {.unit = "m", .minimum = 0.05, .maximum = 5}},
      {"on-surface", &O::on_surface, "X,Y,Z near the wall, column or ceiling to attach it to", {.unit = "m"}},
      {"stand-off",
       &O::stand_off_m,
       "depth of a magnetic base or bracket between surface and target",
       {.unit = "m", .minimum = 0, .maximum = 1}},
      {"type", &O::type,
       "article of scanners/targets/kinds.json: sphere-145, sphere-200, sphere-139, paper-150, bw-114, bw-152"},
      {"kind", &O::kind, "kind of target where no article is named"},
      {"size", &O::size_m, "diameter or side (default: the article's)", {.unit = "m", .minimum = 0.01, .maximum = 2}},
      {"normal", &O::normal, "direction that a checkerboard faces (default on a tripod: the nearest station)"},
      {"sight", &O::sight, "list how each station sees each target"},
      {"instrument", &O::instrument, "id of the measuring instrument (default: those used for scanning)"},
      {"set", &O::settings, "settings of the instrument, as of scan"}};
  return fields;
}

const AnswerFields<TargetAnswerRow>& answerFields(const TargetAnswerRow*) {
  using A = TargetAnswerRow;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"kind", &A::kind},
                                         {"at", &A::at},
                                         {"size", &A::size_m},
                                         {"normal", &A::normal, kLeftOut},
                                         {"stands_on", &A::stands_on, kLeftOut}};
  return fields;
}

const AnswerFields<TargetSight>& answerFields(const TargetSight*) {
  using A = TargetSight;
  static const AnswerFields<A> fields = {{"station", &A::station},
                                         {"distance_m", &A::distance_m},
                                         {"incidence_deg", &A::incidence_rad, answers::degrees},
                                         {"seen_share", &A::seen_fraction},
                                         {"points", &A::points, wholePoints},
                                         {"most_distance_m", &A::max_distance_m},
                                         {"why_not", &A::why_not, answers::nullWhereEmpty}};
  return fields;
}

const AnswerFields<TargetAnswer>& answerFields(const TargetAnswer*) {
  using A = TargetAnswer;
  static const AnswerFields<A> fields = {
      {"placed", &A::placed, kLeftOut}, {"seen_from", &A::seen_from, kLeftOut}, {"targets", &A::targets}};
  return fields;
}

Result<Answered<TargetAnswer>> runTarget(const Document& document, const TargetOptions& options, Progress& progress) {
  progress.stage("Target");
  const int asked = static_cast<int>(options.add.has_value()) + static_cast<int>(options.move.has_value()) +
                    static_cast<int>(options.rename.has_value()) + static_cast<int>(options.remove.has_value());
  if (asked > 1)
    return failure(ErrorKind::usage, "specify one of --add NAME, --move NAME, --rename NAME, --remove NAME");
  Answered<TargetAnswer> outcome{document};
  Job job = *document.job;
  const auto& g = *document.georeference;
  const auto find = [&](const std::string& wanted) {
    return std::find_if(job.targets.begin(), job.targets.end(), [&](const Target& t) { return t.name == wanted; });
  };
  if (options.add) {
    TRY_ASSIGN(auto target, addedTarget(document, options, outcome, progress));
    outcome.description = "Added target " + target.name;
    job.targets.push_back(std::move(target));
  } else if (options.move) {
    const auto at = find(*options.move);
    if (at == job.targets.end()) return failure(ErrorKind::usage, fmt::format("unknown target '{}'", *options.move));
    TRY_ASSIGN(auto target, movedTarget(document, *at, options, outcome, progress));
    outcome.description = fmt::format("Moved target {} by {:.2f} m", target.name, (target.centre - at->centre).norm());
    *at = std::move(target);
  } else if (options.rename) {
    const auto at = find(*options.rename);
    if (at == job.targets.end()) return failure(ErrorKind::usage, fmt::format("unknown target '{}'", *options.rename));
    if (options.name != at->name) TRY(checkTargetName(job.targets, options.name));
    at->name = options.name;
    outcome.answer.placed = targetRow(*at, g);
    outcome.description = fmt::format("Renamed target {} to {}", *options.rename, options.name);
  } else if (options.remove) {
    const auto at = find(*options.remove);
    if (at == job.targets.end()) return failure(ErrorKind::usage, fmt::format("unknown target '{}'", *options.remove));
    outcome.description = "Removed target " + at->name;
    job.targets.erase(at);
  } else if (options.sight) {
    TRY_ASSIGN(auto sights, sightsOfAll(document, options, outcome.report, progress));
    outcome.answer.seen_from = std::move(sights);
  }
  for (const auto& t : job.targets) outcome.answer.targets.push_back(targetRow(t, g));
  if (!outcome.description.empty()) outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint

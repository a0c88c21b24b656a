// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "project/answers.h"
#include "project/materials/materials_verb.h"
#include "project/model/import_verb.h"
#include "project/model/model_verbs.h"
#include "project/model/optimize_verb.h"
#include "project/model/product_match.h"
#include "project/model/treatments.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// The old list with the new files in their places.
Result<std::vector<fs::path>> sourcesAfter(const Document& document, const std::vector<fs::path>& files) {
  std::vector<fs::path> all(document.sources.begin(), document.sources.end());
  if (all.size() <= 1 || files.size() >= all.size()) return files;
  for (const auto& file : files) {
    const auto old =
        std::find_if(all.begin(), all.end(), [&](const fs::path& p) { return p.filename() == file.filename(); });
    if (old == all.end())
      return failure(
          ErrorKind::usage,
          fmt::format("the project was created from {} models, none with this name; specify all of them", all.size()),
          file.string());
    *old = file;
  }
  for (const auto& file : all) {
    std::error_code ignored;
    if (!fs::exists(file, ignored))
      return failure(ErrorKind::usage, "one of the project's model files no longer exists; specify all of them",
                     file.string());
  }
  return all;
}

// A selector of one product (`#12`, a GlobalId) in the numbers of the new model. A number may mean another product
// there.
class Selectors {
 public:
  Selectors(const Environment& before, const Environment& after, const ProductMatch& match)
      : before_(before), after_(after), match_(match) {
    for (std::size_t i = 0; i < before.products.size(); ++i) {
      old_of_name_.emplace(before.products[i].id, i);
      if (!before.products[i].global_id.empty()) old_of_name_.emplace(before.products[i].global_id, i);
    }
  }

  // The old product that the selector names; nothing when it is a pattern, or names none.
  const Product* named(const std::string& selector) const {
    const auto it = old_of_name_.find(selector);
    return it == old_of_name_.end() ? nullptr : &before_.products[it->second];
  }
  bool gone(const std::string& selector) const { return match_.new_of_old[old_of_name_.at(selector)] == kNoProduct; }

  std::string followed(const std::string& selector) const {
    const Product& old = *named(selector);
    const auto now = match_.new_of_old[old_of_name_.at(selector)];
    if (now == kNoProduct)
      return old.global_id.empty() ? "gone:" + old.id : old.global_id;  // means nothing until it comes back
    if (selector == old.global_id) return selector;
    return after_.products[static_cast<std::size_t>(now)].id;
  }

 private:
  const Environment& before_;
  const Environment& after_;
  const ProductMatch& match_;
  std::map<std::string, std::size_t> old_of_name_;
};

struct Update {
  const Document& before;
  Answered<ImportAnswer>& outcome;
  const ProductMatch& match;
  std::vector<UpdateKept> kept = {};

  // What was said of a product that is gone stays in the list, so that it holds again when the product comes back.
  std::string follow(const Selectors& selectors, const std::string& selector,
                     std::optional<std::string> UpdateKept::*what, const std::string& value) {
    const std::string id(selectedProduct(selector));
    const Product* product = selectors.named(id);
    if (product == nullptr) return selector;
    if (selectors.gone(id)) {
      const char* name = what == &UpdateKept::treatment ? "treatment" : "material";
      kept.push_back({name, selector, {}, {}, identityOf(*product)});
      kept.back().*what = value;
      outcome.report.warn(selector, fmt::format("product '{}' no longer exists; its {} {} is kept in case it returns",
                                                product->name, name, value));
    }
    return selectors.followed(id) + selector.substr(id.size());
  }

  void treatments() {
    if (!before.treatments) return;
    const Selectors selectors(*before.imported, *outcome.document.imported, match);
    auto now = *before.treatments;
    for (auto& treatment : now)
      treatment.selector = follow(selectors, treatment.selector, &UpdateKept::treatment, wordOf(treatment.kind));
    outcome.document.imported = withExclusions(outcome.document.imported, now);
    outcome.document.treatments = std::make_shared<const std::vector<Treatment>>(std::move(now));
  }

  Result<void> materials(Progress& progress) {
    if (!before.materials) return {};
    const Selectors selectors(*before.imported, *outcome.document.imported, match);
    MaterialChoice choice = *before.materials;
    for (MaterialOverride& o : choice.overrides)
      o.selector = follow(selectors, o.selector, &UpdateKept::material, o.material);
    outcome.document.materials = std::make_shared<const MaterialChoice>(std::move(choice));
    TRY_ASSIGN(auto assigned, assignDocumentMaterials(outcome.document, {}, progress));
    outcome.document.materials = assigned.document.materials;
    return {};
  }

  Result<void> simplified(Progress& progress) {
    if (!before.simplified) return {};
    auto request = before.simplified->request;
    if (std::exchange(request.by_view, false))
      outcome.report.note("optimize", "visibility in the changed model is unknown: visibility weights are not applied");
    TRY_ASSIGN(auto light, runOptimize(outcome.document, request, progress));
    outcome.document.simplified = light.document.simplified;
    outcome.report.append(light.report);
    return {};
  }

  void survey() {
    outcome.document.job = before.job;
    outcome.document.underlays = before.underlays;
    outcome.document.measurements = before.measurements;
    std::size_t scans = 0;
    for (const Station& s : before.job->stations) scans += s.scans.size();
    if (scans > 0) outcome.report.note("scan", fmt::format("{} scans show the previous model", scans));
    if (before.collision) outcome.report.note("collide", "collision shapes are out of date; compute them again");
  }

  // The project's own position stays: a map position may be the user's work.
  void georeference(const std::string& crs) {
    const Georeference& old = *before.georeference;
    Georeference now = *outcome.document.georeference;
    const bool other_crs = crs.empty() && !old.crs.empty() && !now.crs.empty() && old.crs != now.crs;
    const Eigen::Vector3d probe(10, 20, 3);
    const bool other_map =
        old.map_from_file && now.map_from_file &&
        (mapFromFile(*old.map_from_file, probe) - mapFromFile(*now.map_from_file, probe)).norm() > 1e-4;
    if (other_crs || other_map)
      outcome.report.warn("georeference",
                          "the changed model has a different georeference; that of the project is kept");
    if (old.map_from_file) now.map_from_file = old.map_from_file;
    if (!old.crs.empty() && crs.empty()) now.crs = old.crs;
    outcome.document.georeference = std::make_shared<const Georeference>(std::move(now));
  }
};

UpdateChanges changesOf(const Environment& before, const Environment& after, const ProductMatch& match) {
  const auto changes = productChanges(before, after, match);
  UpdateChanges answer;
  auto& counts = answer.counts;
  for (std::size_t i = 0; i < before.products.size(); ++i) {
    if (match.new_of_old[i] == kNoProduct) {
      answer.removed.push_back(identityOf(before.products[i]));
      continue;
    }
    const ProductChange& c = changes[i];
    if (!c.any()) {
      ++counts.unchanged;
      continue;
    }
    const auto& now = after.products[static_cast<std::size_t>(match.new_of_old[i])];
    answer.changed.push_back({identityOf(now), c.geometry, c.material, c.which});
    counts.geometry += c.geometry ? 1 : 0;
    counts.material += c.material ? 1 : 0;
    counts.properties += c.properties ? 1 : 0;
  }
  for (std::size_t i = 0; i < after.products.size(); ++i)
    if (match.old_of_new[i] == kNoProduct) answer.added.push_back(identityOf(after.products[i]));
  counts.added = answer.added.size();
  counts.removed = answer.removed.size();
  counts.changed = answer.changed.size();
  return answer;
}

}  // namespace

const AnswerFields<UpdatedProduct>& answerFields(const UpdatedProduct* product) {
  using A = UpdatedProduct;
  static const auto fields =
      withBases<A>({{"geometry", &A::geometry}, {"material", &A::material}, {"properties", &A::properties}},
                   answerFields(static_cast<const ProductIdentity*>(product)));
  return fields;
}

const AnswerFields<UpdateKept>& answerFields(const UpdateKept*) {
  using A = UpdateKept;
  static const AnswerFields<A> fields = {{"what", &A::what},
                                         {"selector", &A::selector},
                                         {"treatment", &A::treatment, kLeftOut},
                                         {"material", &A::material, kLeftOut},
                                         {"product", &A::product}};
  return fields;
}

const AnswerFields<UpdateCounts>& answerFields(const UpdateCounts*) {
  using A = UpdateCounts;
  static const AnswerFields<A> fields = {{"added", &A::added},          {"removed", &A::removed},
                                         {"changed", &A::changed},      {"unchanged", &A::unchanged},
                                         {"geometry", &A::geometry},    {"material", &A::material},
                                         {"properties", &A::properties}};
  return fields;
}

const AnswerFields<UpdateChanges>& answerFields(const UpdateChanges*) {
  using A = UpdateChanges;
  static const AnswerFields<A> fields = {{"counts", &A::counts},
                                         {"added", &A::added},
                                         {"removed", &A::removed},
                                         {"changed", &A::changed},
                                         {"kept", &A::kept}};
  return fields;
}

Result<Answered<ImportAnswer>> updateModels(const Document& document, std::vector<fs::path> files,
                                            const ImportOptions& options, const std::string& crs, Progress& progress) {
  if (!document.imported) return failure(ErrorKind::usage, "there is no model to update; import one first", "--update");
  if (options.shift != ShiftMode::automatic)
    return failure(ErrorKind::usage, "an update keeps the project's shift; leave out the shift", "--shift");
  TRY_ASSIGN(auto all, sourcesAfter(document, files));
  ImportOptions same_frame = options;
  same_frame.shift = ShiftMode::given;
  same_frame.given_shift_m = document.georeference->shift_m;
  Document fresh;
  fresh.name = document.name;
  auto outcome = importModels(fresh, all, same_frame, crs, progress);
  if (!outcome) return outcome;
  const auto match = matchProducts(*document.imported, *outcome->document.imported);
  auto changes = changesOf(*document.imported, *outcome->document.imported, match);
  outcome->document.underlays = document.underlays;
  Update update{document, *outcome, match};
  update.georeference(crs);
  update.survey();
  update.treatments();
  TRY(update.simplified(progress));
  TRY(update.materials(progress));
  changes.kept = std::move(update.kept);
  outcome->description =
      fmt::format("Updated {}: {} products added, {} removed, {} changed", files.front().filename().string(),
                  changes.counts.added, changes.counts.removed, changes.counts.changed);
  outcome->answer.changes = std::move(changes);
  outcome->document.import_report = std::make_shared<const Report>(outcome->report);
  return outcome;
}

}  // namespace standpoint

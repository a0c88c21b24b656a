// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/target_kinds.h"

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "core/units.h"
#include "scanners/instruments/figure_reader.h"

namespace standpoint {

namespace {

TargetArticle readArticle(FigureReader& in, const FigureReader::Json& value, const std::string& pointer) {
  auto group = in.open(value, pointer);
  TargetArticle article;
  article.id = group.fields.text("id");
  article.label = group.fields.text("label");
  article.shape = group.fields.wordOf("shape", {"sphere", "checkerboard"}) == "sphere" ? TargetKind::sphere
                                                                                       : TargetKind::checkerboard;
  article.size_m = in.figure(group, "size_mm", {10, 2000, 1e-3});
  group.fields.close();
  return article;
}

TargetKinds readKinds(FigureReader& in, const FigureReader::Json& json) {
  TargetKinds kinds;
  auto root = in.open(json, "");
  in.readSources(root);
  auto rules = in.child(root, "rules");
  kinds.rules.min_points = in.count(rules, "least_points", {10, 10000});
  kinds.rules.max_distance_m = in.figure(rules, "most_distance_m", {1, 1000});
  kinds.rules.max_incidence_rad = in.figure(rules, "most_incidence_deg", {10, 85, kRadPerDeg});
  rules.fields.close();
  const auto& list = in.list(root.fields, "kinds", 1000);
  for (std::size_t i = 0; i < list.size(); ++i) {
    kinds.articles.push_back(readArticle(in, list[i], "/kinds/" + std::to_string(i)));
    for (std::size_t k = 0; k < i; ++k)
      if (kinds.articles[k].id == kinds.articles[i].id)
        in.fail("/kinds/" + std::to_string(i) + "/id", "\"" + kinds.articles[i].id + "\" is duplicated");
  }
  root.fields.close();
  kinds.evidence = in.evidence();
  return kinds;
}

double solidAngle(const ScanSettings& s) {
  return (s.elevation_to_rad - s.elevation_from_rad) / s.rows * std::abs(s.azimuth_to_rad - s.azimuth_from_rad) /
         s.columns;
}

double crossSection(const Target& target) {
  return target.size_m * target.size_m * (target.kind == TargetKind::sphere ? std::numbers::pi / 4 : 1);
}

}  // namespace

Result<TargetKinds> readTargetKinds(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto json, readJsonFile(file, kLargestFile));
  FigureReader in(file.filename().string());
  TargetKinds kinds = readKinds(in, json);
  if (in.error()) return failure(*in.error());
  return kinds;
}

double pointsOn(const Target& target, double distance_m, double incidence_rad, const ScanSettings& settings) {
  const double facing = target.kind == TargetKind::sphere ? 1 : std::max(0.0, std::cos(incidence_rad));
  return crossSection(target) * facing / (distance_m * distance_m) / solidAngle(settings);
}

double distanceFor(const Target& target, double points, const ScanSettings& settings) {
  return std::sqrt(crossSection(target) / points / solidAngle(settings));
}

}  // namespace standpoint

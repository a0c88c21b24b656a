// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/project_info.h"

#include <algorithm>

#include "project/answers.h"

namespace standpoint {

namespace {

using nlohmann::json;

json survey(const Job& job) {
  std::size_t scans = 0;
  std::uint64_t points = 0;
  for (const auto& station : job.stations)
    for (const auto& scan : station.scans) {
      ++scans;
      points += scan.points;
    }
  return {{"stations", job.stations.size()}, {"targets", job.targets.size()}, {"scans", scans}, {"points", points}};
}

}  // namespace

json projectInfo(const Document& document) {
  json answer = {{"format", "project"}, {"name", document.name}, {"sources", document.sources}};
  if (document.georeference) answer["georeference"] = georeferenceToJson(*document.georeference);
  if (document.imported) {
    const auto& products = document.imported->products;
    answer["products"] = products.size();
    answer["products_excluded"] =
        std::count_if(products.begin(), products.end(), [](const Product& p) { return p.excluded; });
    answer["triangles_imported"] = sceneTriangleCount(*document.imported);
    answer["triangles"] = sceneTriangleCount(*document.environment());
    const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
    answer["bounds"] = toJson(bounds(*document.environment()), shift);
  }
  answer["max_deviation_m"] = document.simplified ? json(document.simplified->all.max_deviation_m) : json(nullptr);
  answer["collision_shapes"] = document.collision ? json(document.collision->shapes.size()) : json(nullptr);
  answer["walkable_m2"] = document.collision ? json(document.collision->walkable_area_m2) : json(nullptr);
  answer["material_coverage"] = document.materials ? json(document.materials->result.report.coverage) : json(nullptr);
  answer["survey"] = survey(document.job ? *document.job : Job{});
  answer["underlays"] = document.underlays.size();
  return answer;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/statistics.h"
#include "project/answers.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

using nlohmann::json;

json statisticsJson(const Distribution& d) {
  return {{"samples", d.samples}, {"mean", d.mean},     {"sigma", d.sigma},
          {"p5", d.p5},           {"median", d.median}, {"p95", d.p95}};
}

json statisticsJson(const CloudStatistics& s) {
  json materials = json::array();
  for (const auto& m : s.materials)
    materials.push_back({{"material", m.material}, {"points", m.points}, {"mean", m.mean}, {"sigma", m.sigma}});
  return {{"scans", s.scans},
          {"points", s.points},
          {"bounds", {toJson(s.low), toJson(s.high)}},
          {"plane_noise_m", statisticsJson(s.plane_noise_m)},
          {"roughness_m", statisticsJson(s.roughness_m)},
          {"intensity", statisticsJson(s.intensity)},
          {"materials", std::move(materials)},
          {"occupied_cells", s.occupied_cells}};
}

}  // namespace

const Fields<CompareOptions>& compareFields() {
  using O = CompareOptions;
  static const Fields<O> fields = {{"a", &O::a, "first cloud", {.positional = true, .required = true}},
                                   {"b", &O::b, "second cloud", {.positional = true, .required = true}}};
  return fields;
}

Result<Outcome> runCompare(const Document& document, const CompareOptions& options, Progress& progress) {
  progress.stage("Compare");
  TRY_ASSIGN(auto comparison, compareClouds(options.a, options.b, {}, progress));
  Outcome outcome{document, json::object(), comparison.report, {}};
  outcome.answer = {{"a", statisticsJson(comparison.a)},
                    {"b", statisticsJson(comparison.b)},
                    {"a_covered_by_b", comparison.a_covered_by_b},
                    {"b_covered_by_a", comparison.b_covered_by_a}};
  outcome.description = "Compared two clouds";
  return outcome;
}

}  // namespace standpoint

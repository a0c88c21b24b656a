// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <utility>

#include "project/verbs/file_verbs.h"

namespace standpoint {

const Fields<CompareOptions>& compareFields() {
  using O = CompareOptions;
  static const Fields<O> fields = {{"a", &O::a, "first cloud", {.positional = true, .required = true}},
                                   {"b", &O::b, "second cloud", {.positional = true, .required = true}},
                                   {"a-scan", &O::a_scan, "only this scan of the first cloud, by its name"},
                                   {"b-scan", &O::b_scan, "only this scan of the second cloud, by its name"}};
  return fields;
}

const AnswerFields<Distribution>& answerFields(const Distribution*) {
  using A = Distribution;
  static const AnswerFields<A> fields = {{"samples", &A::samples}, {"mean", &A::mean},     {"sigma", &A::sigma},
                                         {"p5", &A::p5},           {"median", &A::median}, {"p95", &A::p95}};
  return fields;
}

const AnswerFields<MaterialIntensity>& answerFields(const MaterialIntensity*) {
  using A = MaterialIntensity;
  static const AnswerFields<A> fields = {
      {"material", &A::material}, {"points", &A::points}, {"mean", &A::mean}, {"sigma", &A::sigma}};
  return fields;
}

const AnswerFields<ComparedCloud>& answerFields(const ComparedCloud*) {
  using A = ComparedCloud;
  static const AnswerFields<A> fields = {{"scans", &A::scans},
                                         {"points", &A::points},
                                         {"bounds", &A::bounds_m},
                                         {"plane_noise_m", &A::plane_noise_m},
                                         {"roughness_m", &A::roughness_m},
                                         {"intensity", &A::intensity},
                                         {"materials", &A::materials},
                                         {"occupied_cells", &A::occupied_cells}};
  return fields;
}

const AnswerFields<LargestDifference>& answerFields(const LargestDifference*) {
  using A = LargestDifference;
  static const AnswerFields<A> fields = {{"at_m", &A::at_m}, {"distance_m", &A::distance_m}};
  return fields;
}

const AnswerFields<CompareAnswer>& answerFields(const CompareAnswer*) {
  using A = CompareAnswer;
  static const AnswerFields<A> fields = {{"a", &A::a},
                                         {"b", &A::b},
                                         {"a_covered_by_b", &A::a_covered_by_b},
                                         {"b_covered_by_a", &A::b_covered_by_a},
                                         {"a_from_b_m", &A::a_from_b_m},
                                         {"b_from_a_m", &A::b_from_a_m},
                                         {"a_largest", &A::a_largest, kLeftOut},
                                         {"b_largest", &A::b_largest, kLeftOut}};
  return fields;
}

Result<Answered<CompareAnswer>> runCompare(const Document& document, const CompareOptions& options,
                                           Progress& progress) {
  progress.stage("Compare");
  TRY_ASSIGN(auto comparison, compareClouds({options.a, options.a_scan}, {options.b, options.b_scan}, {}, progress));
  const auto &a = comparison.a, &b = comparison.b;
  const auto kept = [](CloudDistances& of) { return std::make_shared<const CloudDistances>(std::move(of)); };
  CompareAnswer answer{{a, {a.low, a.high}},
                       {b, {b.low, b.high}},
                       comparison.a_covered_by_b,
                       comparison.b_covered_by_a,
                       comparison.a_from_b.distribution_m,
                       comparison.b_from_a.distribution_m,
                       comparison.a_from_b.largest,
                       comparison.b_from_a.largest,
                       kept(comparison.a_from_b),
                       kept(comparison.b_from_a)};
  return Answered<CompareAnswer>{document, std::move(answer), comparison.report, "Compared two clouds"};
}

}  // namespace standpoint

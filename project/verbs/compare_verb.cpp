// SPDX-License-Identifier: GPL-3.0-or-later
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

const AnswerFields<CompareAnswer>& answerFields(const CompareAnswer*) {
  using A = CompareAnswer;
  static const AnswerFields<A> fields = {
      {"a", &A::a}, {"b", &A::b}, {"a_covered_by_b", &A::a_covered_by_b}, {"b_covered_by_a", &A::b_covered_by_a}};
  return fields;
}

Result<Answered<CompareAnswer>> runCompare(const Document& document, const CompareOptions& options,
                                           Progress& progress) {
  progress.stage("Compare");
  TRY_ASSIGN(const auto comparison,
             compareClouds({options.a, options.a_scan}, {options.b, options.b_scan}, {}, progress));
  const auto &a = comparison.a, &b = comparison.b;
  return Answered<CompareAnswer>{
      document,
      {{a, {a.low, a.high}}, {b, {b.low, b.high}}, comparison.a_covered_by_b, comparison.b_covered_by_a},
      comparison.report,
      "Compared two clouds"};
}

}  // namespace standpoint

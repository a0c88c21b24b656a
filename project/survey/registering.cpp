// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/rigid_fit.h"
#include "project/answers.h"
#include "project/survey/underlays.h"
#include "survey/registration/cloud_fit.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using nlohmann::json;

Result<PlacePair> placePairFrom(const std::string& text) {
  const auto equals = text.find('=');
  const auto cloud = parseNumbers(text.substr(0, equals));
  const auto model = parseNumbers(equals == std::string::npos ? "" : text.substr(equals + 1));
  if (!cloud || !model || cloud->size() != 3 || model->size() != 3)
    return failure(ErrorKind::usage, fmt::format("'{}' must be X,Y,Z in the cloud = X,Y,Z in the model", text),
                   "--pairs");
  return PlacePair{vectorFrom(*cloud), vectorFrom(*model)};
}

std::string unitFor(double scale) {
  struct Unit {
    double scale;
    const char* what;
  };
  constexpr std::array units = {Unit{0.001, "millimetres"}, Unit{0.01, "centimetres"}, Unit{0.3048, "feet"},
                                Unit{0.0254, "inches"}};
  for (const auto& unit : units)
    if (std::abs(scale / unit.scale - 1) < 0.01) return fmt::format(": the cloud unit seems to be {}", unit.what);
  return {};
}

// Three standard deviations, and more than a millimetre over the pairs' extent.
bool scaleDiffers(const RigidFit& fit, const std::vector<PlacePair>& pairs) {
  double extent_m = 0;
  for (const auto& p : pairs) extent_m = std::max(extent_m, (p.cloud_m - pairs.front().cloud_m).norm());
  const double off = std::abs(fit.scale - 1);
  return off > 3 * fit.scale_sigma && off * extent_m > 0.001;
}

Result<Pose> byPairs(const std::vector<PlacePair>& pairs, const std::string& name, UnderlayRegistration& came_of_it,
                     Report& report) {
  std::vector<Vector3d> cloud, model;
  for (const auto& p : pairs) cloud.push_back(p.cloud_m), model.push_back(p.model_m);
  const auto fit = fitRigid(cloud, model);
  if (!fit) return failure(fit.error().kind, fit.error().message, "--pairs");
  for (std::size_t i = 0; i < pairs.size(); ++i) came_of_it.pairs.push_back({cloud[i], model[i], fit->residual_m[i]});
  came_of_it.pairs_rms_m = fit->rms_m;
  came_of_it.scale = fit->scale;
  came_of_it.scale_sigma = fit->scale_sigma;
  if (scaleDiffers(*fit, pairs))
    report.warn(name, fmt::format("best fit of the pairs has scale {:.6f} ± {:.6f}; the scale is not applied{}",
                                  fit->scale, fit->scale_sigma, unitFor(fit->scale)));
  if (fit->breadth < 0.02)
    report.warn(name,
                "the pairs are nearly collinear, so the rotation about the line is weak: add a pair off the line");
  if (pairs.size() == 3) report.note(name, "only three pairs: add a fourth to detect errors");
  const auto worst = std::max_element(fit->residual_m.begin(), fit->residual_m.end());
  report.note(name, fmt::format("pairs fit to {:.4f} m; largest residual: pair {} with {:.4f} m", fit->rms_m,
                                worst - fit->residual_m.begin() + 1, *worst));
  return fit->to_from;
}

void tell(const SurfaceFit& fit, const std::string& name, Report& report) {
  report.note(name, fmt::format("surface fit in {} iterations: {:.4f} m RMS along the normals over {:.1f} % of the "
                                "points, position {:.4f} m (1 σ)",
                                fit.iterations, fit.rms_m, fit.used_fraction * 100, fit.sigma_shift_m.norm()));
  for (const auto& motion : fit.free)
    report.warn(name,
                fmt::format("the surface does not constrain the cloud {}: start position kept", describe(motion)));
  if (!fit.settled)
    report.warn(name, fmt::format("not converged after {} iterations: place the cloud closer first, by pairs of points",
                                  fit.iterations));
  if (fit.used_fraction < 0.5)
    report.warn(
        name,
        fmt::format("only {:.1f} % of the points are on the model: the position may be wrong, or the model incomplete",
                    fit.used_fraction * 100));
}

}  // namespace

Result<std::vector<PlacePair>> FieldValue<std::vector<PlacePair>>::read(const json& texts) {
  std::vector<PlacePair> pairs;
  for (const auto& text : texts) {
    TRY_ASSIGN(const auto pair, placePairFrom(text.get<std::string>()));
    pairs.push_back(pair);
  }
  return pairs;
}

json FieldValue<std::vector<PlacePair>>::write(const std::vector<PlacePair>& pairs) {
  json texts;
  for (const auto& [cloud, model] : pairs)
    texts.push_back(fmt::format("{},{},{}={},{},{}", cloud.x(), cloud.y(), cloud.z(), model.x(), model.y(), model.z()));
  return texts;
}

const AnswerFields<PairResidual>& answerFields(const PairResidual*) {
  using A = PairResidual;
  static const AnswerFields<A> fields = {
      {"cloud", &A::cloud_m}, {"model", &A::model_m}, {"residual_m", &A::residual_m}};
  return fields;
}

const AnswerFields<UnderlayRegistration>& answerFields(const UnderlayRegistration*) {
  using A = UnderlayRegistration;
  static const AnswerFields<A> fields = {{"pairs", &A::pairs, kLeftOut}, {"pairs_rms_m", &A::pairs_rms_m, kLeftOut},
                                         {"scale", &A::scale, kLeftOut}, {"scale_sigma", &A::scale_sigma, kLeftOut},
                                         {"icp", &A::icp, kLeftOut},     {"pose", &A::file_from_cloud}};
  return fields;
}

Result<Underlay> registered(const Document& document, const Underlay& underlay, const RegisterRequest& request,
                            UnderlayRegistration& came_of_it, Report& report, Progress& progress) {
  Underlay result = underlay;
  if (request.pairs.empty() && !request.to_surface)
    return failure(ErrorKind::usage, "specify --pairs x,y,z=X,Y,Z … (three or more), --icp, or both", "--register");
  if (!request.pairs.empty()) {
    TRY_ASSIGN(auto pose, byPairs(request.pairs, underlay.name, came_of_it, report));
    result.file_from_cloud = pose;
  }
  if (request.to_surface) {
    progress.stage("Reading " + underlay.name, 0, 0.4);
    TRY_ASSIGN(const auto sample, sampleCloud(underlay.file, kSampleForFit, progress));
    progress.stage("Fitting " + underlay.name + " to the model", 0.4, 1);
    const auto fit = fitCloudToModel(*document.environment(), document.georeference->shift_m, sample,
                                     result.file_from_cloud, request.reach_m, progress);
    if (!fit) return failure(fit.error().kind, fit.error().message, underlay.name);
    result.file_from_cloud = fit->to_from;
    came_of_it.icp = *fit;
    tell(*fit, underlay.name, report);
  }
  came_of_it.file_from_cloud = result.file_from_cloud;
  return result;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/verification_json.h"

#include <cstdlib>

#include <fmt/format.h>

#include "core/units.h"

namespace standpoint {

namespace {

using nlohmann::json;

std::optional<std::string> textFrom(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<std::string>());
}

template <class Row>
std::vector<Row> rowsFrom(const json& rows, Row (*read)(const json&)) {
  std::vector<Row> result;
  for (const auto& row : rows) result.push_back(read(row));
  return result;
}

FreeMotion motionFrom(const json& row) {
  const auto zeroWhereNull = [](const json& v) {
    return v.is_null() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : vectorFrom(v);
  };
  return {zeroWhereNull(row.at("along")), zeroWhereNull(row.at("about")), row.at("held_share")};
}

SurfaceFit fitFrom(const json& row) {
  SurfaceFit fit;
  fit.iterations = row.at("iterations");
  fit.settled = row.at("settled");
  fit.rms_m = row.at("rms_m");
  fit.used_fraction = row.at("used_share");
  fit.moved_m = row.at("moved_m");
  fit.sigma_shift_m = vectorFrom(row.at("sigma_shift_m"));
  fit.sigma_turn_rad = vectorFrom(row.at("sigma_turn_deg")) * kRadPerDeg;
  fit.free = rowsFrom(row.at("not_held"), motionFrom);
  return fit;
}

VerifySpread spreadFrom(const json& row) {
  return {row.at("points"), row.at("p5"), row.at("q1"), row.at("median"), row.at("q3"), row.at("p95")};
}

VerifyRangeBin rangeBinFrom(const json& row) { return {spreadFrom(row), row.at("from_m"), row.at("to_m")}; }

VerifyIncidenceBin incidenceBinFrom(const json& row) { return {spreadFrom(row), row.at("from_deg"), row.at("to_deg")}; }

VerifyOutlier outlierFrom(const json& row) {
  return {row.at("product"), row.at("name"), row.at("points"), row.at("off_db"), row.at("sigma_db")};
}

VerifyMaterial materialFrom(const json& row) {
  return {.material = textFrom(row.at("material")),
          .points = row.at("points"),
          .area_m2 = row.at("area_m2"),
          .judged = row.at("judged"),
          .agrees = row.at("agrees"),
          .off_db = spreadFrom(row.at("off_db")),
          .by_range = rowsFrom(row.at("by_range"), rangeBinFrom),
          .by_incidence = rowsFrom(row.at("by_incidence"), incidenceBinFrom),
          .products = row.at("products"),
          .outlying = rowsFrom(row.at("outlying"), outlierFrom)};
}

VerifyProposal proposalFrom(const json& row) {
  return {.material = textFrom(row.at("material")),
          .behaves_like = row.at("behaves_like"),
          .alike = row.at("alike"),
          .whole_material = row.at("whole_material"),
          .products = row.at("products"),
          .points = row.at("points"),
          .off_db = row.at("off_db"),
          .misfit_db = row.at("misfit_db"),
          .misfit_instead_db = row.at("misfit_instead_db"),
          .range_m = row.at("range_m"),
          .incidence_deg = row.at("incidence_deg"),
          .evidence = row.at("evidence"),
          .assign = row.at("assign")};
}

VerifyScale scaleFrom(const json& row) {
  VerifyScale scale;
  scale.reads = textFrom(row.at("reads"));
  scale.range_compensated = row.at("range_compensated");
  scale.explained = row.at("explained");
  if (const auto& scatter = row.at("scatter_db"); !scatter.is_null()) scale.scatter_db = scatter.get<double>();
  scale.learned_from_db = row.at("learned_from_db");
  scale.measured_to_db = row.at("measured_to_db").get<std::vector<std::vector<double>>>();
  return scale;
}

VerifyPoints pointsFrom(const json& row) {
  return {row.at("met"),  row.at("near"),   row.at("in_front"),        row.at("behind"),       row.at("behind_pane"),
          row.at("edge"), row.at("shared"), row.at("without_station"), row.at("not_a_number"), row.at("median_off_m")};
}

VerifyPassed passedFrom(const json& row) {
  return {{row.at("id"), row.at("global_id"), row.at("class"), row.at("name")},
          row.at("points_behind"),
          row.at("points_on")};
}

VerifyAnswer answerFrom(const json& row) {
  VerifyAnswer answer;
  answer.underlay = row.at("underlay");
  answer.instrument = row.at("instrument");
  answer.wavelength_nm = row.at("wavelength_nm");
  answer.points = pointsFrom(row.at("points"));
  answer.compared = row.at("compared");
  answer.grazing = row.at("grazing");
  answer.saturated = row.at("saturated");
  if (const auto& placement = row.at("placement"); !placement.is_null()) answer.placement = fitFrom(placement);
  answer.scale = scaleFrom(row.at("scale"));
  answer.no_verdict = textFrom(row.at("no_verdict")).value_or("");
  answer.materials = rowsFrom(row.at("materials"), materialFrom);
  answer.proposals = rowsFrom(row.at("proposals"), proposalFrom);
  answer.passed = rowsFrom(row.at("passed"), passedFrom);
  return answer;
}

}  // namespace

json verificationToJson(const Verification& verification) {
  return {{"basis", fmt::format("{:016x}", verification.basis)},
          {"rest", fmt::format("{:016x}", verification.rest)},
          {"answer", AnswerValue<VerifyAnswer>::write(verification.answer)}};
}

std::shared_ptr<const Verification> verificationFrom(const json& part) {
  Verification v;
  try {
    v.basis = std::strtoull(part.at("basis").get<std::string>().c_str(), nullptr, 16);
    v.rest = std::strtoull(part.value("rest", "").c_str(), nullptr, 16);  // an old project has none: compare again
    v.answer = answerFrom(part.at("answer"));
  } catch (const json::exception&) {
    return nullptr;
  }
  return std::make_shared<const Verification>(std::move(v));
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/materials_json.h"

#include <map>

#include "project/answers.h"

namespace standpoint {

using nlohmann::json;

namespace {

json physicalToJson(const PhysicalMaterial& m) {
  json index = json::array();
  for (const auto& row : m.complex_index) index.push_back({row.wavelength_nm, row.n, row.k});
  json sources = json::array();
  for (const auto& c : m.sources) sources.push_back({{"figure", c.figure}, {"text", c.text}, {"licence", c.licence}});
  return {{"id", m.id},
          {"label", m.label},
          {"reflectance", m.reflectance},
          {"hemispherical", m.hemispherical},
          {"roughness_rad", m.roughness_rad},
          {"gloss_slope", m.gloss_slope},
          {"index_of_refraction", m.index_of_refraction},
          {"complex_index", index},
          {"group_index", m.group_index},
          {"thickness_m", m.thickness_m},
          {"transmittance", m.transmittance},
          {"panes", m.panes},
          {"gap_m", m.gap_m},
          {"variation", m.variation},
          {"surface_variation", m.surface_variation},
          {"texture_scale_m", m.texture_scale_m},
          {"retro_gain", m.retro_gain},
          {"wet_of", m.wet_of},
          {"water_film_m", m.water_film_m},
          {"gaps", m.gaps},
          {"sources", sources}};
}

// "reflectance: measured: …", as projects had it before sources were listed with their licence.
Citation citationFrom(const std::string& text) {
  const auto colon = text.find(": ");
  return colon == std::string::npos ? Citation{"", text, ""}
                                    : Citation{text.substr(0, colon), text.substr(colon + 2), ""};
}

PhysicalMaterial physicalFrom(const json& j) {
  PhysicalMaterial m;
  m.id = j.at("id");
  m.label = j.at("label");
  m.reflectance = j.at("reflectance").get<Spectrum>();
  m.hemispherical = j.value("hemispherical", false);
  m.roughness_rad = j.at("roughness_rad");
  m.gloss_slope = j.at("gloss_slope");
  m.index_of_refraction = j.at("index_of_refraction");
  m.thickness_m = j.at("thickness_m");
  m.transmittance = j.at("transmittance").get<Spectrum>();
  for (const auto& row : j.value("complex_index", json::array()))
    m.complex_index.push_back({row.at(0), row.at(1), row.at(2)});
  m.group_index = j.value("group_index", Spectrum());
  m.panes = j.value("panes", 1);
  m.gap_m = j.value("gap_m", 0.0);
  m.variation = j.value("variation", 0.0);
  m.surface_variation = j.value("surface_variation", 0.0);
  m.texture_scale_m = j.value("texture_scale_m", 0.0);
  m.retro_gain = j.value("retro_gain", 0.0);
  m.wet_of = j.value("wet_of", "");
  m.water_film_m = j.value("water_film_m", 0.0);
  m.gaps = j.value("gaps", std::vector<std::string>());
  for (const auto& c : j.value("sources", json::array()))
    m.sources.push_back({c.at("figure"), c.at("text"), c.at("licence")});
  for (const auto& text : j.value("source", json::array())) m.sources.push_back(citationFrom(text));
  return m;
}

// Reasons repeat a thousandfold: they stand once, and surfaces give their place.
class Reasons {
 public:
  std::size_t place(const std::string& reason) {
    const auto [found, is_new] = place_.try_emplace(reason, texts_.size());
    if (is_new) texts_.push_back(reason);
    return found->second;
  }
  json texts() const { return texts_; }

 private:
  std::map<std::string, std::size_t> place_;
  std::vector<std::string> texts_;
};

std::string reasonFrom(const json& reason, const json& reasons) {
  return reason.is_string() ? reason.get<std::string>() : reasons.at(reason.get<std::size_t>()).get<std::string>();
}

json findingToJson(const MaterialFinding& f) {
  json remedies = json::array();
  for (const auto& r : f.remedies) remedies.push_back({r.text, r.selector, r.material});
  return {{"severity", f.severity}, {"source", f.source},     {"message", f.message}, {"id", f.id},
          {"kind", f.kind},         {"why", f.why},           {"cause", f.cause},     {"because", f.because},
          {"area_m2", f.area_m2},   {"products", f.products}, {"remedies", remedies}};
}

MaterialFinding findingFrom(const json& j) {
  MaterialFinding f;
  if (j.is_array()) {  // of before findings had an id
    f.severity = j.at(0);
    f.source = j.at(1);
    f.message = j.at(2);
    return f;
  }
  f.severity = j.at("severity");
  f.source = j.at("source");
  f.message = j.at("message");
  f.id = j.at("id");
  f.kind = j.at("kind");
  f.why = j.at("why");
  f.cause = j.at("cause");
  f.because = j.at("because");
  f.area_m2 = j.at("area_m2");
  f.products = j.at("products").get<std::vector<std::uint32_t>>();
  for (const auto& r : j.at("remedies")) f.remedies.push_back({r.at(0), r.at(1), r.at(2)});
  return f;
}

json rowsToJson(const std::vector<CoverageRow>& rows) {
  json result = json::array();
  for (const auto& r : rows) result.push_back({r.name, r.area_m2, r.assigned_m2, r.weak_m2});
  return result;
}

std::vector<CoverageRow> rowsFrom(const json& part) {
  std::vector<CoverageRow> rows;
  for (const auto& r : part) rows.push_back({r.at(0), r.at(1), r.at(2), r.at(3)});
  return rows;
}

json reportToJson(const MaterialReport& report) {
  json uses = json::array();
  for (const auto& u : report.uses)
    uses.push_back({{"material", u.material}, {"area_m2", u.area_m2}, {"products", u.products}});
  json findings = json::array();
  for (const auto& f : report.findings) findings.push_back(findingToJson(f));
  return {{"coverage", report.coverage},
          {"area_m2", report.area_m2},
          {"uses", uses},
          {"findings", findings},
          {"by_class", rowsToJson(report.by_class)},
          {"by_storey", rowsToJson(report.by_storey)}};
}

MaterialReport reportFrom(const json& j) {
  MaterialReport report;
  report.coverage = j.at("coverage");
  report.area_m2 = j.at("area_m2");
  for (const auto& u : j.at("uses")) report.uses.push_back({u.at("material"), u.at("area_m2"), u.at("products")});
  for (const auto& f : j.at("findings")) report.findings.push_back(findingFrom(f));
  report.by_class = rowsFrom(j.value("by_class", json::array()));
  report.by_storey = rowsFrom(j.value("by_storey", json::array()));
  return report;
}

}  // namespace

json materialsToJson(const MaterialChoice& choice) {
  json own = json::array(), overrides = json::array(), accepted = json::array(), materials = json::array();
  for (const auto& m : choice.own) own.push_back(physicalToJson(m));
  for (const auto& o : choice.overrides) overrides.push_back({{"selector", o.selector}, {"material", o.material}});
  for (const auto& a : choice.accepted)
    accepted.push_back({{"finding", a.finding}, {"cause", a.cause}, {"because", a.because}});
  const auto& assignment = choice.result.assignment;
  for (const auto& m : assignment.materials) materials.push_back(physicalToJson(m));
  Reasons reasons;
  json surfaces = json::array(), faces = json::array();
  for (const auto& s : assignment.surfaces)
    surfaces.push_back({s.product, s.surface, s.material, reasons.place(s.reason), s.confidence});
  for (const auto& f : assignment.faces) {
    faces.push_back({f.product, f.surface, toJson(f.direction), f.material, reasons.place(f.reason)});
    if (f.point) faces.back().push_back(toJson(*f.point));
  }
  return {{"rules_file", choice.rules_file},
          {"rules_text", choice.rules_text},
          {"own", own},
          {"overrides", overrides},
          {"accepted", accepted},
          {"instrument", choice.instrument},
          {"materials", materials},
          {"surfaces", surfaces},
          {"faces", faces},
          {"reasons", reasons.texts()},
          {"report", reportToJson(choice.result.report)}};
}

MaterialChoice materialsFrom(const json& j) {
  MaterialChoice choice;
  choice.rules_file = j.at("rules_file");
  choice.rules_text = j.value("rules_text", "");
  for (const auto& m : j.value("own", json::array())) choice.own.push_back(physicalFrom(m));
  for (const auto& o : j.at("overrides")) choice.overrides.push_back({o.at("selector"), o.at("material")});
  for (const auto& a : j.value("accepted", json::array()))
    choice.accepted.push_back({a.at("finding"), a.at("cause"), a.at("because")});
  choice.instrument = j.value("instrument", "");
  auto& assignment = choice.result.assignment;
  for (const auto& m : j.at("materials")) assignment.materials.push_back(physicalFrom(m));
  const json reasons = j.value("reasons", json::array());
  for (const auto& s : j.at("surfaces"))
    assignment.surfaces.push_back(
        {s.at(0), s.at(1), s.at(2), reasonFrom(s.at(3), reasons), s.size() > 4 ? s.at(4).get<double>() : 1.0});
  for (const auto& f : j.value("faces", json::array())) {
    assignment.faces.push_back({f.at(0), f.at(1), vectorFrom(f.at(2)), f.at(3), reasonFrom(f.at(4), reasons), {}});
    if (f.size() > 5) assignment.faces.back().point = vectorFrom(f.at(5));  // later than faces by direction
  }
  choice.result.report = reportFrom(j.at("report"));
  return choice;
}

}  // namespace standpoint

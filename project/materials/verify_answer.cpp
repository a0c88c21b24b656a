// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/verify_answer.h"

#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "project/answers.h"

namespace standpoint {

namespace {

using nlohmann::json;

json spreadJson(const Spread& s) {
  return {{"points", s.points}, {"p5", s.low}, {"q1", s.lower}, {"median", s.median}, {"q3", s.upper}, {"p95", s.high}};
}

json spreadJson(const std::vector<SpreadBin>& bins, const char* unit) {
  json rows = json::array();
  for (const auto& b : bins) {
    json row = spreadJson(b.off_db);
    row[std::string("from_") + unit] = b.from;
    row[std::string("to_") + unit] = b.to;
    rows.push_back(std::move(row));
  }
  return rows;
}

const std::string& idOf(const VerifyFound& found, std::int32_t material) {
  static const std::string none = "nothing";
  return material < 0 ? none : (*found.library)[static_cast<std::size_t>(material)].id;
}

json idOrNull(const VerifyFound& found, std::int32_t material) {
  return material < 0 ? json(nullptr) : json(idOf(found, material));
}

// Tenths, and never a negative zero.
double tenths(double db) { return std::round(db * 10) / 10 + 0.0; }

const Product& productOf(const VerifyFound& found, std::uint32_t group) {
  return found.document->environment()->products[found.measured.groups[group].product];
}

json productIds(const VerifyFound& found, const std::vector<std::uint32_t>& groups) {
  json ids = json::array();
  std::set<std::uint32_t> seen;
  for (const auto g : groups)
    if (seen.insert(found.measured.groups[g].product).second) ids.push_back(productOf(found, g).id);
  return ids;
}

double areaOf(const VerifyFound& found, std::int32_t material) {
  const std::string id = material < 0 ? "" : idOf(found, material);
  for (const auto& use : found.document->materials->result.report.uses)
    if (use.material == id) return use.area_m2;
  return 0;
}

json materialRow(const VerifyFound& found, const MaterialEvidence& m) {
  std::vector<std::uint32_t> groups;
  json outlying = json::array();
  for (const auto& g : m.groups) {
    groups.push_back(g.group);
    if (!g.supported || g.agrees) continue;
    const auto& product = productOf(found, g.group);
    outlying.push_back({{"product", product.id},
                        {"name", product.name},
                        {"points", g.points},
                        {"off_db", g.off_db},
                        {"sigma_db", g.sigma_db}});
  }
  return {{"material", idOrNull(found, m.material)},
          {"points", m.points},
          {"area_m2", areaOf(found, m.material)},
          {"judged", m.supported},
          {"agrees", m.agrees},
          {"off_db", spreadJson(m.off_db)},
          {"by_range", spreadJson(m.by_range, "m")},
          {"by_incidence", spreadJson(m.by_incidence, "deg")},
          {"products", productIds(found, groups)},
          {"outlying", std::move(outlying)}};
}

// What `materials --assign` takes. Of a product of several surfaces (a window) only those that were measured are meant,
// where they have a name.
json assignWords(const VerifyFound& found, const MaterialProposal& p) {
  std::map<std::uint32_t, std::set<std::uint32_t>> surfaces_of;
  for (const auto& s : found.document->materials->result.assignment.surfaces) surfaces_of[s.product].insert(s.surface);
  json words = json::array();
  std::set<std::string> said;
  for (const auto g : p.groups) {
    const auto& group = found.measured.groups[g];
    const auto& name = found.document->environment()->surfaces[group.surface].name;
    const bool whole = surfaces_of[group.product].size() <= 1 || name.empty();
    const std::string word = productOf(found, g).id + (whole ? "" : "&material:" + name) + "=" + idOf(found, p.instead);
    if (said.insert(word).second) words.push_back(word);
  }
  return words;
}

std::string evidenceOf(const VerifyFound& found, const MaterialProposal& p) {
  return fmt::format(
      "{} points at {:.1f}–{:.1f} m and {:.0f}–{:.0f}° deviate by {:+.1f} dB; '{}' fits to {:.1f} dB instead of {:.1f} "
      "dB",
      p.points, p.range_from_m, p.range_to_m, p.incidence_from_deg, p.incidence_to_deg, p.off_db,
      idOf(found, p.instead), p.misfit_instead_db, p.misfit_db);
}

json proposalRow(const VerifyFound& found, const MaterialProposal& p) {
  json alike = json::array();
  for (const auto m : p.alike) alike.push_back(idOf(found, m));
  return {{"material", idOrNull(found, p.material)},
          {"behaves_like", idOf(found, p.instead)},
          {"alike", std::move(alike)},
          {"whole_material", p.whole_material},
          {"products", productIds(found, p.groups)},
          {"points", p.points},
          {"off_db", p.off_db},
          {"misfit_db", p.misfit_db},
          {"misfit_instead_db", p.misfit_instead_db},
          {"range_m", {p.range_from_m, p.range_to_m}},
          {"incidence_deg", {p.incidence_from_deg, p.incidence_to_deg}},
          {"evidence", evidenceOf(found, p)},
          {"assign", assignWords(found, p)}};
}

json scaleRow(const MaterialComparison& c) {
  json knots = json::array();
  for (std::size_t k = 0; k < c.scale.db.size(); ++k)
    knots.push_back({c.scale.measured[k], c.scale.db[k] + c.level_db});
  return {{"reads", c.scale.db.empty() ? json(nullptr) : json(c.scale.describe())},
          {"range_compensated", c.scale.range_compensated},
          {"explained", c.scale.explained},
          {"scatter_db", c.scale.db.empty() ? json(nullptr) : json(c.scale.scatter_db)},
          {"learned_from_db", c.scale.spread_db},
          {"measured_to_db", std::move(knots)}};
}

json meetingRow(const MeasuredReturns& m) {
  const auto of = [&](BeamMeeting meeting) { return m.meetings[static_cast<std::size_t>(meeting)]; };
  return {{"met", of(BeamMeeting::met)},
          {"near", of(BeamMeeting::near)},
          {"in_front", of(BeamMeeting::in_front)},
          {"behind", of(BeamMeeting::behind)},
          {"behind_pane", of(BeamMeeting::behind_pane)},
          {"edge", of(BeamMeeting::edge)},
          {"shared", of(BeamMeeting::shared)},
          {"without_station", m.without_station},
          {"not_a_number", m.not_a_number},
          {"median_off_m", m.median_off_m}};
}

// Products that beams mostly pass: a door that stood open, or glass that is called something else.
json passedRows(const VerifyFound& found) {
  json rows = json::array();
  for (std::size_t p = 0; p < found.measured.behind.size(); ++p) {
    if (found.measured.behind[p] < 200 || found.measured.behind[p] < 3 * found.measured.on[p]) continue;
    json row = identity(found.document->environment()->products[p]);
    row["points_behind"] = found.measured.behind[p];
    row["points_on"] = found.measured.on[p];
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

json verifyAnswer(const VerifyFound& found) {
  json materials = json::array(), proposals = json::array();
  for (const auto& m : found.comparison.materials) materials.push_back(materialRow(found, m));
  for (const auto& p : found.comparison.proposals) proposals.push_back(proposalRow(found, p));
  return {{"underlay", found.underlay},
          {"instrument", found.instrument->id},
          {"wavelength_nm", found.instrument->wavelength_nm},
          {"points", meetingRow(found.measured)},
          {"compared", found.comparison.used},
          {"grazing", found.comparison.grazing},
          {"saturated", found.comparison.saturated},
          {"placement", found.placement ? toJson(*found.placement) : json(nullptr)},
          {"scale", scaleRow(found.comparison)},
          {"no_verdict", found.comparison.no_verdict.empty() ? json(nullptr) : json(found.comparison.no_verdict)},
          {"materials", std::move(materials)},
          {"proposals", std::move(proposals)},
          {"passed", passedRows(found)}};
}

void tellVerified(const VerifyFound& found, Report& report) {
  const auto& c = found.comparison;
  if (!c.scale.db.empty())
    report.note(found.underlay,
                fmt::format("vendor scale: {}{}; explains {:.1f} % of range and incidence effects, to {:.2f} dB",
                            c.scale.describe(), c.scale.range_compensated ? ", without range" : "",
                            c.scale.explained * 100, c.scale.scatter_db));
  for (const auto& m : c.materials)
    report.note(idOf(found, m.material),
                fmt::format("{} points: {:+.1f} dB (quartiles {:+.1f}, {:+.1f}){}", m.points, tenths(m.off_db.median),
                            tenths(m.off_db.lower), tenths(m.off_db.upper),
                            !m.supported ? ", too few for a verdict"
                            : m.agrees   ? ""
                                         : ", does not agree"));
  for (const auto& p : c.proposals)
    report.warn(idOf(found, p.material),
                fmt::format("behaves like '{1}' ({0}): {2}",
                            p.whole_material ? "all testable products"
                                             : fmt::format("{} of its products", productIds(found, p.groups).size()),
                            idOf(found, p.instead), evidenceOf(found, p)));
  if (!c.no_verdict.empty()) report.warn(found.underlay, "no proposals: " + c.no_verdict);
}

}  // namespace standpoint

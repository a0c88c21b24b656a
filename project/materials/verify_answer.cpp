// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/verify_answer.h"

#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "project/answers.h"

namespace standpoint {

namespace {

VerifySpread spreadOf(const Spread& s) { return {s.points, s.low, s.lower, s.median, s.upper, s.high}; }

template <class Bin>
std::vector<Bin> spreadsOf(const std::vector<SpreadBin>& bins) {
  std::vector<Bin> rows;
  for (const auto& b : bins) rows.push_back({spreadOf(b.off_db), b.from, b.to});
  return rows;
}

const std::string& idOf(const VerifyFound& found, std::int32_t material) {
  static const std::string none = "nothing";
  return material < 0 ? none : (*found.library)[static_cast<std::size_t>(material)].id;
}

std::optional<std::string> idOrNull(const VerifyFound& found, std::int32_t material) {
  return material < 0 ? std::nullopt : std::optional(idOf(found, material));
}

// Tenths, and never a negative zero.
double tenths(double db) { return std::round(db * 10) / 10 + 0.0; }

const Product& productOf(const VerifyFound& found, std::uint32_t group) {
  return found.document->environment()->products[found.measured.groups[group].product];
}

std::vector<std::string> productIds(const VerifyFound& found, const std::vector<std::uint32_t>& groups) {
  std::vector<std::string> ids;
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

VerifyMaterial materialRow(const VerifyFound& found, const MaterialEvidence& m) {
  std::vector<std::uint32_t> groups;
  std::vector<VerifyOutlier> outlying;
  for (const auto& g : m.groups) {
    groups.push_back(g.group);
    if (!g.supported || g.agrees) continue;
    const auto& product = productOf(found, g.group);
    outlying.push_back({product.id, product.name, g.points, g.off_db, g.sigma_db});
  }
  return {.material = idOrNull(found, m.material),
          .points = m.points,
          .area_m2 = areaOf(found, m.material),
          .judged = m.supported,
          .agrees = m.agrees,
          .off_db = spreadOf(m.off_db),
          .by_range = spreadsOf<VerifyRangeBin>(m.by_range),
          .by_incidence = spreadsOf<VerifyIncidenceBin>(m.by_incidence),
          .products = productIds(found, groups),
          .outlying = std::move(outlying)};
}

// What `materials --assign` takes. Of a product of several surfaces (a window) only those that were measured are meant,
// where they have a name.
std::vector<std::string> assignWords(const VerifyFound& found, const MaterialProposal& p) {
  std::map<std::uint32_t, std::set<std::uint32_t>> surfaces_of;
  for (const auto& s : found.document->materials->result.assignment.surfaces) surfaces_of[s.product].insert(s.surface);
  std::vector<std::string> words;
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

VerifyProposal proposalRow(const VerifyFound& found, const MaterialProposal& p) {
  std::vector<std::string> alike;
  for (const auto m : p.alike) alike.push_back(idOf(found, m));
  return {.material = idOrNull(found, p.material),
          .behaves_like = idOf(found, p.instead),
          .alike = std::move(alike),
          .whole_material = p.whole_material,
          .products = productIds(found, p.groups),
          .points = p.points,
          .off_db = p.off_db,
          .misfit_db = p.misfit_db,
          .misfit_instead_db = p.misfit_instead_db,
          .range_m = {p.range_from_m, p.range_to_m},
          .incidence_deg = {p.incidence_from_deg, p.incidence_to_deg},
          .evidence = evidenceOf(found, p),
          .assign = assignWords(found, p)};
}

VerifyScale scaleRow(const MaterialComparison& c) {
  VerifyScale row;
  if (!c.scale.db.empty()) row.reads = c.scale.describe(), row.scatter_db = c.scale.scatter_db;
  row.range_compensated = c.scale.range_compensated;
  row.explained = c.scale.explained;
  row.learned_from_db = c.scale.spread_db;
  for (std::size_t k = 0; k < c.scale.db.size(); ++k)
    row.measured_to_db.push_back({c.scale.measured[k], c.scale.db[k] + c.level_db});
  return row;
}

VerifyPoints meetingRow(const MeasuredReturns& m) {
  const auto of = [&](BeamMeeting meeting) { return m.meetings[static_cast<std::size_t>(meeting)]; };
  return {of(BeamMeeting::met),
          of(BeamMeeting::near),
          of(BeamMeeting::in_front),
          of(BeamMeeting::behind),
          of(BeamMeeting::behind_pane),
          of(BeamMeeting::edge),
          of(BeamMeeting::shared),
          m.without_station,
          m.not_a_number,
          m.median_off_m};
}

// Products that beams mostly pass: a door that stood open, or glass that is called something else.
std::vector<VerifyPassed> passedRows(const VerifyFound& found) {
  std::vector<VerifyPassed> rows;
  const auto &behind = found.measured.behind, &on = found.measured.on;
  for (std::size_t p = 0; p < behind.size(); ++p)
    if (behind[p] >= 200 && behind[p] >= 3 * on[p])
      rows.push_back({identityOf(found.document->environment()->products[p]), behind[p], on[p]});
  return rows;
}

}  // namespace

const AnswerFields<VerifySpread>& answerFields(const VerifySpread*) {
  using A = VerifySpread;
  static const AnswerFields<A> fields = {{"points", &A::points}, {"p5", &A::p5}, {"q1", &A::q1},
                                         {"median", &A::median}, {"q3", &A::q3}, {"p95", &A::p95}};
  return fields;
}

const AnswerFields<VerifyRangeBin>& answerFields(const VerifyRangeBin* answer) {
  using A = VerifyRangeBin;
  static const auto fields = withBases<A>({{"from_m", &A::from_m}, {"to_m", &A::to_m}},
                                          answerFields(static_cast<const VerifySpread*>(answer)));
  return fields;
}

const AnswerFields<VerifyIncidenceBin>& answerFields(const VerifyIncidenceBin* answer) {
  using A = VerifyIncidenceBin;
  static const auto fields = withBases<A>({{"from_deg", &A::from_deg}, {"to_deg", &A::to_deg}},
                                          answerFields(static_cast<const VerifySpread*>(answer)));
  return fields;
}

const AnswerFields<VerifyOutlier>& answerFields(const VerifyOutlier*) {
  using A = VerifyOutlier;
  static const AnswerFields<A> fields = {{"product", &A::product},
                                         {"name", &A::name},
                                         {"points", &A::points},
                                         {"off_db", &A::off_db},
                                         {"sigma_db", &A::sigma_db}};
  return fields;
}

const AnswerFields<VerifyMaterial>& answerFields(const VerifyMaterial*) {
  using A = VerifyMaterial;
  static const AnswerFields<A> fields = {{"material", &A::material}, {"points", &A::points},
                                         {"area_m2", &A::area_m2},   {"judged", &A::judged},
                                         {"agrees", &A::agrees},     {"off_db", &A::off_db},
                                         {"by_range", &A::by_range}, {"by_incidence", &A::by_incidence},
                                         {"products", &A::products}, {"outlying", &A::outlying}};
  return fields;
}

const AnswerFields<VerifyProposal>& answerFields(const VerifyProposal*) {
  using A = VerifyProposal;
  static const AnswerFields<A> fields = {{"material", &A::material},
                                         {"behaves_like", &A::behaves_like},
                                         {"alike", &A::alike},
                                         {"whole_material", &A::whole_material},
                                         {"products", &A::products},
                                         {"points", &A::points},
                                         {"off_db", &A::off_db},
                                         {"misfit_db", &A::misfit_db},
                                         {"misfit_instead_db", &A::misfit_instead_db},
                                         {"range_m", &A::range_m},
                                         {"incidence_deg", &A::incidence_deg},
                                         {"evidence", &A::evidence},
                                         {"assign", &A::assign}};
  return fields;
}

const AnswerFields<VerifyScale>& answerFields(const VerifyScale*) {
  using A = VerifyScale;
  static const AnswerFields<A> fields = {{"reads", &A::reads},
                                         {"range_compensated", &A::range_compensated},
                                         {"explained", &A::explained},
                                         {"scatter_db", &A::scatter_db},
                                         {"learned_from_db", &A::learned_from_db},
                                         {"measured_to_db", &A::measured_to_db}};
  return fields;
}

const AnswerFields<VerifyPoints>& answerFields(const VerifyPoints*) {
  using A = VerifyPoints;
  static const AnswerFields<A> fields = {{"met", &A::met},
                                         {"near", &A::near},
                                         {"in_front", &A::in_front},
                                         {"behind", &A::behind},
                                         {"behind_pane", &A::behind_pane},
                                         {"edge", &A::edge},
                                         {"shared", &A::shared},
                                         {"without_station", &A::without_station},
                                         {"not_a_number", &A::not_a_number},
                                         {"median_off_m", &A::median_off_m}};
  return fields;
}

const AnswerFields<VerifyPassed>& answerFields(const VerifyPassed* answer) {
  using A = VerifyPassed;
  static const auto fields = withBases<A>({{"points_behind", &A::points_behind}, {"points_on", &A::points_on}},
                                          answerFields(static_cast<const ProductIdentity*>(answer)));
  return fields;
}

const AnswerFields<VerifyAnswer>& answerFields(const VerifyAnswer*) {
  using A = VerifyAnswer;
  static const AnswerFields<A> fields = {{"underlay", &A::underlay},
                                         {"instrument", &A::instrument},
                                         {"wavelength_nm", &A::wavelength_nm},
                                         {"points", &A::points},
                                         {"compared", &A::compared},
                                         {"grazing", &A::grazing},
                                         {"saturated", &A::saturated},
                                         {"placement", &A::placement},
                                         {"scale", &A::scale},
                                         {"no_verdict", &A::no_verdict, answers::nullWhereEmpty},
                                         {"materials", &A::materials},
                                         {"proposals", &A::proposals},
                                         {"passed", &A::passed}};
  return fields;
}

VerifyAnswer verifyAnswer(const VerifyFound& found) {
  VerifyAnswer answer;
  answer.underlay = found.underlay;
  answer.instrument = found.instrument->id;
  answer.wavelength_nm = found.instrument->wavelength_nm;
  answer.points = meetingRow(found.measured);
  answer.compared = found.comparison.used;
  answer.grazing = found.comparison.grazing;
  answer.saturated = found.comparison.saturated;
  if (found.placement) answer.placement = *found.placement;
  answer.scale = scaleRow(found.comparison);
  answer.no_verdict = found.comparison.no_verdict;
  for (const auto& m : found.comparison.materials) answer.materials.push_back(materialRow(found, m));
  for (const auto& p : found.comparison.proposals) answer.proposals.push_back(proposalRow(found, p));
  answer.passed = passedRows(found);
  return answer;
}

void tellVerified(const VerifyFound& found, Report& report) {
  const auto& c = found.comparison;
  if (!c.scale.db.empty())
    report.note(found.underlay,
                fmt::format("vendor scale: {}; explains {:.1f} % of range and incidence effects, to {:.2f} dB",
                            c.scale.describe() + (c.scale.range_compensated ? ", without range" : ""),
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

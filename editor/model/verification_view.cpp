// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/verification_view.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

using nlohmann::json;

std::string textOf(const json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }

std::vector<std::uint32_t> productsOf(const json& ids, const std::map<std::string, std::uint32_t>& by_id) {
  std::vector<std::uint32_t> products;
  for (const auto& id : ids)
    if (const auto found = by_id.find(id.get<std::string>()); found != by_id.end()) products.push_back(found->second);
  return products;
}

VerifiedMaterial materialFrom(const json& row, const std::map<std::string, std::uint32_t>& by_id) {
  VerifiedMaterial m;
  m.material = textOf(row.at("material"));
  const auto& off = row.at("off_db");
  m.off_db = {off.at("p5"), off.at("q1"), off.at("median"), off.at("q3"), off.at("p95")};
  m.points = row.at("points");
  m.judged = row.at("judged");
  m.agrees = row.at("agrees");
  m.products = productsOf(row.at("products"), by_id);
  return m;
}

VerifiedProposal proposalFrom(const json& row, const std::map<std::string, std::uint32_t>& by_id) {
  VerifiedProposal p;
  p.products = productsOf(row.at("products"), by_id);
  p.material = textOf(row.at("material"));
  p.behaves_like = row.at("behaves_like");
  p.alike = row.at("alike").get<std::vector<std::string>>();
  p.whole_material = row.at("whole_material");
  p.evidence = row.at("evidence");
  if (auto assign = FieldValue<std::vector<MaterialOverride>>::read(row.at("assign"))) p.assign = *std::move(assign);
  return p;
}

void fill(VerificationView& view, const Document& document) {
  const json& answer = document.verification->answer;
  std::map<std::string, std::uint32_t> by_id;
  const auto& products = document.environment()->products;
  for (std::uint32_t i = 0; i < products.size(); ++i) by_id.emplace(products[i].id, i);
  view.underlay = answer.at("underlay");
  view.instrument = answer.at("instrument");
  view.scale = textOf(answer.at("scale").at("reads"));
  view.no_verdict = textOf(answer.at("no_verdict"));
  if (answer.at("placement").is_object()) view.moved_m = answer.at("placement").at("moved_m");
  view.compared = answer.at("compared");
  for (const auto& row : answer.at("materials")) view.materials.push_back(materialFrom(row, by_id));
  for (const auto& row : answer.at("proposals")) view.proposals.push_back(proposalFrom(row, by_id));
  // What disagrees comes first, what cannot be judged last.
  std::stable_sort(view.materials.begin(), view.materials.end(), [](const auto& a, const auto& b) {
    const auto rank = [](const VerifiedMaterial& m) { return !m.judged ? 2 : m.agrees ? 1 : 0; };
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.points > b.points;
  });
  for (const auto& m : view.materials)
    if (m.judged)
      view.reach_db =
          std::clamp(std::ceil(std::max(std::abs(m.off_db[0]), std::abs(m.off_db[4]))), view.reach_db, 15.0);
}

}  // namespace

VerificationView verificationView(const Document& document) {
  VerificationView view;
  if (!document.verification || !document.imported) return view;
  try {
    fill(view, document);
    view.there = true;
    view.current = isCurrent(*document.verification, document);
  } catch (const json::exception&) {
    return {};  // a project.json that somebody edited
  }
  return view;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/verification_view.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

using ProductsById = std::map<std::string, std::uint32_t>;

std::vector<std::uint32_t> productsOf(const std::vector<std::string>& ids, const ProductsById& by_id) {
  std::vector<std::uint32_t> products;
  for (const auto& id : ids)
    if (const auto found = by_id.find(id); found != by_id.end()) products.push_back(found->second);
  return products;
}

VerifiedMaterial materialFrom(const VerifyMaterial& row, const ProductsById& by_id) {
  const auto& off = row.off_db;
  return {
      row.material.value_or(""),      row.points, {off.p5, off.q1, off.median, off.q3, off.p95}, row.judged, row.agrees,
      productsOf(row.products, by_id)};
}

VerifiedProposal proposalFrom(const VerifyProposal& row, const ProductsById& by_id) {
  return {row.material.value_or(""),
          row.behaves_like,
          row.alike,
          row.whole_material,
          row.evidence,
          overridesFrom(row.assign),
          productsOf(row.products, by_id)};
}

}  // namespace

VerificationView verificationView(const Document& document) {
  VerificationView view;
  if (!document.verification || !document.imported) return view;
  const auto& answer = document.verification->answer;
  ProductsById by_id;
  const auto& products = document.environment()->products;
  for (std::uint32_t i = 0; i < products.size(); ++i) by_id.emplace(products[i].id, i);
  view.there = true;
  view.current = isCurrent(*document.verification, document);
  view.underlay = answer.underlay;
  view.instrument = answer.instrument;
  view.scale = answer.scale.reads.value_or("");
  view.no_verdict = answer.no_verdict;
  if (answer.placement) view.moved_m = answer.placement->moved_m;
  view.compared = answer.compared;
  for (const auto& row : answer.materials) view.materials.push_back(materialFrom(row, by_id));
  for (const auto& row : answer.proposals) view.proposals.push_back(proposalFrom(row, by_id));
  // What disagrees comes first, what cannot be judged last.
  std::stable_sort(view.materials.begin(), view.materials.end(), [](const auto& a, const auto& b) {
    const auto rank = [](const VerifiedMaterial& m) { return !m.judged ? 2 : m.agrees ? 1 : 0; };
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.points > b.points;
  });
  for (const auto& m : view.materials)
    if (m.judged)
      view.reach_db =
          std::clamp(std::ceil(std::max(std::abs(m.off_db[0]), std::abs(m.off_db[4]))), view.reach_db, 15.0);
  return view;
}

}  // namespace standpoint

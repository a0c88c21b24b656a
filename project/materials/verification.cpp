// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/verification.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/random.h"
#include "materials/override_table.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

std::uint64_t mixed(const std::string& text, std::uint64_t hash) { return stableHash(text.c_str(), hash); }

std::uint64_t ofPlacement(const Document& document, const std::string& underlay) {
  std::uint64_t hash = stableHash(underlay.c_str());
  for (const auto& u : document.underlays)
    if (u->name == underlay) {
      const auto& q = u->file_from_cloud.rotation;
      const auto& t = u->file_from_cloud.translation;
      hash = mixed(fmt::format("{} {} {} {} {} {} {} {}", u->points, q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()),
                   hash);
    }
  return hash;
}

std::string faceText(const AssignedFaces& f, const std::string& material) {
  const auto text = [](const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); };
  return fmt::format("{} {} {} {} {}", f.product, f.surface, material, text(f.direction),
                     f.point ? text(*f.point) : "");
}

std::uint64_t basisOf(const Document& document, const std::string& underlay) {
  std::uint64_t hash = ofPlacement(document, underlay);
  if (!document.materials) return hash;
  const auto& assignment = document.materials->result.assignment;
  for (const auto& m : assignment.materials) hash = mixed(m.id, hash);
  for (const auto& s : assignment.surfaces)
    hash = mixed(fmt::format("{} {} {}", s.product, s.surface, s.material), hash);
  for (const auto& f : assignment.faces) hash = mixed(faceText(f, std::to_string(f.material)), hash);
  return hash;
}

// Materials by their ids: following a proposal can change their places.
std::uint64_t restOf(const Document& document, const VerifyAnswer& answer) {
  std::uint64_t hash = ofPlacement(document, answer.underlay);
  if (!document.materials) return hash;
  std::set<std::pair<std::uint32_t, std::uint32_t>> proposed;
  for (const auto& proposal : answer.proposals)
    for (const auto& pair : surfacesOf(proposal, document)) proposed.insert(pair);
  const auto& assignment = document.materials->result.assignment;
  const auto id = [&](std::int32_t m) {
    return m < 0 ? std::string() : assignment.materials[static_cast<std::size_t>(m)].id;
  };
  for (const auto& s : assignment.surfaces)
    if (!proposed.contains({s.product, s.surface}))
      hash = mixed(fmt::format("{} {} {}", s.product, s.surface, id(s.material)), hash);
  for (const auto& f : assignment.faces) hash = mixed(faceText(f, id(f.material)), hash);
  return hash;
}

}  // namespace

bool isCurrent(const Verification& verification, const Document& document) {
  return verification.basis == basisOf(document, verification.answer.underlay);
}

bool hasStandingProposals(const Verification& verification, const Document& document) {
  return !verification.answer.proposals.empty() && verification.rest == restOf(document, verification.answer);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> surfacesOf(const VerifyProposal& proposal,
                                                                const Document& document) {
  const Eigen::Vector3d shift_m = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  const auto overrides = overridesFrom(proposal.assign);
  OverrideTable table(*document.environment(), overrides, shift_m);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& s : document.materials->result.assignment.surfaces)
    if (table.of({s.product, s.surface, 0}).whole >= 0) pairs.emplace_back(s.product, s.surface);
  return pairs;
}

Verification verificationOf(const Document& document, VerifyAnswer answer) {
  return {basisOf(document, answer.underlay), restOf(document, answer), std::move(answer)};
}

}  // namespace standpoint

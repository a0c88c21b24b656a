// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/verification.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/random.h"
#include "materials/override_table.h"

namespace standpoint {

namespace {

using nlohmann::json;

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
std::uint64_t restOf(const Document& document, const json& answer) {
  std::uint64_t hash = ofPlacement(document, answer.at("underlay"));
  if (!document.materials) return hash;
  std::set<std::pair<std::uint32_t, std::uint32_t>> proposed;
  for (const auto& proposal : answer.at("proposals"))
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
  return verification.basis == basisOf(document, verification.answer.value("underlay", ""));
}

bool hasStandingProposals(const Verification& verification, const Document& document) {
  return !verification.answer.at("proposals").empty() && verification.rest == restOf(document, verification.answer);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> surfacesOf(const json& proposal, const Document& document) {
  std::vector<MaterialOverride> words;
  for (const auto& word : proposal.at("assign").get<std::vector<std::string>>()) {
    const auto equals = std::min(word.rfind('='), word.size());
    words.push_back({word.substr(0, equals), word.substr(std::min(equals + 1, word.size()))});
  }
  const Eigen::Vector3d shift_m = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  OverrideTable table(*document.environment(), words, shift_m);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& s : document.materials->result.assignment.surfaces)
    if (table.of({s.product, s.surface, 0}).whole >= 0) pairs.emplace_back(s.product, s.surface);
  return pairs;
}

Verification verificationOf(const Document& document, json answer) {
  Verification v;
  v.basis = basisOf(document, answer.at("underlay"));
  v.rest = restOf(document, answer);
  v.answer = std::move(answer);
  return v;
}

nlohmann::json verificationToJson(const Verification& verification) {
  return {{"basis", fmt::format("{:016x}", verification.basis)},
          {"rest", fmt::format("{:016x}", verification.rest)},
          {"answer", verification.answer}};
}

std::shared_ptr<const Verification> verificationFrom(const nlohmann::json& part) {
  Verification v;
  v.basis = std::strtoull(part.at("basis").get<std::string>().c_str(), nullptr, 16);
  v.rest = std::strtoull(part.value("rest", "").c_str(), nullptr, 16);  // an old project has none: compare again
  v.answer = part.at("answer");
  return std::make_shared<const Verification>(std::move(v));
}

}  // namespace standpoint

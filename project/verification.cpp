// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/verification.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/random.h"
#include "project/verify_answer.h"

namespace standpoint {

std::uint64_t verificationBasis(const Document& document, const std::string& underlay) {
  std::uint64_t hash = stableHash(underlay.c_str());
  const auto mix = [&](const std::string& text) { hash = stableHash(text.c_str(), hash); };
  for (const auto& u : document.underlays)
    if (u->name == underlay) {
      const auto& q = u->file_from_cloud.rotation;
      const auto& t = u->file_from_cloud.translation;
      mix(fmt::format("{} {} {} {} {} {} {} {}", u->points, q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()));
    }
  if (!document.materials) return hash;
  const auto& assignment = document.materials->result.assignment;
  for (const auto& m : assignment.materials) mix(m.id);
  for (const auto& s : assignment.surfaces) mix(fmt::format("{} {} {}", s.product, s.surface, s.material));
  for (const auto& f : assignment.faces) {
    mix(fmt::format("{} {} {} {} {} {}", f.product, f.surface, f.material, f.direction.x(), f.direction.y(), f.direction.z()));
    if (f.point) mix(fmt::format("{} {} {}", f.point->x(), f.point->y(), f.point->z()));
  }
  return hash;
}

bool isCurrent(const Verification& verification, const Document& document) {
  return verification.basis == verificationBasis(document, verification.answer.value("underlay", ""));
}

nlohmann::json verificationToJson(const Verification& verification) {
  return {{"basis", fmt::format("{:016x}", verification.basis)}, {"answer", verification.answer}};
}

std::shared_ptr<const Verification> verificationFrom(const nlohmann::json& part) {
  Verification v;
  v.basis = std::strtoull(part.at("basis").get<std::string>().c_str(), nullptr, 16);
  v.answer = part.at("answer");
  return std::make_shared<const Verification>(std::move(v));
}

}  // namespace standpoint

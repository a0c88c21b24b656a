// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/material_findings.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "materials/areas.h"
#include "materials/findings.h"
#include "project/materials/verification.h"

namespace standpoint {

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Others that do as well are offered behind the proposed one: the scan cannot tell them apart.
constexpr std::size_t kMostAlike = 3;

std::map<Pair, double> areas(const Environment& environment) {
  Progress progress;  // that nobody cancels
  const auto measured = measuredSurfaces(environment, progress);
  std::map<Pair, double> result;
  if (measured)
    for (const auto& s : *measured) result[{s.product, s.surface}] = s.area_m2;
  return result;
}

std::vector<Remedy> remediesOf(const VerifyProposal& proposal) {
  Remedy remedy;
  for (const auto& word : proposal.assign) {
    const auto selector = word.substr(0, word.rfind('='));
    if (remedy.selector.empty())
      remedy.selector = selector;
    else
      remedy.more.push_back(selector);
  }
  remedy.material = proposal.behaves_like;
  auto instead = proposal.alike;
  instead.resize(std::min(instead.size(), kMostAlike));
  instead.insert(instead.begin(), remedy.material);
  std::vector<Remedy> remedies;
  for (const auto& id : instead) {
    remedy.material = id;
    remedy.text = "Take " + id;
    remedies.push_back(remedy);
  }
  return remedies;
}

FindingCollector::Cause causeOf(const VerifyProposal& proposal, const std::string& underlay, const Product& first) {
  const auto assigned = proposal.material.value_or("");
  const auto& instead = proposal.behaves_like;
  const auto& alike = proposal.alike;
  FindingCollector::Cause c;
  c.kind = "measured-otherwise";
  c.warning = true;
  c.subject =
      fmt::format("{}\n{}\n{}\n{}", underlay, assigned, instead, first.global_id.empty() ? first.id : first.global_id);
  c.what = assigned.empty() ? std::string("no material assigned; measured:")
                            : fmt::format("measurements contradict '{}' on", assigned);
  c.then = fmt::format(": behaves like '{}'", instead);
  c.why = fmt::format("By the cloud '{}': {}.{}", underlay, proposal.evidence,
                      alike.empty() ? "" : fmt::format(" Equally good: {}.", fmt::join(alike, ", ")));
  c.remedies = remediesOf(proposal);
  return c;
}

// Of a proposal only the surfaces that still have the material that was measured otherwise.
std::vector<Pair> standing(const VerifyProposal& proposal, const Document& document) {
  const auto& assignment = document.materials->result.assignment;
  const auto pairs = surfacesOf(proposal, document);
  std::vector<Pair> result;
  for (const auto& s : assignment.surfaces) {
    const auto has =
        s.material < 0 ? std::nullopt : std::optional(assignment.materials[static_cast<std::size_t>(s.material)].id);
    if (has == proposal.material && std::binary_search(pairs.begin(), pairs.end(), Pair(s.product, s.surface)))
      result.emplace_back(s.product, s.surface);
  }
  return result;
}

std::vector<MaterialFinding> measuredOtherwise(const Document& document) {
  const auto& verification = *document.verification;
  if (!hasStandingProposals(verification, document)) return {};
  const auto& environment = *document.environment();
  const auto area_m2 = areas(environment);
  FindingCollector collector;
  for (const auto& proposal : verification.answer.proposals) {
    const auto pairs = standing(proposal, document);
    if (pairs.empty()) continue;
    auto& extent =
        collector.of(causeOf(proposal, verification.answer.underlay, environment.products[pairs.front().first]));
    for (const auto& pair : pairs) {
      const auto found = area_m2.find(pair);
      FindingCollector::add(extent, pair.first, found == area_m2.end() ? 0 : found->second);
    }
  }
  return collector.findings(environment, document.materials->accepted);
}

}  // namespace

std::vector<MaterialFinding> materialFindings(const Document& document) {
  if (!document.materials) return {};
  auto findings = document.materials->result.report.findings;
  if (!document.verification || !document.environment()) return findings;
  for (auto& f : measuredOtherwise(document)) findings.push_back(std::move(f));
  putInOrder(findings);
  return findings;
}

}  // namespace standpoint

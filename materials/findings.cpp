// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/findings.h"

#include <algorithm>

#include <fmt/format.h>

namespace standpoint {

namespace {

std::string called(const Product& product) {
  return (product.ifc_class.empty() ? "object" : product.ifc_class) + " '" + product.name + "'";
}

// FNV-1a: a short name for a text, the same on every machine.
std::uint32_t fingerprint(const std::vector<std::string>& texts) {
  std::uint32_t hash = 2166136261U;
  for (const auto& text : texts) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    hash = (hash ^ 0xFFU) * 16777619U;
  }
  return hash;
}

std::string causeOf(const FindingCollector::Cause& cause, const std::vector<std::uint32_t>& products,
                    const Environment& environment) {
  const auto stable = [](const std::string& by_id, const std::string& shown) { return by_id.empty() ? shown : by_id; };
  std::vector<std::string> texts{stable(cause.what_by_id, cause.what), stable(cause.then_by_id, cause.then)};
  std::vector<std::string> names;
  for (const auto p : products) {
    const auto& product = environment.products[p];
    names.push_back(product.global_id.empty() ? product.id : product.global_id);
  }
  std::sort(names.begin(), names.end());
  texts.insert(texts.end(), names.begin(), names.end());
  return fmt::format("{:08x}", fingerprint(texts));
}

}  // namespace

FindingCollector::Extent& FindingCollector::of(Cause cause) {
  auto& extent = extents_[{cause.kind, cause.subject}];
  if (extent.cause.kind.empty()) extent.cause = std::move(cause);
  return extent;
}

void FindingCollector::add(Extent& extent, std::uint32_t product, double area_m2) {
  if (extent.products.empty() || extent.products.back() != product) extent.products.push_back(product);
  extent.area_m2 += area_m2;
}

void FindingCollector::addAbout(Cause cause, std::string source) {
  auto& extent = extents_[{cause.kind, cause.subject}];
  extent.cause = std::move(cause);
  extent.source = std::move(source);
}

std::vector<MaterialFinding> FindingCollector::findings(const Environment& environment,
                                                        const std::vector<AcceptedFinding>& accepted) const {
  std::vector<MaterialFinding> result;
  for (const auto& [key, extent] : extents_) {
    const auto& cause = extent.cause;
    MaterialFinding finding;
    finding.severity = cause.warning ? "warning" : "note";
    finding.kind = cause.kind;
    finding.id = fmt::format("{}-{:08x}", cause.kind, fingerprint({cause.kind, cause.subject}));
    finding.why = cause.why;
    finding.area_m2 = extent.area_m2;
    finding.products = extent.products;
    std::sort(finding.products.begin(), finding.products.end());
    finding.products.erase(std::unique(finding.products.begin(), finding.products.end()), finding.products.end());
    finding.remedies = cause.remedies;
    finding.cause = causeOf(cause, finding.products, environment);
    finding.source = extent.source;
    finding.message = cause.what;
    if (!finding.products.empty()) {
      const auto& first = environment.products[finding.products.front()];
      finding.source = first.id;
      const auto more = finding.products.size() > 1 ? fmt::format(" and {} more", finding.products.size() - 1) : "";
      finding.message += fmt::format(" {}{}{} ({:.2f} m²)", called(first), more, cause.then, extent.area_m2);
    }
    for (const auto& seen : accepted)
      if (seen.finding == finding.id && seen.cause == finding.cause) finding.because = seen.because;
    result.push_back(std::move(finding));
  }
  putInOrder(result);
  return result;
}

void putInOrder(std::vector<MaterialFinding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const MaterialFinding& a, const MaterialFinding& b) {
    const auto order = [](const MaterialFinding& f) {
      return std::tuple(!f.because.empty(), f.severity != "warning", -f.area_m2);
    };
    return order(a) < order(b);
  });
}

std::vector<MaterialOverride> overridesBy(const Remedy& remedy, const std::string& material) {
  std::vector<MaterialOverride> overrides{{remedy.selector, material}};
  for (const auto& selector : remedy.more) overrides.push_back({selector, material});
  return overrides;
}

std::vector<std::string> assignWords(const Remedy& remedy, const std::string& material) {
  std::vector<std::string> words;
  for (const auto& o : overridesBy(remedy, material)) words.push_back(o.selector + "=" + o.material);
  return words;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/surfaces_seen.h"

#include <algorithm>
#include <map>

namespace standpoint {

namespace {

void count(SurfaceCoverage& surface, const SurfaceSample& sample, int times) {
  if (!sample.exposed) return;
  surface.exposed += 1;
  surface.seen += static_cast<std::uint64_t>(times > 0);
  surface.twice += static_cast<std::uint64_t>(times > 1);
}

std::vector<SurfaceCoverage> sorted(const std::map<std::string, SurfaceCoverage>& by_name) {
  std::vector<SurfaceCoverage> surfaces;
  for (const auto& [name, surface] : by_name)
    if (surface.exposed > 0) {
      surfaces.push_back(surface);
      surfaces.back().name = name;
    }
  return surfaces;
}

void countCoverage(SurfacesSeen& result, const SurfaceSamples& samples, const Environment& environment,
                   SeenByStation seen) {
  std::map<std::string, SurfaceCoverage> classes, storeys;
  std::vector<SurfaceCoverage> products(environment.products.size());
  for (std::size_t k = 0; k < samples.samples.size(); ++k) {
    const auto& sample = samples.samples[k];
    int times = 0;
    for (const auto* by : seen) times += (*by)[k];
    const auto& product = environment.products[sample.product];
    count(result.all, sample, times);
    count(classes[product.ifc_class], sample, times);
    count(storeys[product.storey], sample, times);
    count(products[sample.product], sample, times);
  }
  result.classes = sorted(classes);
  result.storeys = sorted(storeys);
  for (std::uint32_t p = 0; p < products.size(); ++p)
    if (products[p].seen < products[p].exposed) {
      products[p].product = p;
      products[p].name = environment.products[p].id;
      result.holes.push_back(products[p]);
    }
  std::stable_sort(result.holes.begin(), result.holes.end(),
                   [](const auto& a, const auto& b) { return a.exposed - a.seen > b.exposed - b.seen; });
}

void countPairs(SurfacesSeen& result, const SurfaceSamples& samples, SeenByStation seen) {
  const double each = samples.each_m2();
  for (const auto* by : seen)
    result.seen_m2.push_back(each * static_cast<double>(std::count(by->begin(), by->end(), 1)));
  for (std::size_t a = 0; a < seen.size(); ++a)
    for (std::size_t b = a + 1; b < seen.size(); ++b) {
      std::uint64_t common = 0;
      for (std::size_t k = 0; k < samples.samples.size(); ++k) common += (*seen[a])[k] & (*seen[b])[k];
      const double area = each * static_cast<double>(common);
      const auto fraction = [area](double of) { return of > 0 ? area / of : 0; };
      result.pairs.push_back({a, b, area, fraction(result.seen_m2[a]), fraction(result.seen_m2[b])});
    }
}

}  // namespace

SurfacesSeen countSeen(const SurfaceSamples& samples, const Environment& environment, SeenByStation seen) {
  SurfacesSeen result;
  countCoverage(result, samples, environment, seen);
  countPairs(result, samples, seen);
  return result;
}

}  // namespace standpoint

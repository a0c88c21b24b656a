// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/catalogue.h"

#include <algorithm>
#include <utility>

#include "core/data_folder.h"
#include "editor/labels/alphabetical.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "materials/materials.h"
#include "project/verb.h"

namespace standpoint {

const Catalogue& readCatalogue(Catalogue& catalogue) {
  if (catalogue.read) return catalogue;
  catalogue.read = true;
  const auto data = dataFolder();
  if (auto library = readMaterialLibrary(data / "materials" / "library"))
    catalogue.materials = std::move(*library);
  else
    catalogue.problem = trError(library.error());
  if (auto files = instrumentsWithFiles()) {
    for (auto& known : files->usable) catalogue.instruments.push_back(std::move(known.instrument));
    catalogue.broken = std::move(files->broken);
  } else {
    catalogue.problem += (catalogue.problem.empty() ? "" : "\n") + trError(files.error());
  }
  return catalogue;
}

const Instrument* instrumentIn(const Catalogue& catalogue, const std::string& id) {
  const auto found = std::find_if(catalogue.instruments.begin(), catalogue.instruments.end(),
                                  [&](const Instrument& i) { return i.id == id; });
  return found == catalogue.instruments.end() ? nullptr : &*found;
}

std::vector<const PhysicalMaterial*> byShownName(const std::vector<PhysicalMaterial>& materials) {
  std::vector<std::pair<std::string, const PhysicalMaterial*>> keyed;
  for (const auto& material : materials) keyed.emplace_back(alphabeticalKey(tr(material.label)), &material);
  std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const PhysicalMaterial*> sorted;
  for (const auto& [key, material] : keyed) sorted.push_back(material);
  return sorted;
}

const std::vector<PhysicalMaterial>& offeredMaterials(Catalogue& catalogue,
                                                      const std::shared_ptr<const MaterialChoice>& choice) {
  const auto& shipped = readCatalogue(catalogue).materials;
  if (!choice || choice->own.empty()) return shipped;
  if (catalogue.offered_for != choice) {
    catalogue.offered = withOwn(shipped, choice->own);
    catalogue.by_name = {};
  }
  catalogue.offered_for = choice;
  return catalogue.offered;
}

const std::vector<const PhysicalMaterial*>& offeredByName(Catalogue& catalogue,
                                                          const std::shared_ptr<const MaterialChoice>& choice) {
  const auto& offered = offeredMaterials(catalogue, choice);
  auto& by_name = catalogue.by_name;
  if (by_name.first != offered.data() || by_name.language != spoken())
    by_name = {byShownName(offered), offered.data(), std::string(spoken())};
  return by_name.sorted;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/physical_material.h"
#include "project/document.h"
#include "scanners/instruments/instrument.h"
#include "survey/instruments.h"

namespace standpoint {

// Read once from the program's data folder.
struct Catalogue {
  bool read = false;
  std::vector<PhysicalMaterial> materials;
  std::vector<Instrument> instruments;
  std::vector<BrokenInstrument> broken;               // of the user's own instruments
  std::string problem;                                // why something could not be read
  std::vector<PhysicalMaterial> offered;              // with the user's own in place of those that have their id …
  std::shared_ptr<const MaterialChoice> offered_for;  // … of this document
  struct {
    std::vector<const PhysicalMaterial*> sorted;
    const PhysicalMaterial* first = nullptr;  // of the materials that are sorted
    std::string language;                     // by whose names
  } by_name;
};

const Catalogue& readCatalogue(Catalogue& catalogue);
// Null where there is no such id.
const Instrument* instrumentIn(const Catalogue& catalogue, const std::string& id);
// All materials that can be assigned in a document: made anew only when its own have changed.
const std::vector<PhysicalMaterial>& offeredMaterials(Catalogue& catalogue,
                                                      const std::shared_ptr<const MaterialChoice>& choice);
// As people look for them: by the names that they have in the language of the editor.
std::vector<const PhysicalMaterial*> byShownName(const std::vector<PhysicalMaterial>& materials);
// Those that are offered, so: sorted anew only when they or the language have changed.
const std::vector<const PhysicalMaterial*>& offeredByName(Catalogue& catalogue,
                                                          const std::shared_ptr<const MaterialChoice>& choice);

}  // namespace standpoint

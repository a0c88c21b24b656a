// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/panel_states.h"

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
    catalogue.problem = describe(library.error());
  if (auto instruments = readInstruments(data / "scanners" / "instruments"))
    catalogue.instruments = std::move(*instruments);
  else
    catalogue.problem += (catalogue.problem.empty() ? "" : "\n") + describe(instruments.error());
  return catalogue;
}

}  // namespace standpoint

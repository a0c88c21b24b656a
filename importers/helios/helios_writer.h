// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// A scene for HELIOS++: the XML file, an OBJ and MTL of its name beside it, and spectra/<material>.txt, which HELIOS++
// finds when the folder is one of its --assets. `physical` has one entry for each surface, null where nothing is
// assigned. What HELIOS++ has no words for (panes, gloss, surfaces without a material) is told in the report.
Result<void> writeHeliosScene(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
                              const Georeference& georeference, const std::filesystem::path& file, Report& report,
                              Progress& progress);

}  // namespace standpoint

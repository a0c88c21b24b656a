// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

struct IfcSummary {
  std::string schema;  // "IFC4", or "IFC4X3_ADD2" where a class or the map conversion needs it
  std::size_t products = 0;
  std::size_t triangles = 0;  // placed
};

// The model as an IFC file: every tangible product and every space with its GlobalId, class, names, place in the
// spatial structure, type, materials, groups, properties with the types of their values, and its mesh as triangulated
// face sets; the georeference; the looks of surfaces. `physical` is empty, or has one entry for each surface, null
// where nothing is assigned. A model without a spatial structure (glTF, OBJ) gets a site and a building, and its
// storeys by name. What is left out (openings, grids, annotations, what the author excluded, images, colours of
// vertices) and what was changed (classes that the schema no longer has, GlobalIds that are not valid or there twice)
// is told. `name`: of the project where the model has none; `program`: "Standpoint 0.9.0".
Result<IfcSummary> writeIfc(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
                            const Georeference& georeference, const std::filesystem::path& file,
                            const std::string& name, const std::string& program, Report& report, Progress& progress);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "project/dataset/recipe.h"
#include "project/dataset/set_scans.h"
#include "project/survey/scan_preparation.h"

namespace standpoint {

// An environment of a recipe with the stations of all its places: those that a tripod can stand on.
struct SetEnvironment {
  Document document;                                // its job has the stations, and no others
  std::shared_ptr<const RayScene> scene;            // of its model alone
  std::vector<std::optional<std::size_t>> station;  // of each place in the environment's order: index into the job
  std::string picture;                              // environments/ID.svg, the same for every shard
  std::string described;                            // what environments/ID.json says, likewise
  std::vector<std::string> unmapped;                // IFC classes for which a map has no rule, as "map: class"
};

// Reads the model and finds the places; the same ones on any machine. A map of classes that no product has a rule in is
// an error, and a model without anything in its scene.
Result<SetEnvironment> openEnvironment(const Recipe& recipe, std::size_t index, Report& report, Progress& progress);

// The document with the materials of that axis' entry.
Result<Document> withMaterials(const Document& document, const RecipeMaterials& materials, Progress& progress);

}  // namespace standpoint

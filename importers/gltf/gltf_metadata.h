// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/environment.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// What a vertex, a triangle or an instance stands for: a row of a property table (EXT_structural_metadata).
struct GltfFeature {
  std::size_t table = 0, row = 0;
  auto operator<=>(const GltfFeature&) const = default;
};

// The first set of feature ids that names a property table and an attribute, of EXT_mesh_features or
// EXT_instance_features.
struct GltfFeatureIds {
  bool present = false;
  std::string attribute;  // "_FEATURE_ID_0"; empty: the element's own number
  std::size_t table = 0;
  std::optional<std::size_t> null;  // an id that stands for nothing
};
GltfFeatureIds featureIdsOf(GltfFile& file, const nlohmann::json& extension, const std::string& place);
template <class T>
GltfFeatureIds featureIdsOf(GltfFile& file, const T& object, const char* extension, const std::string& place) {
  return featureIdsOf(file, gltfExtension(object, extension), place + "/extensions/" + extension);
}

// The row of a property table as properties: the set is the class of the table, arrays are joined by commas.
void addFeature(GltfFile& file, const GltfFeature& feature, Product& product);

}  // namespace standpoint

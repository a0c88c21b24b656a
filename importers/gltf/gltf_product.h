// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// What an object of the file (a node, a mesh) says of itself in `extras` and in XMP packets, as properties.
void addGltfProperties(GltfFile& file, const nlohmann::json& extras, const nlohmann::json& extensions,
                       std::vector<Property>& properties);
template <class T>
void addGltfProperties(GltfFile& file, const T& object, std::vector<Property>& properties) {
  addGltfProperties(file, gltfExtras(object), gltfExtensions(object), properties);
}

// What each object of a product says, for programs that know no products: BLAINDER takes the property categoryID of the
// object that a beam meets for the point's class. An import of ours takes no notice of it.
nlohmann::json partExtras(const Product& product);
// A product as `extras` of a node that we export, in words that other programs show, and back.
nlohmann::json toExtras(const Product& product);
void restoreProduct(GltfFile& file, const nlohmann::json& extras, Product& product);

}  // namespace standpoint

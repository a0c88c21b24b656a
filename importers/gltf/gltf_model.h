// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// glTF as tinygltf models it, and the way between its values and JSON.

#include <string>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace standpoint {

// JSON for `extras` and extensions as tinygltf serialises it: a null inside is left out, a whole number beyond 32 bits
// becomes a double, text that is not UTF-8 gets replacement characters.
tinygltf::Value gltfValue(const nlohmann::json& json);

// A name that tinygltf can serialise: it throws at text that is not UTF-8.
std::string gltfName(const std::string& text);

// The member `key` of an object that gltfValue made, to add to.
tinygltf::Value& memberOf(tinygltf::Value& object, const char* key);

}  // namespace standpoint

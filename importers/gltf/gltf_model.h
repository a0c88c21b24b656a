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

// A member of `object`, or null. Never throws.
const nlohmann::json& memberOf(const nlohmann::json& object, const char* key);
const nlohmann::json& memberOf(const nlohmann::json&& object, const char* key) = delete;  // it would be gone

// `extras` and extensions of an object that was read, or null. From their text, which tinygltf keeps: its values drop
// what is null or empty, and have whole numbers of 32 bits only.
template <class T>
nlohmann::json gltfExtras(const T& object) {
  return object.extras_json_string.empty() ? nlohmann::json() : nlohmann::json::parse(object.extras_json_string);
}
template <class T>
nlohmann::json gltfExtensions(const T& object) {
  return object.extensions.empty() ? nlohmann::json() : nlohmann::json::parse(object.extensions_json_string);
}
template <class T>
nlohmann::json gltfExtension(const T& object, const char* name) {
  if (!object.extensions.contains(name)) return {};
  const auto all = gltfExtensions(object);
  return memberOf(all, name);
}

}  // namespace standpoint

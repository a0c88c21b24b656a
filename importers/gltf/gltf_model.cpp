// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_model.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace standpoint {

namespace {

using Json = nlohmann::json;

tinygltf::Value wholeNumber(const Json& json) {
  const auto fits = json.is_number_unsigned()
                        ? json.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()}
                        : std::in_range<int>(json.get<std::int64_t>());
  return fits ? tinygltf::Value(json.get<int>()) : tinygltf::Value(json.get<double>());
}

}  // namespace

std::string gltfName(const std::string& text) {
  if (std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; })) return text;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

tinygltf::Value gltfValue(const Json& json) {
  if (json.is_object()) {
    tinygltf::Value::Object members;
    for (const auto& [key, value] : json.items()) members[gltfName(key)] = gltfValue(value);
    return tinygltf::Value(std::move(members));
  }
  if (json.is_array()) {
    tinygltf::Value::Array elements;
    for (const auto& value : json) elements.push_back(gltfValue(value));
    return tinygltf::Value(std::move(elements));
  }
  if (json.is_string()) return tinygltf::Value(gltfName(json.get<std::string>()));
  if (json.is_boolean()) return tinygltf::Value(json.get<bool>());
  if (json.is_number_integer()) return wholeNumber(json);
  if (json.is_number()) return tinygltf::Value(json.get<double>());
  return {};
}

const Json& memberOf(const Json& object, const char* key) {
  static const Json kNothing;
  if (!object.is_object()) return kNothing;
  const auto found = object.find(key);
  return found == object.end() ? kNothing : *found;
}

tinygltf::Value& memberOf(tinygltf::Value& object, const char* key) {
  return object.Get<tinygltf::Value::Object>()[key];
}

}  // namespace standpoint

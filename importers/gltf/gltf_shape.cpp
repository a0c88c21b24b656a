// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_shape.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxInt = std::numeric_limits<int>::max();  // tinygltf's indices; what is beyond does not exist
constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

// What tinygltf makes of JSON that it keeps as values, in bytes; of other numbers it makes doubles.
std::size_t memoryOf(const Json& json, bool as_values) {
  std::size_t sum = as_values ? sizeof(tinygltf::Value) : sizeof(double);
  if (json.is_object())
    for (const auto& [key, value] : json.items())
      sum += memoryOf(value, as_values || key == "extras" || key == "extensions");
  if (json.is_array())
    for (const auto& value : json) sum += memoryOf(value, as_values);
  return sum;
}

struct ElementSize {
  const char* array;
  std::size_t bytes;
};
constexpr ElementSize kElements[] = {
    {"accessors", sizeof(tinygltf::Accessor)}, {"bufferViews", sizeof(tinygltf::BufferView)},
    {"images", sizeof(tinygltf::Image)},       {"materials", sizeof(tinygltf::Material)},
    {"meshes", sizeof(tinygltf::Mesh)},        {"nodes", sizeof(tinygltf::Node)},
    {"samplers", sizeof(tinygltf::Sampler)},   {"scenes", sizeof(tinygltf::Scene)},
    {"skins", sizeof(tinygltf::Skin)},         {"textures", sizeof(tinygltf::Texture)}};

bool isAccessorType(const Json& type) {
  static const std::set<std::string> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  return type.is_string() && kTypes.contains(type.get<std::string>());
}

bool isColour(const Json& factor) {
  return factor.is_array() && factor.size() == 3 &&
         std::all_of(factor.begin(), factor.end(), [](const Json& c) { return c.is_number(); });
}

void keepObject(Json& parent, const char* key) {
  if (!memberOf(parent, key).is_object()) parent.erase(key);
}

}  // namespace

void GltfShape::check() {
  const auto& scenes = memberOf(json_, "scenes");
  if (!scenes.is_null() && !scenes.is_array()) file_.fail("/scenes", "is not an array");
  for (const char* unread : {"animations", "cameras", "extras"}) json_.erase(unread);
  if (!affordable()) return;
  index(json_, "scene", "");
  for (const auto& element : kElements) array(element.array);
}

void GltfShape::putBack(tinygltf::Model& model) const {
  for (const auto& put : hidden_) put(model);
}

// A hundred bytes of JSON become a kilobyte: that counts as unpacking.
bool GltfShape::affordable() {
  std::size_t bytes = memoryOf(json_, false);
  for (const auto& element : kElements)
    if (const auto& list = memberOf(json_, element.array); list.is_array()) bytes += list.size() * element.bytes;
  return file_.spend(bytes, "");
}

void GltfShape::array(const char* name) {
  if (!memberOf(json_, name).is_array()) {
    json_.erase(name);
    return;
  }
  const std::string_view kind = name;
  auto& list = json_[name];
  for (std::size_t i = 0; i < list.size() && !file_.failed(); ++i) {
    const std::string place = "/" + std::string(name) + "/" + std::to_string(i);
    auto& element = list[i];
    if (!element.is_object()) return file_.fail(place, "is not an object");
    if (kind == "accessors") accessor(element, place);
    if (kind == "bufferViews") bufferView(element, i, place);
    if (kind == "images") image(element, i, place);
    if (kind == "materials") material(element, place);
    if (kind == "meshes") mesh(element, i, place);
    if (kind == "nodes") node(element, place);
    if (kind == "samplers")
      for (const char* key : {"wrapS", "wrapT"}) index(element, key, place);
    if (kind == "scenes") indices(element, "nodes", place);
    if (kind == "skins") {
      index(element, "inverseBindMatrices", place);
      if (memberOf(element, "joints").is_null()) element["joints"] = Json::array();
      indices(element, "joints", place);
    }
    if (kind == "textures")
      for (const char* key : {"source", "sampler"}) index(element, key, place);
  }
}

// "12.0", which some exporters write, becomes 12; a missing one stays missing.
void GltfShape::natural(Json& object, const char* key, const std::string& place, std::size_t most) {
  if (memberOf(object, key).is_null()) {
    object.erase(key);
    return;
  }
  object[key] = std::min(file_.natural(object, key, 0, place), most);
}

void GltfShape::index(Json& object, const char* key, const std::string& place) { natural(object, key, place, kMaxInt); }

void GltfShape::indices(Json& object, const char* key, const std::string& place) {
  if (memberOf(object, key).is_null()) {
    object.erase(key);
    return;
  }
  auto& list = object[key];
  if (!list.is_array()) return file_.fail(place + "/" + key, "is not an array");
  for (auto& element : list) {
    if (!element.is_number_unsigned()) return file_.fail(place + "/" + key, "contains an invalid index");
    element = std::min(element.get<std::size_t>(), kMaxInt);
  }
}

// Of an object whose every member is one.
void GltfShape::allIndices(Json& object, const std::string& place) {
  if (!object.is_object()) return file_.fail(place, "is not an object");
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  for (const auto& key : keys) index(object, key.c_str(), place);
}

void GltfShape::numbers(Json& object, const char* key, std::size_t count, const std::string& place) {
  if (file_.numbers(object, key, count, place).empty()) object.erase(key);
}

void GltfShape::weights(Json& object) {
  if (!memberOf(object, "weights").is_array()) {
    object.erase("weights");
    return;
  }
  for (auto& weight : object["weights"])
    if (!weight.is_number()) weight = 0;
}

void GltfShape::accessor(Json& accessor, const std::string& place) {
  index(accessor, "bufferView", place);
  for (const char* key : {"byteOffset", "componentType", "count"}) natural(accessor, key, place, kAnySize);
  for (const char* unread : {"min", "max"}) accessor.erase(unread);
  const auto type = file_.natural(accessor, "componentType", 0, place);
  const bool known = type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_DOUBLE;
  if (!known || !isAccessorType(memberOf(accessor, "type"))) {  // a fault where it is used, as any INT is
    accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_INT;
    accessor["type"] = "SCALAR";
  }
  if (!accessor.contains("count")) accessor["count"] = 0U;
  if (memberOf(accessor, "sparse").is_null())
    accessor.erase("sparse");
  else
    sparse(accessor["sparse"], place + "/sparse");
}

void GltfShape::sparse(Json& sparse, const std::string& place) {
  if (!memberOf(sparse, "indices").is_object() || !memberOf(sparse, "values").is_object())
    return file_.fail(place, "has no indices or no values");
  index(sparse, "count", place);
  if (!sparse.contains("count")) sparse["count"] = 0;
  auto& where = sparse["indices"];
  auto& what = sparse["values"];
  for (const char* key : {"bufferView", "byteOffset", "componentType"}) index(where, key, place + "/indices");
  for (const char* key : {"bufferView", "byteOffset"}) index(what, key, place + "/values");
  if (!where.contains("bufferView") || !what.contains("bufferView"))
    return file_.fail(place, "has no indices or no values");
  if (!where.contains("componentType")) where["componentType"] = 0;
}

void GltfShape::bufferView(Json& view, std::size_t number, const std::string& place) {
  index(view, "buffer", place);
  for (const char* key : {"byteOffset", "byteLength", "byteStride"}) natural(view, key, place, kAnySize);
  if (!view.contains("buffer")) view["buffer"] = -1;
  if (!view.contains("byteLength")) view["byteLength"] = 0U;
  const auto stride = file_.natural(view, "byteStride", 0, place);
  if (stride <= 252 && stride % 4 == 0) return;
  view.erase("byteStride");
  hidden_.emplace_back([=](tinygltf::Model& model) { model.bufferViews[number].byteStride = stride; });
}

// tinygltf would decode what lies in the file, and wants either a view or a uri.
void GltfShape::image(Json& image, std::size_t number, const std::string& place) {
  index(image, "bufferView", place);
  const auto view = file_.index(image, "bufferView", place);
  const auto uri = file_.text(image, "uri");
  image.erase("bufferView");
  image["uri"] = "hidden";
  hidden_.emplace_back([=](tinygltf::Model& model) {
    model.images[number].uri = uri;
    model.images[number].bufferView = view ? static_cast<int>(*view) : -1;
  });
}

void GltfShape::material(Json& material, const std::string& place) {
  if (!isColour(memberOf(material, "emissiveFactor"))) material.erase("emissiveFactor");
  keepObject(material, "pbrMetallicRoughness");
  if (!material.contains("pbrMetallicRoughness")) return;
  auto& pbr = material["pbrMetallicRoughness"];
  const std::string where = place + "/pbrMetallicRoughness";
  numbers(pbr, "baseColorFactor", 4, where);
  keepObject(pbr, "baseColorTexture");
  if (!pbr.contains("baseColorTexture")) return;
  for (const char* key : {"index", "texCoord"}) index(pbr["baseColorTexture"], key, where + "/baseColorTexture");
  if (!pbr["baseColorTexture"].contains("index")) file_.fail(where + "/baseColorTexture", "has no index of a texture");
}

void GltfShape::mesh(Json& mesh, std::size_t number, const std::string& place) {
  weights(mesh);
  if (!memberOf(mesh, "primitives").is_array()) return file_.fail(place + "/primitives", "is not an array");
  auto& primitives = mesh["primitives"];
  for (std::size_t i = 0; i < primitives.size() && !file_.failed(); ++i) {
    primitive(primitives[i], place + "/primitives/" + std::to_string(i));
    if (!file_.failed()) hideIndices(number, i, primitives[i]);
  }
}

void GltfShape::primitive(Json& primitive, const std::string& place) {
  if (!primitive.is_object()) return file_.fail(place, "is not an object");
  for (const char* key : {"indices", "material", "mode"}) index(primitive, key, place);
  if (memberOf(primitive, "attributes").is_null()) primitive["attributes"] = Json::object();
  allIndices(primitive["attributes"], place + "/attributes");
  auto targets = primitive.find("targets");
  if (targets == primitive.end() || !targets->is_array()) return;
  for (std::size_t i = 0; i < targets->size(); ++i) allIndices((*targets)[i], place + "/targets/" + std::to_string(i));
}

// tinygltf looks up the view of every index accessor, also of one that has none because it is sparse.
void GltfShape::hideIndices(std::size_t mesh, std::size_t number, Json& primitive) {
  if (!primitive.contains("indices")) return;
  const auto accessor = primitive["indices"].get<std::size_t>();
  const auto& accessors = memberOf(json_, "accessors");
  const auto& views = memberOf(json_, "bufferViews");
  if (accessors.is_array() && accessor < accessors.size()) {
    const auto& view = memberOf(accessors[accessor], "bufferView");
    if (view.is_number_unsigned() && views.is_array() && view.get<std::size_t>() < views.size()) return;
  }
  primitive.erase("indices");
  hidden_.emplace_back(
      [=](tinygltf::Model& model) { model.meshes[mesh].primitives[number].indices = static_cast<int>(accessor); });
}

void GltfShape::node(Json& node, const std::string& place) {
  for (const char* key : {"mesh", "skin"}) index(node, key, place);
  indices(node, "children", place);
  weights(node);
  numbers(node, "matrix", 16, place);
  numbers(node, "translation", 3, place);
  numbers(node, "rotation", 4, place);
  numbers(node, "scale", 3, place);
}

}  // namespace standpoint

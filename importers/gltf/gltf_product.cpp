// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_product.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

std::string asText(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// {"@list": […]}, {"@set": […]} and {"@value": …} are how JSON-LD wraps what a person would read.
const Json& unwrapped(const Json& value) {
  for (const char* key : {"@list", "@set", "@value"})
    if (const auto& inner = memberOf(value, key); !inner.is_null()) return inner;
  return value;
}

void addXmp(GltfFile& file, const Json& extensions, const char* extension, std::vector<Property>& properties) {
  const auto& packet = memberOf(memberOf(extensions, extension), "packet");
  const auto& packets = memberOf(memberOf(file.extensions(), extension), "packets");
  if (!packet.is_number_unsigned() || !packets.is_array() || packet.get<std::size_t>() >= packets.size()) return;
  const auto& chosen = packets[packet.get<std::size_t>()];
  if (!chosen.is_object()) return;
  for (const auto& [key, value] : chosen.items())
    if (!key.starts_with('@')) properties.push_back({extension, key, asText(unwrapped(value))});
}

void restoreTexts(const Json& list, std::vector<std::string>& texts) {
  texts.clear();
  for (const auto& text : list)
    if (text.is_string()) texts.push_back(text.get<std::string>());
}

}  // namespace

void addGltfProperties(GltfFile& file, const Json& extras, const Json& extensions, std::vector<Property>& properties) {
  if (extras.is_object()) {
    for (const auto& [key, value] : extras.items())
      if (key != "standpoint") properties.push_back({"", key, asText(value)});
  } else if (!extras.is_null()) {
    properties.push_back({"", "extras", asText(extras)});
  }
  addXmp(file, extensions, "KHR_xmp_json_ld", properties);
  addXmp(file, extensions, "KHR_xmp", properties);
}

Json partExtras(const Product& p) { return p.ifc_class.empty() ? Json::object() : Json{{"categoryID", p.ifc_class}}; }

Json toExtras(const Product& p) {
  Json extras = partExtras(p);
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) extras[key] = value;
  };
  add("id", p.id);
  add("global_id", p.global_id);
  add("ifc_class", p.ifc_class);
  add("predefined_type", p.predefined_type);
  add("type_name", p.type_name);
  add("storey", p.storey);
  if (!p.tangible) extras["tangible"] = false;
  if (!p.materials.empty()) extras["materials"] = p.materials;
  if (!p.groups.empty()) extras["groups"] = p.groups;
  for (const auto& layer : p.layers)
    extras["layers"].push_back({{"name", layer.name}, {"thickness_m", layer.thickness_m}});
  for (const auto& property : p.properties) {
    extras["properties"].push_back({{"set", property.set}, {"name", property.name}, {"value", property.value}});
    if (property.type != kNoPropertyType) extras["properties"].back()["type"] = keywordOf(property.type);
  }
  return extras;
}

void restoreProduct(GltfFile& file, const Json& extras, Product& p) {
  p.global_id = file.text(extras, "global_id");
  p.ifc_class = file.text(extras, "ifc_class");
  p.predefined_type = file.text(extras, "predefined_type");
  p.type_name = file.text(extras, "type_name");
  p.storey = file.text(extras, "storey");
  p.tangible = memberOf(extras, "tangible") != false;
  restoreTexts(memberOf(extras, "materials"), p.materials);
  restoreTexts(memberOf(extras, "groups"), p.groups);
  for (const auto& layer : memberOf(extras, "layers"))
    if (const auto& thickness = memberOf(layer, "thickness_m"); thickness.is_number())
      p.layers.push_back({file.text(layer, "name"), thickness.get<double>()});
  for (const auto& property : memberOf(extras, "properties"))
    p.properties.push_back({file.text(property, "set"), file.text(property, "name"), file.text(property, "value"),
                            propertyTypeOf(file.text(property, "type"))});
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_metadata.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string_view>

#include <nlohmann/json.hpp>

namespace standpoint {

namespace {

using Json = nlohmann::json;

struct Scalar {
  const char* name;
  std::size_t size;
  std::string (*text)(const std::uint8_t*);
};

template <class T>
std::string textOf(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return Json(value).dump();
}

constexpr std::array<Scalar, 10> kScalars = {{{"INT8", 1, textOf<std::int8_t>},
                                              {"UINT8", 1, textOf<std::uint8_t>},
                                              {"INT16", 2, textOf<std::int16_t>},
                                              {"UINT16", 2, textOf<std::uint16_t>},
                                              {"INT32", 4, textOf<std::int32_t>},
                                              {"UINT32", 4, textOf<std::uint32_t>},
                                              {"INT64", 8, textOf<std::int64_t>},
                                              {"UINT64", 8, textOf<std::uint64_t>},
                                              {"FLOAT32", 4, textOf<float>},
                                              {"FLOAT64", 8, textOf<double>}}};

const Scalar* scalar(const std::string& name) {
  const auto* it = std::find_if(kScalars.begin(), kScalars.end(), [&](const Scalar& s) { return s.name == name; });
  return it == kScalars.end() ? nullptr : it;
}

std::size_t componentsOf(const std::string& type) {
  if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' && type[3] <= '4')
    return static_cast<std::size_t>(type[3] - '0');
  if (type.size() == 4 && type.starts_with("MAT") && type[3] >= '2' && type[3] <= '4')
    return static_cast<std::size_t>((type[3] - '0') * (type[3] - '0'));
  return 1;
}

// One column of a property table.
class Column {
 public:
  Column(GltfFile& file, const Json& schema, const Json& definition, const Json& property, std::string place)
      : file_(file), schema_(schema), definition_(definition), property_(property), place_(std::move(place)) {}

  std::string at(std::size_t row) {
    const auto values = viewNamed("values");
    const std::string type = file_.text(definition_, "type");
    std::size_t first = row, count = 1;
    if (memberOf(definition_, "array") == true) {
      count = file_.natural(definition_, "count", 0, place_);
      first = row * count;
      if (count == 0) {
        first = offset("arrayOffsets", "arrayOffsetType", row);
        const auto end = offset("arrayOffsets", "arrayOffsetType", row + 1);
        count = end >= first ? end - first : 0;
      }
    }
    count = std::min<std::size_t>(count * componentsOf(type), 1000);  // as text for a person
    first *= componentsOf(type);
    std::string text;
    for (std::size_t i = first; i < first + count && !file_.failed(); ++i) {
      if (i > first) text += ", ";
      text += element(values, type, i);
    }
    return text;
  }

 private:
  std::span<const std::uint8_t> viewNamed(const char* key) {
    const auto view = file_.index(property_, key, place_);
    if (!view) file_.fail(place_, std::string("has no ") + key);
    return file_.failed() ? std::span<const std::uint8_t>{} : file_.view(*view, place_);
  }

  std::string element(std::span<const std::uint8_t> values, const std::string& type, std::size_t i) {
    if (type == "STRING") return string(values, i);
    if (type == "BOOLEAN") {
      if (i / 8 >= values.size()) return tooShort();
      return (values[i / 8] >> (i % 8) & 1U) != 0 ? "true" : "false";
    }
    const auto& enumeration = memberOf(memberOf(schema_, "enums"), file_.text(definition_, "enumType").c_str());
    std::string component = file_.text(definition_, "componentType");
    if (type == "ENUM")
      component = file_.text(enumeration, "valueType").empty() ? "UINT16" : file_.text(enumeration, "valueType");
    const Scalar* kind = scalar(component);
    if (kind == nullptr) return file_.fail(place_, "has a componentType that does not exist"), "";
    if (values.size() < kind->size || i > (values.size() - kind->size) / kind->size) return tooShort();
    const auto text = kind->text(values.data() + i * kind->size);
    return type == "ENUM" ? nameIn(enumeration, text) : text;
  }

  std::string nameIn(const Json& enumeration, const std::string& number) {
    for (const auto& value : memberOf(enumeration, "values"))
      if (memberOf(value, "value").is_number_integer() && memberOf(value, "value").dump() == number)
        return file_.text(value, "name");
    return number;
  }

  std::string string(std::span<const std::uint8_t> values, std::size_t i) {
    const auto from = offset("stringOffsets", "stringOffsetType", i),
               to = offset("stringOffsets", "stringOffsetType", i + 1);
    if (file_.failed() || from > to || to > values.size()) return tooShort();
    const Json text(
        std::string(reinterpret_cast<const char*>(values.data()) + from, std::min<std::size_t>(to - from, 10000)));
    return Json::parse(text.dump(-1, ' ', false, Json::error_handler_t::replace))
        .get<std::string>();  // the file may hold any bytes
  }

  std::size_t offset(const char* key, const char* type_key, std::size_t i) {
    const auto offsets = viewNamed(key);
    const std::string type = file_.text(property_, type_key);
    const std::size_t size = type == "UINT8" ? 1 : type == "UINT16" ? 2 : type == "UINT64" ? 8 : 4;
    if (file_.failed() || offsets.size() < size || i > (offsets.size() - size) / size) return tooShort(), 0;
    std::uint64_t value = 0;
    std::memcpy(&value, offsets.data() + i * size, size);
    return value;
  }

  std::string tooShort() {
    file_.fail(place_, "its buffer views are smaller than the table");
    return {};
  }

  GltfFile& file_;
  const Json& schema_;
  const Json& definition_;
  const Json& property_;
  std::string place_;
};

bool isName(const std::string& key, std::string_view name) {
  return std::equal(key.begin(), key.end(), name.begin(), name.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

}  // namespace

GltfFeatureIds featureIdsOf(GltfFile& file, const Json& extension, const std::string& place) {
  GltfFeatureIds result;
  const auto& sets = memberOf(extension, "featureIds");
  for (std::size_t i = 0; sets.is_array() && i < sets.size() && !result.present; ++i) {
    const std::string where = place + "/featureIds/" + std::to_string(i);
    const auto table = file.index(sets[i], "propertyTable", where);
    const auto attribute = file.index(sets[i], "attribute", where);
    if (!table || memberOf(sets[i], "texture").is_object()) continue;
    result = {true, attribute ? "_FEATURE_ID_" + std::to_string(*attribute) : "", *table,
              file.index(sets[i], "nullFeatureId", where)};
  }
  return result;
}

void addFeature(GltfFile& file, const GltfFeature& feature, Product& product) {
  const auto& metadata = memberOf(file.extensions(), "EXT_structural_metadata");
  const auto& tables = memberOf(metadata, "propertyTables");
  const std::string place = "/extensions/EXT_structural_metadata/propertyTables/" + std::to_string(feature.table);
  if (!tables.is_array() || feature.table >= tables.size()) return file.fail(place, "does not exist");
  const auto& table = tables[feature.table];
  if (feature.row >= file.natural(table, "count", 0, place))
    return file.fail(place, "has no row " + std::to_string(feature.row) + ", which a feature id refers to");
  const auto& schema = memberOf(metadata, "schema");
  const std::string set = file.text(table, "class");
  const auto& definitions = memberOf(memberOf(memberOf(schema, "classes"), set.c_str()), "properties");
  const auto& properties = memberOf(table, "properties");
  if (!properties.is_object() || !definitions.is_object()) return;
  for (const auto& [key, value] : properties.items()) {
    const auto& definition = memberOf(definitions, key.c_str());
    const std::string text = Column(file, schema, definition, value, place + "/properties/" + key).at(feature.row);
    if (file.failed() || !file.spend(text.size() + key.size(), place)) return;
    const std::string semantic = file.text(definition, "semantic");
    if (product.name.empty() && (semantic == "NAME" || isName(key, "name"))) product.name = text;
    if (product.global_id.empty() && isName(key, "globalid")) product.global_id = text;
    product.properties.push_back({set, key, text});
  }
}

}  // namespace standpoint

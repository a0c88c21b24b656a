// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/class_map.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {
namespace {

using nlohmann::json;

class MapReader {
 public:
  explicit MapReader(std::string file) : fault_(std::move(file)) {}
  Result<ClassMap> read(const json& content);

 private:
  std::size_t classNamed(const json& value, const std::string& pointer);
  void takeClasses(JsonFields& root);
  void takeRules(JsonFields& root);

  JsonFault fault_;
  ClassMap map_;
};

std::size_t MapReader::classNamed(const json& value, const std::string& pointer) {
  for (std::size_t i = 0; i < map_.classes.size(); ++i)
    if (value == map_.classes[i].name) return i;
  if (value.is_string())
    fault_.say(pointer, "'" + value.get<std::string>() + "' is not one of the classes");
  else
    fault_.needs(pointer, value, "the name of a class");
  return 0;
}

void MapReader::takeClasses(JsonFields& root) {
  root.required("classes");
  root.each("classes", [&](const std::string& name, const json& id, const std::string& pointer) {
    if (!id.is_number_unsigned() || id.get<std::uint64_t>() > 65535)
      return fault_.needs(pointer, id, "an id from 0 to 65535");
    map_.classes.push_back({name, id.get<std::uint32_t>()});
  });
  if (map_.classes.empty()) root.wrong("classes", "must be an object of names and ids");
  std::stable_sort(map_.classes.begin(), map_.classes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

void MapReader::takeRules(JsonFields& root) {
  root.required("ifc");
  root.each("ifc", [&](const std::string& ifc_class, const json& value, const std::string& pointer) {
    const bool pair = value.is_array() && value.size() == 2;
    map_.rules.push_back(
        {ifc_class, {classNamed(pair ? value[0] : value, pointer), classNamed(pair ? value[1] : value, pointer)}});
  });
}

Result<ClassMap> MapReader::read(const json& content) {
  JsonFields root(fault_, content, "");
  map_.name = root.text("name");
  root.skip("source");
  takeClasses(root);
  for (const auto& [key, member] : {std::pair("unknown", &ClassMap::unknown), std::pair("noise", &ClassMap::noise)})
    if (const auto* name = root.required(key)) map_.*member = classNamed(*name, root.pointer(key));
  takeRules(root);
  root.close();
  TRY(fault_.result());
  return map_;
}

}  // namespace

std::array<std::size_t, 2> ClassMap::classesOf(std::string_view ifc_class) const {
  const Rule* best = nullptr;
  for (const Rule& rule : rules)
    if (ifc_class.starts_with(rule.ifc_class) && (!best || best->ifc_class.size() < rule.ifc_class.size()))
      best = &rule;
  return best ? best->of_point : std::array<std::size_t, 2>{unknown, unknown};
}

Result<ClassMap> readClassMap(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto content, readJsonFile(file));
  return MapReader(file.filename().string()).read(content);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/class_map.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/json_file.h"

namespace standpoint {
namespace {

using nlohmann::json;

class MapReader {
 public:
  explicit MapReader(std::string file) : root_{std::move(file), {}} {}
  Result<ClassMap> read(const json& content);

 private:
  Result<std::size_t> classNamed(const json& value, const JsonPlace& at) const;
  Result<void> takeClasses(const json& classes, const JsonPlace& at);
  Result<void> takeRules(const json& rules, const JsonPlace& at);

  JsonPlace root_;
  ClassMap map_;
};

Result<std::size_t> MapReader::classNamed(const json& value, const JsonPlace& at) const {
  if (!value.is_string()) return at.unusable("must be the name of a class");
  const auto name = value.get<std::string>();
  for (std::size_t i = 0; i < map_.classes.size(); ++i)
    if (map_.classes[i].name == name) return i;
  return at.unusable("'" + name + "' is not one of the classes");
}

Result<void> MapReader::takeClasses(const json& classes, const JsonPlace& at) {
  if (!classes.is_object() || classes.empty()) return at.unusable("must be an object of names and ids");
  for (const auto& [name, id] : classes.items()) {
    if (!id.is_number_unsigned() || id.get<std::uint64_t>() > 65535)
      return (at / name).unusable("must be an id from 0 to 65535");
    map_.classes.push_back({name, id.get<std::uint32_t>()});
  }
  std::stable_sort(map_.classes.begin(), map_.classes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return {};
}

Result<void> MapReader::takeRules(const json& rules, const JsonPlace& at) {
  if (!rules.is_object()) return at.unusable("must be an object of IFC classes");
  for (const auto& [ifc_class, value] : rules.items()) {
    const auto place = at / ifc_class;
    const bool pair = value.is_array() && value.size() == 2;
    TRY_ASSIGN(const auto below, classNamed(pair ? value[0] : value, place));
    TRY_ASSIGN(const auto above, classNamed(pair ? value[1] : value, place));
    map_.rules.push_back({ifc_class, {below, above}});
  }
  return {};
}

Result<ClassMap> MapReader::read(const json& content) {
  TRY(checkKeys(content, root_, {"name", "source", "unknown", "noise", "classes", "ifc"}));
  for (const char* key : {"name", "unknown", "noise", "classes", "ifc"})
    if (!content.contains(key)) return (root_ / key).unusable("is missing");
  TRY_ASSIGN(auto name, readText(content, root_, "name"));
  map_.name = std::move(name);
  TRY(takeClasses(content["classes"], root_ / "classes"));
  for (const auto& [key, member] : {std::pair("unknown", &ClassMap::unknown), std::pair("noise", &ClassMap::noise)}) {
    TRY_ASSIGN(const auto found, classNamed(content[key], root_ / key));
    map_.*member = found;
  }
  TRY(takeRules(content["ifc"], root_ / "ifc"));
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

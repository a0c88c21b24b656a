// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/class_map.h"

#include <algorithm>
#include <fstream>
#include <optional>

#include <nlohmann/json.hpp>

namespace standpoint {
namespace {

using nlohmann::json;

class MapReader {
 public:
  explicit MapReader(std::filesystem::path file) : file_(std::move(file)) {}
  Result<ClassMap> read(const json& root);

 private:
  tl::unexpected<Error> broken(const std::string& place, const std::string& what) const {
    return failure(ErrorKind::unusable, what, file_.string() + " /" + place);
  }
  Result<std::size_t> classNamed(const json& value, const std::string& place) const;
  Result<void> takeClasses(const json& classes);
  Result<void> takeRules(const json& rules);

  std::filesystem::path file_;
  ClassMap map_;
};

Result<std::size_t> MapReader::classNamed(const json& value, const std::string& place) const {
  if (!value.is_string()) return broken(place, "must be the name of a class");
  const auto name = value.get<std::string>();
  for (std::size_t i = 0; i < map_.classes.size(); ++i)
    if (map_.classes[i].name == name) return i;
  return broken(place, "'" + name + "' is not one of the classes");
}

Result<void> MapReader::takeClasses(const json& classes) {
  if (!classes.is_object() || classes.empty()) return broken("classes", "must be an object of names and ids");
  for (const auto& [name, id] : classes.items()) {
    if (!id.is_number_unsigned() || id.get<std::uint64_t>() > 65535)
      return broken("classes/" + name, "must be an id from 0 to 65535");
    map_.classes.push_back({name, id.get<std::uint32_t>()});
  }
  std::stable_sort(map_.classes.begin(), map_.classes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return {};
}

Result<void> MapReader::takeRules(const json& rules) {
  if (!rules.is_object()) return broken("ifc", "must be an object of IFC classes");
  for (const auto& [ifc_class, value] : rules.items()) {
    const std::string place = "ifc/" + ifc_class;
    const bool pair = value.is_array() && value.size() == 2;
    TRY_ASSIGN(const auto below, classNamed(pair ? value[0] : value, place));
    TRY_ASSIGN(const auto above, classNamed(pair ? value[1] : value, place));
    map_.rules.push_back({ifc_class, {below, above}});
  }
  return {};
}

Result<ClassMap> MapReader::read(const json& root) {
  if (!root.is_object()) return broken("", "a class map must be an object");
  for (const auto& [key, value] : root.items())
    if (key != "name" && key != "source" && key != "unknown" && key != "noise" && key != "classes" && key != "ifc")
      return broken(key, "unknown key");
  for (const char* key : {"name", "unknown", "noise", "classes", "ifc"})
    if (!root.contains(key)) return broken(key, "is missing");
  if (!root["name"].is_string()) return broken("name", "must be a text");
  map_.name = root["name"].get<std::string>();
  TRY(takeClasses(root["classes"]));
  for (const auto& [key, member] : {std::pair("unknown", &ClassMap::unknown), std::pair("noise", &ClassMap::noise)}) {
    TRY_ASSIGN(const auto found, classNamed(root[key], key));
    map_.*member = found;
  }
  TRY(takeRules(root["ifc"]));
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
  std::ifstream in(file);
  if (!in) return failure(ErrorKind::file_system, "cannot read the file", file.string());
  try {
    return MapReader(file).read(json::parse(in));
  } catch (const json::exception& e) {
    return failure(ErrorKind::unusable, e.what(), file.string());
  }
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/class_map.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {
namespace {

using nlohmann::json;

std::filesystem::path shippedFolder() { return dataFolder() / "pointclouds" / "classes"; }

class MapReader {
 public:
  explicit MapReader(std::string file) : fault_(std::move(file)) {}
  Result<ClassMap> read(const json& content);

 private:
  std::size_t classNamed(const json& value, const std::string& pointer);
  void takeClasses(JsonFields& root);
  void takeIgnored(JsonFields& root);
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
    map_.classes.push_back({name, id.get<std::uint32_t>(), false});
  });
  if (map_.classes.empty()) root.wrong("classes", "must be an object of names and ids");
  std::stable_sort(map_.classes.begin(), map_.classes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
}

void MapReader::takeIgnored(JsonFields& root) {
  const auto* names = root.raw("ignore");
  if (names == nullptr) return;
  if (!names->is_array()) return root.needs("ignore", *names, "a list of classes");
  for (std::size_t i = 0; i < names->size(); ++i)
    map_.classes[classNamed((*names)[i], root.pointer("ignore") + "/" + std::to_string(i))].ignored = true;
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
  takeIgnored(root);
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

bool ClassMap::hasRuleFor(std::string_view ifc_class) const {
  return std::any_of(rules.begin(), rules.end(), [&](const Rule& r) { return ifc_class.starts_with(r.ifc_class); });
}

std::optional<std::size_t> ClassMap::withId(std::uint32_t id) const {
  for (std::size_t k = 0; k < classes.size(); ++k)
    if (classes[k].id == id) return k;
  return std::nullopt;
}

PointClasses::PointClasses(const ClassMap& map, const ScanHeader& header) : map_(map), has_truth_(header.has_truth) {
  for (const auto& product : header.products) class_of_product_.push_back(map.classesOf(product.ifc_class));
}

std::vector<std::string> shippedClassMaps() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(shippedFolder(), error))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path shippedClassMap(const std::string& name) { return shippedFolder() / (name + ".json"); }

Result<ClassMap> classMapNamed(const std::string& name_or_file) {
  const std::filesystem::path file(name_or_file);
  if (file.extension() == ".json") return readClassMap(file);
  const auto names = shippedClassMaps();
  if (std::find(names.begin(), names.end(), name_or_file) == names.end()) {
    std::string all;
    for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
    return failure(ErrorKind::usage,
                   "unknown classes '" + name_or_file + "'; available: " + all + ", or a file that ends in .json");
  }
  return readClassMap(shippedClassMap(name_or_file));
}

Result<ClassMap> readClassMap(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto content, readJsonFile(file));
  return MapReader(file.filename().string()).read(content);
}

}  // namespace standpoint

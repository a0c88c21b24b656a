// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "materials/library_entry.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

struct LibraryFile {
  std::string name;
  nlohmann::json content;
};
struct Entry {
  PhysicalMaterial material;
  JsonPlace at;
};
using EntryTable = std::map<std::string, Entry, std::less<>>;

Result<std::vector<std::filesystem::path>> jsonFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code code;
  for (auto entry = std::filesystem::directory_iterator(folder, code);
       !code && entry != std::filesystem::directory_iterator(); entry.increment(code))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  if (code) return failure(ErrorKind::file_system, "cannot be read: " + code.message(), folder.string());
  if (files.empty()) return failure(ErrorKind::unusable, "contains no material library (*.json)", folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

Result<LibraryFile> readFile(const std::filesystem::path& path) {
  TRY_ASSIGN(auto content, readJsonFile(path));
  LibraryFile file{path.filename().string(), std::move(content)};
  JsonFault fault(file.name);
  JsonFields root(fault, file.content, "");
  for (const char* key : {"sources", "materials"})
    if (const auto* list = root.raw(key); list != nullptr && !list->is_array()) root.needs(key, *list, "a list");
  root.close();
  TRY(fault.result());
  return file;
}

Result<void> readSources(const LibraryFile& file, SourceTable& sources) {
  JsonFault fault(file.name);
  JsonFields(fault, file.content, "").list("sources", [&](JsonFields& f) {
    const auto id = readId(f);
    FigureSource source{f.text("text"), f.text("licence")};
    if (!sources.try_emplace(id, std::move(source)).second) f.wrong("id", "the source '" + id + "' already exists");
  });
  return fault.result();
}

Result<void> readMaterials(const LibraryFile& file, const SourceTable& sources, EntryTable& entries) {
  if (!file.content.contains("materials")) return {};
  const auto& list = file.content["materials"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto at = JsonPlace{file.name, {}} / "materials" / i;
    JsonFault fault(at.file);
    JsonFields fields(fault, list[i], at.pointer);
    TRY_ASSIGN(auto material, readMaterial(fields, sources));
    const auto id = material.id;
    const auto [place, is_new] = entries.try_emplace(id, Entry{std::move(material), at});
    if (!is_new)
      return (at / "id").unusable("'" + id + "' is already defined in " + place->second.at.file + " " +
                                  place->second.at.pointer);
  }
  return {};
}

// Own materials may be the wet state of a shipped one.
Result<std::vector<PhysicalMaterial>> finished(const EntryTable& entries,
                                               const std::vector<PhysicalMaterial>& shipped) {
  std::map<std::string, PhysicalMaterial, std::less<>> dry;
  for (const auto& material : shipped) dry.insert_or_assign(material.id, material);
  for (const auto& [id, entry] : entries) dry.insert_or_assign(id, entry.material);
  std::vector<PhysicalMaterial> library;
  for (const auto& [id, read] : entries) {
    Entry entry = read;
    if (!entry.material.wet_of.empty()) {
      const auto found = dry.find(entry.material.wet_of);
      TRY(wet(entry.material, found == dry.end() ? nullptr : &found->second, entry.at));
    }
    library.push_back(std::move(entry.material));
  }
  return library;
}

Result<std::vector<LibraryFile>> readFiles(const std::vector<std::filesystem::path>& paths) {
  std::vector<LibraryFile> files;
  for (const auto& path : paths) {
    TRY_ASSIGN(auto file, readFile(path));
    files.push_back(std::move(file));
  }
  return files;
}

Result<std::vector<LibraryFile>> readFolder(const std::filesystem::path& folder) {
  TRY_ASSIGN(const auto paths, jsonFiles(folder));
  return readFiles(paths);
}

}  // namespace

Result<std::vector<PhysicalMaterial>> readMaterialLibrary(const std::filesystem::path& folder) {
  TRY_ASSIGN(const auto files, readFolder(folder));
  SourceTable sources;
  for (const auto& file : files) TRY(readSources(file, sources));
  EntryTable entries;
  for (const auto& file : files) TRY(readMaterials(file, sources, entries));
  return finished(entries, {});
}

Result<std::vector<PhysicalMaterial>> readOwnMaterials(const std::filesystem::path& file,
                                                       const std::filesystem::path& shipped_folder) {
  TRY_ASSIGN(const auto shipped, readMaterialLibrary(shipped_folder));
  TRY_ASSIGN(const auto shipped_files, readFolder(shipped_folder));
  TRY_ASSIGN(const auto own, readFile(file));
  SourceTable sources;
  for (const auto& each : shipped_files) TRY(readSources(each, sources));
  TRY(readSources(own, sources));
  EntryTable entries;
  TRY(readMaterials(own, sources, entries));
  if (entries.empty()) return JsonPlace{own.name, {}}.unusable("contains no material");
  return finished(entries, shipped);
}

std::vector<PhysicalMaterial> withOwn(std::vector<PhysicalMaterial> library, const std::vector<PhysicalMaterial>& own) {
  const auto before = [](const PhysicalMaterial& a, const PhysicalMaterial& b) { return a.id < b.id; };
  for (const auto& material : own) {
    const auto place = std::lower_bound(library.begin(), library.end(), material, before);
    if (place != library.end() && place->id == material.id)
      *place = material;
    else
      library.insert(place, material);
  }
  return library;
}

std::vector<std::string> gapsOf(const PhysicalMaterial& material) {
  auto gaps = material.gaps;
  if (isGap(material)) return gaps;
  if (material.variation == 0) gaps.push_back("How much one piece of this material differs from another is not known");
  if (material.texture_scale_m == 0) gaps.push_back("The size of this material's texture is not known");
  return gaps;
}

}  // namespace standpoint

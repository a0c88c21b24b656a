// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/project_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/part_file.h"
#include "importers/gltf/gltf_writer.h"
#include "project/materials/verification_json.h"
#include "project/model/bookmarks.h"
#include "project/storage/project_json.h"
#include "project/storage/project_lock.h"
#include "project/survey/file_places.h"
#include "project/survey/measure_verb.h"
#include "project/survey/underlays.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kProjectFile = "project.json";
constexpr int kMostAttempts = 20;                          // to read a project that others replace meanwhile
constexpr auto kReplace = json::error_handler_t::replace;  // of a name that is not UTF-8 the bytes that are wrong

Result<std::string> readText(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return failure(ErrorKind::file_system, fmt::format("cannot read the file ({})", std::strerror(errno)),
                   file.string());
  return std::string(std::istreambuf_iterator<char>(in), {});
}

Result<json> jsonFrom(const std::string& text, const fs::path& file) {
  json value = json::parse(text, nullptr, false);
  if (value.is_discarded())
    return failure(ErrorKind::unusable, "invalid JSON: the file is damaged or not a Standpoint project", file.string());
  return value;
}

Result<json> readJson(const fs::path& file) {
  TRY_ASSIGN(const auto text, readText(file));
  return jsonFrom(text, file);
}

Result<std::uint64_t> hashOf(PartFile& file) {
  std::string text(file.size(), '\0');
  TRY(file.read(0, std::span(reinterpret_cast<std::uint8_t*>(text.data()), text.size())));
  return contentHash(text);
}

bool holds(const fs::path& file, std::uintmax_t size, std::uint64_t hash) {
  std::error_code error;
  if (fs::file_size(file, error) != size || error) return false;
  const auto text = readText(file);
  return text && contentHash(*text) == hash;
}

// Parts are stored under the name of their content, so an unchanged part is not written again and an old project.json
// keeps pointing at its own parts until the new one replaces it.
Result<std::string> storeUnderContentName(PartFile part, const std::string& stem) {
  TRY_ASSIGN(const auto hash, hashOf(part));
  auto name = fmt::format("{}-{:016x}{}", stem, hash, part.file().extension().string());
  if (!holds(part.file().parent_path() / name, part.size(), hash)) TRY(part.commitAs(name));
  return name;
}

Result<std::string> storeEnvironment(const Environment& environment, const Georeference& georeference,
                                     const fs::path& geometry, const std::string& stem, Progress& progress) {
  TRY_ASSIGN(auto part, PartFile::create(geometry / (stem + ".glb")));
  TRY(writeEnvironmentGlb(environment, georeference, part, progress));
  return storeUnderContentName(std::move(part), stem);
}

Result<std::string> storeJson(const json& value, const fs::path& geometry, const std::string& stem) {
  TRY_ASSIGN(auto part, PartFile::create(geometry / (stem + ".json")));
  TRY(part.append(value.dump(-1, ' ', false, kReplace)));
  return storeUnderContentName(std::move(part), stem);
}

// What a save of ours puts into geometry/, whole or not.
bool isOurs(const std::string& name) {
  return name.rfind("imported-", 0) == 0 || name.rfind("products-", 0) == 0 || name.rfind("light-", 0) == 0 ||
         name.rfind("collision-", 0) == 0 || isPart(name);
}

// Only what an earlier save of ours left and no project.json names any more.
void removeUnreferenced(const fs::path& geometry, const std::set<std::string>& named) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(geometry, ignored)) {
    const auto name = entry.path().filename().string();
    if (isOurs(name) && !named.contains(name)) fs::remove(entry.path(), ignored);
  }
}

// Files in geometry/; empty: to be written.
struct PartNames {
  std::string products, imported, light, collision;
};

// Of those that the folder names the ones that hold what the document has, as `before` is what was saved there.
PartNames sharedParts(const Document& before, const Document& document, const fs::path& folder) {
  PartNames names;
  if (!before.imported || before.georeference != document.georeference) return names;
  const auto project = readJson(folder / kProjectFile);
  const auto named = [&](const json& at, const char* key) {
    std::error_code ignored;
    const auto name = at.is_object() ? at.value(key, json()) : json();
    if (!name.is_string() || !fs::exists(folder / "geometry" / name.get<std::string>(), ignored)) return std::string();
    return name.get<std::string>();
  };
  if (!project || !project->is_object()) return names;
  if (before.imported == document.imported) {
    names.products = named(*project, "products");
    names.imported = named(*project, "imported");
  }
  if (document.simplified && before.simplified && before.simplified->environment == document.simplified->environment)
    names.light = named(project->value("lightening", json()), "geometry");
  if (document.collision && before.collision == document.collision)
    names.collision = named(project->value("collision", json()), "geometry");
  return names;
}

Result<Environment> loadEnvironment(const fs::path& file, const Environment& records, Progress& progress) {
  auto environment = readEnvironmentGlb(file, progress);
  if (!environment) return environment;
  environment->products = records.products;
  environment->spatial = records.spatial;
  if (auto wrong = validate(*environment); !wrong.empty())
    return failure(ErrorKind::unusable, wrong + ": the file is damaged", file.string());
  return environment;
}

Result<fs::path> partOf(const fs::path& geometry, const json& name) {
  const auto file = geometry / name.get<std::string>();
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return failure(ErrorKind::file_system, "a part of the project is missing: put it back from a copy of the project",
                   file.string());
  return file;
}

Result<Document> fromJson(const json& project, const fs::path& folder, Report& report, Progress& progress) {
  const auto geometry = folder / "geometry";
  TRY_ASSIGN(const auto records_file, partOf(geometry, project.at("products")));
  TRY_ASSIGN(auto records, readJson(records_file));
  Environment named = recordsFrom(records);
  TRY_ASSIGN(const auto imported_file, partOf(geometry, project.at("imported")));
  TRY_ASSIGN(auto imported, loadEnvironment(imported_file, named, progress));
  Document d = documentFrom(project);
  d.job = std::make_shared<const Job>(withPlaces(*d.job, folder));
  d.imported = std::make_shared<const Environment>(std::move(imported));
  TRY_ASSIGN(auto georeference, georeferenceFrom(project.at("georeference")));
  d.georeference = std::make_shared<const Georeference>(std::move(georeference));
  if (project.contains("lightening")) {
    const auto& part = project.at("lightening");
    TRY_ASSIGN(const auto file, partOf(geometry, part.at("geometry")));
    TRY_ASSIGN(auto light, loadEnvironment(file, named, progress));
    d.simplified = simplificationFrom(part, std::make_shared<const Environment>(std::move(light)));
  }
  if (project.contains("collision")) {
    const auto& part = project.at("collision");
    TRY_ASSIGN(const auto file, partOf(geometry, part.at("geometry")));
    TRY_ASSIGN(auto shapes, readEnvironmentGlb(file, progress));
    d.collision = collisionFrom(part, shapes);
  }
  if (project.contains("verification")) {
    d.verification = verificationFrom(project.at("verification"));
    if (!d.verification)
      report.warn((folder / kProjectFile).string() + " /verification",
                  "the comparison with an underlay is damaged and was dropped; compare again");
  }
  if (project.contains("measurements"))
    d.measurements = std::make_shared<const Measurements>(measurementsFrom(project.at("measurements"), report));
  if (project.contains("bookmarks"))
    d.bookmarks = std::make_shared<const std::vector<Bookmark>>(bookmarksFrom(project.at("bookmarks")));
  if (project.contains("underlays")) d.underlays = underlaysFrom(project.at("underlays"), folder);
  return d;
}

// `text` is that of the folder's project.json.
Result<Document> loadedFrom(const std::string& text, const fs::path& folder, Report& report, Progress& progress) {
  const auto file = folder / kProjectFile;
  TRY_ASSIGN(const auto project, jsonFrom(text, file));
  try {
    const int version = project.at("version").get<int>();
    if (version > kProjectVersion)
      return failure(ErrorKind::unusable,
                     fmt::format("the project was created by a newer version of Standpoint (project version {}, "
                                 "supported: {}); update Standpoint",
                                 version, kProjectVersion),
                     file.string() + " /version");
    TRY_ASSIGN(auto document, fromJson(project, folder, report, progress));
    document.name = fs::absolute(folder).filename().string();
    if (auto wrong = inconsistency(document); !wrong.empty()) return failure(ErrorKind::unusable, wrong, file.string());
    return document;
  } catch (const json::exception& e) {
    return failure(ErrorKind::unusable, fmt::format("missing or invalid entry: {}", e.what()), file.string());
  }
}

}  // namespace

std::uint64_t contentHash(const std::string& bytes) {
  // Eight bytes a step: FNV-1a's mixing on words; a name for content, not a defence.
  std::uint64_t hash = 0xcbf29ce484222325ULL ^ bytes.size();
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29U;
  }
  for (; i < bytes.size(); ++i) hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ULL;
  return hash;
}

Result<void> saveProject(const Document& document, const fs::path& folder, Progress& progress) {
  return saveChanges({}, document, folder, progress);
}

Result<void> saveChanges(const Document& before, const Document& document, const fs::path& folder, Progress& progress) {
  if (!document.imported) return failure(ErrorKind::usage, "nothing to save: import a model first");
  progress.stage("Save " + folder.filename().string());
  const auto geometry = folder / "geometry";
  std::error_code error;
  fs::create_directories(geometry, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());

  json project = documentToJson(document, folder);
  if (document.bookmarks) project["bookmarks"] = bookmarksToJson(*document.bookmarks);
  if (!document.underlays.empty()) project["underlays"] = underlaysToJson(document.underlays, folder);
  if (document.measurements && !document.measurements->empty())
    project["measurements"] = measurementsToJson(*document.measurements);
  if (document.verification) project["verification"] = verificationToJson(*document.verification);
  const auto there = sharedParts(before, document, folder);
  std::set<std::string> named;
  const auto store = [&](json& at, const char* key, const std::string& name, const auto& write) -> Result<void> {
    TRY_ASSIGN(auto part, name.empty() ? write() : Result<std::string>(name));
    at[key] = part;
    named.insert(std::move(part));
    return {};
  };
  const auto& g = *document.georeference;
  const auto write = [&](const Environment& environment, const char* stem) {
    return storeEnvironment(environment, g, geometry, stem, progress);
  };
  TRY(store(project, "products", there.products,
            [&] { return storeJson(recordsToJson(*document.imported), geometry, "products"); }));
  TRY(store(project, "imported", there.imported, [&] { return write(*document.imported, "imported"); }));
  if (document.simplified)
    TRY(store(project["lightening"], "geometry", there.light,
              [&] { return write(*document.simplified->environment, "light"); }));
  if (document.collision)
    TRY(store(project["collision"], "geometry", there.collision,
              [&] { return write(collisionEnvironment(*document.collision), "collision"); }));

  TRY(writeWholeText(folder / kProjectFile, project.dump(2, ' ', false, kReplace) + "\n"));
  removeUnreferenced(geometry, named);
  return {};
}

bool isEmptyProjectFolder(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename() != kProjectLockFile && entry.path().filename() != "geometry" && !isPart(entry.path()))
      return false;
  if (error) return false;
  for (const auto& entry : fs::directory_iterator(folder / "geometry", error))
    if (!isOurs(entry.path().filename().string())) return false;
  return true;
}

fs::path projectMissing(const fs::path& file) {
  std::error_code ignored;
  const auto geometry = file.parent_path();
  const bool part = geometry.filename() == "geometry" && isOurs(file.filename().string()) &&
                    fs::exists(geometry.parent_path() / kProjectFile, ignored) && !fs::exists(file, ignored);
  return part ? geometry.parent_path() : fs::path();
}

Result<void> restorePart(const fs::path& missing, const fs::path& found) {
  TRY_ASSIGN(const auto text, readText(found));
  const auto stem = missing.stem().string();
  if (found.extension() != missing.extension() || !stem.ends_with(fmt::format("-{:016x}", contentHash(text))))
    return failure(ErrorKind::unusable,
                   fmt::format("this is another file: the content is not that of {}; look for it in a copy of the "
                               "project",
                               missing.filename().string()),
                   found.string());
  std::error_code error;
  fs::create_directories(missing.parent_path(), error);
  return writeWholeText(missing, text);
}

Result<std::string> projectText(const fs::path& folder) { return readText(folder / kProjectFile); }

Result<Document> loadProject(const fs::path& folder, Progress& progress, Report* report) {
  const auto file = folder / kProjectFile;
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return failure(ErrorKind::file_system, "not a Standpoint project (no project.json); import a model to create one",
                   folder.string());
  progress.stage("Open " + folder.filename().string());
  for (int attempt = 1;; ++attempt) {
    TRY_ASSIGN(const auto text, projectText(folder));
    Report dropped;
    auto document = loadedFrom(text, folder, dropped, progress);
    if (document && report != nullptr) report->append(dropped);
    if (document || attempt == kMostAttempts) return document;
    // A writer removes the parts that its project.json names no more.
    if (const auto now = projectText(folder); !now || *now == text) return document;
  }
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/manifest.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/csv_text.h"
#include "core/part_file.h"
#include "core/sha256.h"
#include "project/dataset/program_version.h"
#include "project/dataset/set_pictures.h"
#include "project/dataset/stac_item.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kScansFile = "scans.csv", *kCroissantFile = "croissant.json";
// Of this program and the data that it ships.
constexpr const char* kOwnLicense = "https://spdx.org/licenses/GPL-3.0-or-later.html";

struct ScanColumn {
  const char *name, *type, *what;
};
constexpr ScanColumn kColumns[] = {{"scan", "sc:Text", "Name of the scan, the key"},
                                   {"file", "sc:Text", "Point cloud, from the folder of the set"},
                                   {"sha256", "sc:Text", "Checksum of the point cloud"},
                                   {"bytes", "sc:Integer", "Size of the point cloud"},
                                   {"environment", "sc:Text", "Id of the environment"},
                                   {"building", "sc:Text", "Building that the environment is of"},
                                   {"split", "sc:Text", "Split that the building is in"},
                                   {"station", "sc:Text", "Name of the station"},
                                   {"instrument", "sc:Text", "Id of instrument and settings in the recipe"},
                                   {"weather", "sc:Text", "Id of the weather in the recipe"},
                                   {"materials", "sc:Text", "Id of the materials in the recipe"},
                                   {"field_fault", "sc:Text", "Id of the field fault in the recipe"},
                                   {"effects", "sc:Text", "Id of the effects: scans that differ here alone are pairs"},
                                   {"repetition", "sc:Integer", "Seed of the recipe's list"},
                                   {"seed", "sc:Integer", "Seed of the scan's random numbers"},
                                   {"points", "sc:Integer", "Number of points"}};

// "s3dis:wall"
std::string classColumn(const RecipeClasses& map, const ClassMap::Class& one) { return map.id + ":" + one.name; }

std::string sumColumn(const std::string& labels) { return "sha256:" + labels; }

// Ids are parts of addresses: letters, digits and '-'.
std::string asId(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
  return name;
}

Json fieldOf(const std::string& name, const std::string& type, const std::string& what) {
  return {{"@type", "cr:Field"}, {"@id", "scans/" + asId(name)},
          {"name", name},        {"description", what},
          {"dataType", type},    {"source", {{"fileObject", {{"@id", kScansFile}}}, {"extract", {{"column", name}}}}}};
}

Json fileObject(const std::string& id, const std::string& format, std::uint64_t bytes, const std::string& sha256) {
  return {{"@type", "cr:FileObject"},
          {"@id", id},
          {"name", id},
          {"contentUrl", id},
          {"encodingFormat", format},
          {"contentSize", fmt::format("{} B", bytes)},
          {"sha256", sha256}};
}

Json fileSet(const std::string& id, const std::string& what, const std::string& pattern, const std::string& format) {
  return {{"@type", "cr:FileSet"},
          {"@id", id},
          {"name", id},
          {"description", what},
          {"containedIn", {{"@id", "folder"}}},
          {"encodingFormat", format},
          {"includes", pattern}};
}

// The words of Croissant 1.0 as its specification has them in every file.
Json context() {
  return {{"@language", "en"},
          {"@vocab", "https://schema.org/"},
          {"citeAs", "cr:citeAs"},
          {"column", "cr:column"},
          {"conformsTo", "dct:conformsTo"},
          {"cr", "http://mlcommons.org/croissant/"},
          {"data", {{"@id", "cr:data"}, {"@type", "@json"}}},
          {"dataBiases", "cr:dataBiases"},
          {"dataCollection", "cr:dataCollection"},
          {"dataType", {{"@id", "cr:dataType"}, {"@type", "@vocab"}}},
          {"dct", "http://purl.org/dc/terms/"},
          {"equivalentProperty", "cr:equivalentProperty"},
          {"examples", {{"@id", "cr:examples"}, {"@type", "@json"}}},
          {"extract", "cr:extract"},
          {"field", "cr:field"},
          {"fileObject", "cr:fileObject"},
          {"fileProperty", "cr:fileProperty"},
          {"fileSet", "cr:fileSet"},
          {"format", "cr:format"},
          {"includes", "cr:includes"},
          {"isLiveDataset", "cr:isLiveDataset"},
          {"jsonPath", "cr:jsonPath"},
          {"key", "cr:key"},
          {"md5", "cr:md5"},
          {"parentField", "cr:parentField"},
          {"path", "cr:path"},
          {"personalSensitiveInformation", "cr:personalSensitiveInformation"},
          {"rai", "http://mlcommons.org/croissant/RAI/"},
          {"recordSet", "cr:recordSet"},
          {"references", "cr:references"},
          {"regex", "cr:regex"},
          {"repeated", "cr:repeated"},
          {"replace", "cr:replace"},
          {"samplingRate", "cr:samplingRate"},
          {"sc", "https://schema.org/"},
          {"separator", "cr:separator"},
          {"source", "cr:source"},
          {"subField", "cr:subField"},
          {"transform", "cr:transform"}};
}

// What the points come from: models, instruments, figures of materials and this program, with their licences.
Json basedOn(const Recipe& recipe, const SetCheck& check) {
  const auto work = [](const char* type, const std::string& name, const std::string& what, const std::string& license) {
    return Json{{"@type", type},
                {"name", name},
                {"description", what},
                {"license", license.empty() ? std::string("not stated") : license}};
  };
  Json works = Json::array();
  auto program = work("sc:SoftwareApplication", "Standpoint", "The simulator", kOwnLicense);
  program["softwareVersion"] = programVersion();
  works.push_back(std::move(program));
  for (std::size_t e = 0; e < recipe.environments.size(); ++e) {
    const auto& environment = recipe.environments[e];
    works.push_back(work("sc:CreativeWork", "model " + environment.id,
                         (environment.model.empty() ? environment.project : environment.model).filename().string() +
                             "; " + check.environments[e].identity,
                         environment.license));
  }
  std::set<std::string> instruments;
  for (const auto& one : recipe.instruments)
    if (instruments.insert(one.instrument).second) {
      const bool own = isInstrumentFile(one.instrument);
      works.push_back(
          work("sc:CreativeWork", "instrument " + (own ? fs::path(one.instrument).filename().string() : one.instrument),
               own ? "Figures of the instrument, a file of its own" : "Figures of the instrument, of Standpoint",
               own ? "" : kOwnLicense));
    }
  std::map<std::string, std::set<std::string>> materials;  // by licence
  for (const auto& environment : check.environments)
    for (const auto& [id, licenses] : environment.materials) {
      for (const auto& license : licenses) materials[license].insert(id);
      if (licenses.empty()) materials[""].insert(id);
    }
  for (const auto& [license, ids] : materials)
    works.push_back(work("sc:CreativeWork",
                         license.empty() ? "materials without measured figures" : "figures of materials",
                         fmt::format("{}", fmt::join(ids, ", ")), license.empty() ? kOwnLicense : license));
  return works;
}

Json splitRecords(const Recipe& recipe) {
  Json data = Json::array();
  for (const auto& split : recipe.splits) {
    const char* const kind = split.name == "train"  ? "cr:TrainingSplit"
                             : split.name == "test" ? "cr:TestSplit"
                                                    : "cr:ValidationSplit";
    data.push_back({{"splits/name", split.name}, {"splits/url", kind}});
  }
  return {{"@type", "cr:RecordSet"},
          {"@id", "splits"},
          {"name", "splits"},
          {"description", "Splits, by building"},
          {"dataType", {"sc:Enumeration", "cr:Split"}},
          {"key", {{"@id", "splits/name"}}},
          {"field",
           {{{"@type", "cr:Field"}, {"@id", "splits/name"}, {"name", "name"}, {"dataType", "sc:Text"}},
            {{"@type", "cr:Field"}, {"@id", "splits/url"}, {"name", "url"}, {"dataType", {"sc:URL", "wd:Q3985153"}}}}},
          {"data", std::move(data)}};
}

Json classRecords(const RecipeClasses& map) {
  const std::string id = "classes-" + map.id;
  Json data = Json::array();
  for (const auto& one : map.map.classes)
    data.push_back({{id + "/id", one.id}, {id + "/name", one.name}, {id + "/ignored", one.ignored}});
  const auto field = [&](const char* name, const char* type) {
    return Json{{"@type", "cr:Field"}, {"@id", id + "/" + name}, {"name", name}, {"dataType", type}};
  };
  return {{"@type", "cr:RecordSet"},
          {"@id", id},
          {"name", id},
          {"description", "Classes of the labels *." + map.id + ".npy: " + map.map.name},
          {"dataType", "sc:Enumeration"},
          {"key", {{"@id", id + "/id"}}},
          {"field", {field("id", "sc:Integer"), field("name", "sc:Text"), field("ignored", "sc:Boolean")}},
          {"data", std::move(data)}};
}

Json scanRecords(const Recipe& recipe) {
  Json fields = Json::array();
  for (const auto& column : kColumns) {
    fields.push_back(fieldOf(column.name, column.type, column.what));
    if (std::string_view(column.name) == "split") fields.back()["references"] = {{"field", {{"@id", "splits/name"}}}};
  }
  for (const auto& map : recipe.classes)
    fields.push_back(fieldOf(sumColumn(map.id), "sc:Text", "Checksum of the labels *." + map.id + ".npy"));
  fields.push_back(fieldOf(sumColumn("instances"), "sc:Text", "Checksum of the labels *.instances.npy"));
  for (const auto& map : recipe.classes)
    for (const auto& one : map.map.classes)
      fields.push_back(fieldOf(classColumn(map, one), "sc:Integer", "Points of the class"));
  return {{"@type", "cr:RecordSet"},
          {"@id", "scans"},
          {"name", "scans"},
          {"description", "A record for each scan"},
          {"key", {{"@id", "scans/scan"}}},
          {"field", std::move(fields)}};
}

}  // namespace

std::string scansCsv(const Recipe& recipe, const SetCheck& check) {
  std::string text;
  for (const auto& column : kColumns) text += (text.empty() ? "" : ",") + std::string(column.name);
  for (const auto& map : recipe.classes) text += "," + sumColumn(map.id);
  text += "," + sumColumn("instances");
  for (const auto& map : recipe.classes)
    for (const auto& one : map.map.classes) text += "," + csvText(classColumn(map, one));
  text += "\n";
  for (const auto& scan : check.scans) {
    const auto& environment = recipe.environments[scan.place.environment];
    const auto& v = scan.variant;
    const auto& cloud = scan.record.files.front();
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", scan.files.scan, cloud.path, cloud.sha256,
                        cloud.bytes, environment.id, csvText(environment.building), recipe.splitOf(environment),
                        scan.place.station, recipe.instruments[v.instrument].id, recipe.weather[v.weather].id,
                        recipe.materials[v.materials].id, recipe.field_faults[v.fault].id, recipe.effects[v.effects].id,
                        recipe.seeds[v.seed], scan.record.seed, scan.record.points);
    for (std::size_t k = 1; k < scan.record.files.size(); ++k) text += "," + scan.record.files[k].sha256;
    for (const auto& map : recipe.classes)
      for (const auto count : scan.record.classes.at(map.id)) text += fmt::format(",{}", count);
    text += "\n";
  }
  return text;
}

std::string croissantText(const Recipe& recipe, const SetCheck& check, const std::string& scans_csv) {
  Json files = Json::array();
  files.push_back(
      {{"@type", "cr:FileObject"},
       {"@id", "folder"},
       {"name", "folder"},
       {"description", "The folder of the set; its checksum is that of scans.csv, which has those of the clouds"},
       {"contentUrl", "."},
       {"encodingFormat", "local-directory"},
       {"sha256", sha256Of(scans_csv)}});
  files.push_back(fileObject(kScansFile, "text/csv", scans_csv.size(), sha256Of(scans_csv)));
  for (const auto& other : check.others)
    if (!other.path.starts_with("records/"))
      files.push_back(fileObject(other.path, other.path.ends_with(".svg") ? "image/svg+xml" : "application/json",
                                 other.bytes, other.sha256));
  files.push_back(fileSet("clouds", "Point clouds with product and material of each point",
                          "scans/**/*" + recipe.extension(), cloudMediaType(recipe)));
  for (const auto& map : recipe.classes)
    files.push_back(fileSet("labels-" + map.id, "Class of each point, in the order of the cloud: " + map.map.name,
                            "labels/**/*." + map.id + ".npy", "application/octet-stream"));
  files.push_back(fileSet("instances", "Instance of each point, in the order of the cloud; 0: none",
                          "labels/**/*.instances.npy", "application/octet-stream"));
  Json records = {splitRecords(recipe), scanRecords(recipe)};
  for (const auto& map : recipe.classes) records.push_back(classRecords(map));
  auto words = context();
  words["wd"] = "https://www.wikidata.org/wiki/";
  const Json json = {{"@context", std::move(words)},
                     {"@type", "sc:Dataset"},
                     {"conformsTo", "http://mlcommons.org/croissant/1.0"},
                     {"name", recipe.name},
                     {"description", recipe.description},
                     {"license", recipe.license},
                     {"url", recipe.url},
                     {"creator", {{"@type", "sc:Organization"}, {"name", recipe.creator}}},
                     {"datePublished", recipe.date},
                     {"version", recipe.version},
                     {"keywords", {"laser scanning", "point cloud", "semantic segmentation", "simulation"}},
                     {"isLiveDataset", false},
                     {"isBasedOn", basedOn(recipe, check)},
                     {"dataCollection", fmt::format("Simulated with Standpoint {} from recipe.json", programVersion())},
                     {"distribution", std::move(files)},
                     {"recordSet", std::move(records)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string balanceFile(const RecipeClasses& map) { return "balance/" + map.id + ".svg"; }

std::string cloudMediaType(const Recipe& recipe) {
  return recipe.format == "e57"   ? "model/e57"
         : recipe.format == "las" ? "application/vnd.las"
                                  : "application/octet-stream";
}

std::vector<SplitBalance> balanceOf(const Recipe& recipe, const SetCheck& check, std::size_t map) {
  const auto& classes = recipe.classes[map];
  std::vector<SplitBalance> all;
  for (const auto& split : recipe.splits)
    all.push_back({split.name, std::vector<std::uint64_t>(classes.map.classes.size())});
  for (const auto& scan : check.scans) {
    const auto& name = recipe.splitOf(recipe.environments[scan.place.environment]);
    const auto split = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.split == name; });
    const auto& counts = scan.record.classes.at(classes.id);
    for (std::size_t k = 0; k < counts.size(); ++k) {
      split->points[k] += counts[k];
      if (!classes.map.classes[k].ignored) split->counted += counts[k];
    }
  }
  return all;
}

Result<std::vector<std::string>> writeManifest(const fs::path& set, const Recipe& recipe, const SetCheck& check,
                                               Progress& progress) {
  progress.stage("Write the manifest of " + recipe.name);
  std::vector<SetFile> files = check.others;
  for (const auto& scan : check.scans) files.insert(files.end(), scan.record.files.begin(), scan.record.files.end());
  const auto csv = scansCsv(recipe, check);
  std::vector<std::pair<std::string, std::string>> texts = {{kScansFile, csv},
                                                            {kCroissantFile, croissantText(recipe, check, csv)},
                                                            {"card.html", cardHtml(recipe, check)},
                                                            {"README.md", cardMarkdown(recipe, check)}};
  for (std::size_t m = 0; m < recipe.classes.size(); ++m)
    texts.emplace_back(balanceFile(recipe.classes[m]), balanceChart(recipe, check, m));
  for (std::size_t e = 0; e < recipe.environments.size(); ++e) {
    TRY_ASSIGN(const auto item, stacItem(recipe, check, e));
    if (item) texts.emplace_back(stacFile(recipe.environments[e]), *item);
  }
  std::vector<std::string> written;
  TRY_ASSIGN(const auto folder, SetFolder::open(set, recipe));
  for (const auto& [name, text] : texts) {
    TRY(progress.check());
    TRY(folder.putText(name, text));
    files.push_back({name, text.size(), sha256Of(text)});
    written.push_back(name);
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  std::string sums;
  for (const auto& file : files) sums += file.sha256 + "  " + file.path + "\n";
  TRY(folder.putText(kSumsFile, sums));
  written.emplace_back(kSumsFile);
  return written;
}

}  // namespace standpoint

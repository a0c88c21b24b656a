// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/recipe.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "importers/importers.h"
#include "pointclouds/formats.h"
#include "project/dataset/set_scans.h"
#include "project/materials/materials_verb.h"
#include "project/survey/station_row.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "standpoint-dataset";
constexpr std::size_t kMostPlaces = 10000;  // of one strategy
constexpr double kFarthestPlace_m = 1e9;
constexpr double kMostSeed = 9007199254740991.0;
constexpr double kMostScans = 1e6;          // of a set
constexpr std::size_t kLongestText = 1000;  // bytes

struct StrategyWord {
  const char* word;
  StationStrategy::Kind kind;
};
constexpr std::array kStrategies = {
    StrategyWord{"greedy", StationStrategy::Kind::greedy}, StrategyWord{"grid", StationStrategy::Kind::grid},
    StrategyWord{"route", StationStrategy::Kind::route}, StrategyWord{"places", StationStrategy::Kind::places},
    StrategyWord{"project", StationStrategy::Kind::project}};

// Names of folders and files are made of ids.
bool isId(const std::string& text) {
  constexpr std::size_t kLongest = 40;
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '.'; };
  return !text.empty() && text.size() <= kLongest && std::isalnum(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), fits);
}

bool isDate(const std::string& text) {
  constexpr std::string_view kForm = "0000-00-00";
  const bool formed = std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [](unsigned char c, char form) {
    return form == '0' ? std::isdigit(c) != 0 : c == '-';
  });
  if (!formed) return false;
  const auto number = [&](std::size_t at, std::size_t digits) { return std::stoi(text.substr(at, digits)); };
  return std::chrono::year_month_day(std::chrono::year(number(0, 4)),
                                     std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                     std::chrono::day(static_cast<unsigned>(number(8, 2))))
      .ok();
}

class RecipeReader {
 public:
  // Without `check` files that the recipe names are not looked at.
  RecipeReader(std::string file, fs::path folder, bool check)
      : fault_(std::move(file)), folder_(std::move(folder)), check_(check) {}
  Result<Recipe> read(const json& content, const fs::path& classes_folder);

 private:
  using Ids = std::set<std::string>;
  std::string idOf(JsonFields& fields, Ids& taken, const std::string& usual = {});
  std::string line(JsonFields& fields, const char* key, std::string text) const;
  std::string licenceOf(JsonFields& fields) { return line(fields, "license", fields.textOr("license", "")); }
  fs::path placed(const fs::path& path) const { return path.is_absolute() ? path : folder_ / path; }
  fs::path existing(JsonFields& fields, const char* key, const fs::path& inside = {});
  template <class T>
  std::optional<T> parsed(JsonFields& fields, const char* key);
  template <class T>
  std::optional<T> parsedList(JsonFields& fields, const char* key);
  std::uint64_t whole(const json& value, const std::string& pointer, double minimum, double maximum);

  void takeAbout(JsonFields& root);
  void takeEnvironments(JsonFields& root);
  std::vector<StationStrategy> strategies(JsonFields& fields);
  StationStrategy strategy(JsonFields& fields, Ids& taken);
  std::vector<FloorPlace> places(JsonFields& fields, const char* key, std::size_t least);
  void takeInstruments(JsonFields& root);
  void takeConditions(JsonFields& root);
  void checkMaterials();
  void takeEffects(JsonFields& root);
  void takeSeeds(JsonFields& root);
  void takeSplits(JsonFields& root);
  void takeClasses(JsonFields& root, const fs::path& folder);
  void takeOutput(JsonFields& root);
  void checkSize();

  JsonFault fault_;
  fs::path folder_;
  bool check_;
  Recipe recipe_;
};

std::string RecipeReader::idOf(JsonFields& fields, Ids& taken, const std::string& usual) {
  auto id = usual.empty() ? fields.text("id", "house") : fields.textOr("id", usual);
  if (!id.empty() && !isId(id))
    fields.wrong("id", fmt::format("'{}' must be up to 40 letters, digits, '-' and '.': files are named by it", id));
  if (!taken.insert(id).second) fields.wrong("id", fmt::format("'{}' is already used; ids must differ", id));
  return id;
}

// What stands in tables, pages and names of a set that is made.
std::string RecipeReader::line(JsonFields& fields, const char* key, std::string text) const {
  if (!check_) return text;
  if (text.size() > kLongestText) fields.wrong(key, fmt::format("is longer than {} bytes", kLongestText));
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }))
    fields.wrong(key, "must be one line without control characters");
  return fault_.error() ? std::string() : text;
}

fs::path RecipeReader::existing(JsonFields& fields, const char* key, const fs::path& inside) {
  const fs::path path = placed(line(fields, key, fields.text(key)));
  if (fault_.error()) return path;
  std::error_code error;
  if (check_ && !fs::exists(inside.empty() ? path : path / inside, error))
    fields.wrong(key, inside.empty() ? fmt::format("file not found: {}", path.string())
                                     : fmt::format("not a project: {}", path.string()));
  return path;
}

template <class T>
std::optional<T> RecipeReader::parsed(JsonFields& fields, const char* key) {
  if (!fields.has(key)) return fields.skip(key), std::nullopt;
  auto value = FieldValue<T>::read(json(fields.text(key)));
  if (!value) return fields.wrong(key, value.error().message), std::nullopt;
  return *std::move(value);
}

template <class T>
std::optional<T> RecipeReader::parsedList(JsonFields& fields, const char* key) {
  const auto texts = fields.texts(key);
  for (const auto& text : texts)
    if (text.find('=') == std::string::npos)
      return fields.wrong(key, fmt::format("'{}' must be key=value", text)), std::nullopt;
  auto value = FieldValue<T>::read(json(texts));
  if (!value) return fields.wrong(key, value.error().message), std::nullopt;
  return *std::move(value);
}

std::uint64_t RecipeReader::whole(const json& value, const std::string& pointer, double minimum, double maximum) {
  const double number = numberAt(fault_, value, pointer, minimum, maximum);
  if (number != std::floor(number)) fault_.needs(pointer, value, "a whole number");
  return static_cast<std::uint64_t>(number);
}

void RecipeReader::takeAbout(JsonFields& root) {
  if (root.text("format") != kFormat) root.wrong("format", fmt::format("must be \"{}\"", kFormat));
  if (root.number("recipe_version", 1, 1e6) != 1)
    root.wrong("recipe_version", "was written by a newer version; this one reads 1");
  recipe_.name = root.text("name", "my-buildings");
  if (!recipe_.name.empty() && !isId(recipe_.name)) root.wrong("name", "must be up to 40 letters, digits, '-' and '.'");
  recipe_.description = line(root, "description", root.textOr("description", "Simulated laser scans with labels"));
  recipe_.license = line(root, "license", root.text("license", "https://spdx.org/licenses/CC-BY-4.0.html"));
  recipe_.creator = line(root, "creator", root.text("creator"));
  recipe_.date = root.text("date", "2026-01-31");
  if (!recipe_.date.empty() && !isDate(recipe_.date)) root.wrong("date", "must be a date like 2026-01-31");
  recipe_.url = line(root, "url", root.textOr("url", "https://example.org/" + recipe_.name));
  recipe_.version = line(root, "version", root.textOr("version", "1.0.0"));
  if (const auto* seed = root.raw("seed")) recipe_.seed = whole(*seed, root.pointer("seed"), 0, kMostSeed);
  recipe_.starved_below = root.numberOr("starved_below", recipe_.starved_below, 0, 1);
}

std::vector<FloorPlace> RecipeReader::places(JsonFields& fields, const char* key, std::size_t least) {
  std::vector<FloorPlace> found;
  const auto* list = fields.required(key);
  if (list == nullptr) return found;
  if (!list->is_array() || list->size() < least || list->size() > kMostPlaces) {
    fields.needs(key, *list, fmt::format("a list of {} to {} places [x, y] or [x, y, z]", least, kMostPlaces));
    return found;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto& place = (*list)[i];
    const auto at = fmt::format("{}/{}", fields.pointer(key), i);
    if (!place.is_array() || place.size() < 2 || place.size() > 3) {
      fault_.needs(at, place, "a place [x, y] or [x, y, z] in metres");
      return found;
    }
    const auto number = [&](std::size_t k) {
      return numberAt(fault_, place[k], fmt::format("{}/{}", at, k), -kFarthestPlace_m, kFarthestPlace_m);
    };
    found.push_back({number(0), number(1), place.size() > 2 ? std::optional(number(2)) : std::nullopt});
  }
  return found;
}

StationStrategy RecipeReader::strategy(JsonFields& fields, Ids& taken) {
  StationStrategy made;
  std::vector<std::string> words;
  for (const auto& known : kStrategies) words.emplace_back(known.word);
  const auto word = fields.wordOf("strategy", words);
  for (const auto& known : kStrategies)
    if (word == known.word) made.kind = known.kind;
  made.id = idOf(fields, taken, word.empty() ? "stations" : word);
  made.height_m = fields.optionalNumber("height_m", 0.1, 10);
  made.levelling_error_deg = fields.numberOr("levelling_error_deg", 0, 0, 60);
  using Kind = StationStrategy::Kind;
  const auto count = [&] {
    const auto* value = fields.required("count");
    return value == nullptr ? 1 : static_cast<std::size_t>(whole(*value, fields.pointer("count"), 1, kMostPlaces));
  };
  switch (made.kind) {
    case Kind::greedy: made.count = count(); break;
    case Kind::grid:
      made.spacing_m = fields.number("spacing_m", 0.5, 1000);
      made.count = count();
      break;
    case Kind::route:
      made.spacing_m = fields.number("spacing_m", 0.5, 1000);
      made.through = places(fields, "through", 2);
      break;
    case Kind::places:
      made.through = places(fields, "places", 1);
      made.count = made.through.size();
      break;
    case Kind::project:
      made.names = fields.texts("names");
      made.count = made.names.size();
      if (made.names.empty()) fields.wrong("names", "must list stations of the project");
      if (made.height_m || made.levelling_error_deg > 0)
        fields.wrong("", "stations of a project stand as they stand: leave out height_m and levelling_error_deg");
      break;
  }
  if (made.kind == Kind::route) made.count = routePlaces(made).size();
  if (made.count > kMostPlaces) fields.wrong("spacing_m", fmt::format("makes more than {} places", kMostPlaces));
  return made;
}

std::vector<StationStrategy> RecipeReader::strategies(JsonFields& fields) {
  std::vector<StationStrategy> all;
  Ids taken;
  fields.list("stations", [&](JsonFields& one) { all.push_back(strategy(one, taken)); });
  return all;
}

void RecipeReader::takeEnvironments(JsonFields& root) {
  const auto usual = strategies(root);
  Ids taken;
  root.required("environments");
  root.list("environments", [&](JsonFields& fields) {
    RecipeEnvironment one;
    one.id = idOf(fields, taken);
    one.building = line(fields, "building", fields.textOr("building", one.id));
    if (fields.has("model") == fields.has("project"))
      fields.wrong("", "specify either \"model\", a file, or \"project\", a folder");
    for (const char* key : {"model", "project", "stations"}) fields.skip(key);
    if (fields.has("model")) one.model = existing(fields, "model");
    if (fields.has("project")) one.project = existing(fields, "project", "project.json");
    if (check_ && !fault_.error() && !one.model.empty())
      if (const auto importer = importerOf(one.model); !importer) fields.wrong("model", importer.error().message);
    one.license = licenceOf(fields);
    one.stations = fields.has("stations") ? strategies(fields) : usual;
    if (one.stations.empty()) fields.wrong("", "has no stations: specify \"stations\" here or for all environments");
    for (const auto& s : one.stations)
      if (s.kind == StationStrategy::Kind::project && one.project.empty())
        fields.wrong("stations", "a model file has no stations of its own: use another strategy, or a project");
    recipe_.environments.push_back(std::move(one));
  });
  if (recipe_.environments.empty()) root.wrong("environments", "must list an environment or more");
}

void RecipeReader::takeInstruments(JsonFields& root) {
  Ids taken;
  root.required("instruments");
  root.list("instruments", [&](JsonFields& fields) {
    RecipeInstrument one;
    one.id = idOf(fields, taken);
    one.instrument = line(fields, "instrument", fields.text("instrument", "leica-rtc360"));
    if (isInstrumentFile(one.instrument)) one.instrument = placed(one.instrument).string();
    if (auto settings = parsedList<KeyValues>(fields, "set")) one.settings = *std::move(settings);
    if (check_ && !fault_.error()) {
      const auto instrument = instrumentNamed(one.instrument);
      if (!instrument)
        fields.wrong("instrument", instrument.error().message);
      else if (instrument->moving)
        fields.wrong("instrument", "is carried along a trajectory; a set is made from stations");
      else if (const auto settings = resolveSettings(*instrument, one.settings); !settings)
        fields.wrong("set", settings.error().message);
      else if (!settings->laser)
        fields.wrong("set", "these settings measure no points");
    }
    recipe_.instruments.push_back(std::move(one));
  });
  if (recipe_.instruments.empty()) root.wrong("instruments", "must list an instrument or more");
}

void RecipeReader::takeConditions(JsonFields& root) {
  Ids weather, materials, faults;
  root.list("weather", [&](JsonFields& fields) {
    RecipeWeather one;
    one.id = idOf(fields, weather);
    one.weather = parsed<Weather>(fields, "weather");
    one.sun = parsed<Sun>(fields, "sun");
    one.interference = fields.numberOr("interference", 0, 0, 1);
    recipe_.weather.push_back(std::move(one));
  });
  root.list("materials", [&](JsonFields& fields) {
    RecipeMaterials one;
    one.id = idOf(fields, materials);
    fields.skip("rules");
    if (fields.has("rules")) one.rules = existing(fields, "rules");
    one.assign = fields.texts("assign");
    for (const auto& text : one.assign)
      if (text.find('=') == std::string::npos)
        fields.wrong("assign", fmt::format("'{}' must be SELECTOR=MATERIAL", text));
    recipe_.materials.push_back(std::move(one));
  });
  root.list("field_faults", [&](JsonFields& fields) {
    RecipeFault one;
    one.id = idOf(fields, faults);
    if (auto fault = parsedList<FieldFault>(fields, "fault")) one.fault = *fault;
    recipe_.field_faults.push_back(std::move(one));
  });
  if (recipe_.weather.empty()) recipe_.weather.push_back({"clear", {}, {}, 0});
  if (recipe_.materials.empty()) recipe_.materials.push_back({"assigned", {}, {}});
  if (recipe_.field_faults.empty()) recipe_.field_faults.push_back({"none", {}});
}

// A project may bring materials of its own, which nobody has read yet.
void RecipeReader::checkMaterials() {
  const auto is_project = [](const RecipeEnvironment& e) { return !e.project.empty(); };
  const auto& environments = recipe_.environments;
  if (!check_ || fault_.error() || std::any_of(environments.begin(), environments.end(), is_project)) return;
  const auto library = shippedMaterials();
  if (!library) return fault_.say("/materials", describe(library.error()));
  for (std::size_t i = 0; i < recipe_.materials.size(); ++i) {
    const auto& one = recipe_.materials[i];
    if (!one.rules.empty())
      if (const auto checked = checkRules(one.rules, *library); !checked)
        fault_.say(fmt::format("/materials/{}/rules", i), describe(checked.error()));
    for (const auto& o : overridesFrom(one.assign))
      if (o.material != "rules" &&
          std::none_of(library->begin(), library->end(), [&](const auto& m) { return m.id == o.material; }))
        fault_.say(fmt::format("/materials/{}/assign", i),
                   fmt::format("'{}' is not in the library of materials", o.material));
  }
}

void RecipeReader::takeEffects(JsonFields& root) {
  Ids taken;
  root.list("effects", [&](JsonFields& fields) {
    RecipeEffects one;
    one.id = idOf(fields, taken);
    one.ideal = fields.flagOr("ideal", false);
    one.without = parsed<Effects>(fields, "without");
    if (one.ideal && one.without) fields.wrong("without", "an ideal scan already excludes all effects");
    recipe_.effects.push_back(std::move(one));
  });
  if (recipe_.effects.empty()) recipe_.effects.push_back({"noisy", false, {}});
}

void RecipeReader::takeSeeds(JsonFields& root) {
  const auto* seeds = root.raw("seeds");
  if (seeds == nullptr) {
    recipe_.seeds = {1};
    return;
  }
  if (!seeds->is_array() || seeds->empty())
    return root.needs("seeds", *seeds, "a list of whole numbers, such as [1, 2]");
  std::set<std::uint64_t> taken;
  for (std::size_t i = 0; i < seeds->size(); ++i) {
    const auto at = fmt::format("{}/{}", root.pointer("seeds"), i);
    const auto seed = whole((*seeds)[i], at, 0, kMostSeed);
    if (!taken.insert(seed).second) fault_.say(at, fmt::format("{} is already in the list", seed));
    recipe_.seeds.push_back(seed);
  }
}

void RecipeReader::takeSplits(JsonFields& root) {
  std::set<std::string> buildings, placed_buildings;
  for (const auto& e : recipe_.environments) buildings.insert(e.building);
  if (root.required("splits") == nullptr) return;
  root.object("splits", [&](JsonFields& fields) {
    for (const char* name : {"train", "validation", "test"}) {
      fields.skip(name);
      if (!fields.has(name)) continue;
      recipe_.splits.push_back({name, fields.texts(name)});
      for (const auto& building : recipe_.splits.back().buildings) {
        if (!buildings.contains(building))
          fields.wrong(name, fmt::format("'{}' is not a building of the environments", building));
        if (!placed_buildings.insert(building).second)
          fields.wrong(name,
                       fmt::format("building '{}' is already in a split: a network that has seen a building is not "
                                   "tested on it",
                                   building));
      }
    }
  });
  for (const auto& building : buildings)
    if (!placed_buildings.contains(building))
      root.wrong("splits", fmt::format("building '{}' is in no split", building));
}

void RecipeReader::takeClasses(JsonFields& root, const fs::path& folder) {
  Ids taken;
  const auto names = root.texts("classes");
  if (names.empty())
    root.wrong("classes", fmt::format("must list a map or more: {}", fmt::join(shippedClassMaps(), ", ")));
  for (std::size_t i = 0; i < names.size() && !fault_.error(); ++i) {
    const auto at = fmt::format("{}/{}", root.pointer("classes"), i);
    RecipeClasses one;
    const bool is_file = fs::path(names[i]).extension() == ".json";
    one.id = is_file ? fs::path(names[i]).stem().string() : names[i];
    if (!isId(one.id)) fault_.say(at, fmt::format("the file's name '{}' must be letters, digits, '-' and '.'", one.id));
    if (!taken.insert(one.id).second) fault_.say(at, fmt::format("'{}' is already in the list", one.id));
    const auto file = !folder.empty() ? folder / (one.id + ".json")
                      : is_file       ? placed(names[i])
                                      : shippedClassMap(one.id);
    auto map = classMapNamed(!folder.empty() || is_file ? file.string() : names[i]);
    auto text = map ? readWholeFile(file, kLargestJsonFile) : Result<std::string>(failure(map.error()));
    if (!text) {
      fault_.say(at, describe(text.error()));
      return;
    }
    if (std::all_of(map->classes.begin(), map->classes.end(), [](const auto& c) { return c.ignored; }))
      fault_.say(at, fmt::format("all classes of '{}' are ignored", names[i]));
    if (map->rules.empty()) fault_.say(at, fmt::format("'{}' maps nothing: its \"ifc\" is empty", names[i]));
    one.map = *std::move(map);
    one.text = *std::move(text);
    recipe_.classes.push_back(std::move(one));
  }
}

void RecipeReader::takeOutput(JsonFields& root) {
  root.object("output", [&](JsonFields& fields) {
    recipe_.format = fields.textOr("format", recipe_.format);
    recipe_.as = fields.textOr("as", "");
    recipe_.truth = fields.flagOr("truth", true);
    const auto quality = fields.textOr("quality", "default");
    const auto* const words = choices(ScanQuality{}).data();
    const auto known =
        std::find_if(words, words + choices(ScanQuality{}).size(), [&](const auto& c) { return quality == c.name; });
    if (known == words + choices(ScanQuality{}).size())
      fields.wrong("quality", fmt::format("'{}' is not one of preview, default, reference", quality));
    else
      recipe_.quality = known->value;
    const auto* format = cloudFormatFor("x." + recipe_.format);
    if (format == nullptr || format->writer == nullptr)
      fields.wrong("format", fmt::format("'{}' is no format that points are written in", recipe_.format));
    else if (const auto writer = writerOf(*format, recipe_.as); !writer)
      fields.wrong("as", writer.error().message);
  });
}

// Lists of scans are kept in memory, and each has files of its own.
void RecipeReader::checkSize() {
  double scans = 1;
  for (const auto entries :
       {placesOf(recipe_).size(), recipe_.instruments.size(), recipe_.weather.size(), recipe_.materials.size(),
        recipe_.field_faults.size(), recipe_.effects.size(), recipe_.seeds.size()})
    scans *= static_cast<double>(entries);
  if (scans > kMostScans)
    fault_.say("",
               fmt::format("makes {:.0f} scans, more than {:.0f}: split it into several recipes", scans, kMostScans));
}

Result<Recipe> RecipeReader::read(const json& content, const fs::path& classes_folder) {
  JsonFields root(fault_, content, "");
  takeAbout(root);
  takeEnvironments(root);
  takeInstruments(root);
  takeConditions(root);
  checkMaterials();
  takeEffects(root);
  takeSeeds(root);
  takeSplits(root);
  takeClasses(root, classes_folder);
  takeOutput(root);
  root.close();
  checkSize();
  TRY(fault_.result());
  return std::move(recipe_);
}

Result<Recipe> readRecipeFile(const fs::path& file, bool check, const fs::path& classes_folder) {
  TRY_ASSIGN(auto text, readWholeFile(file, kLargestJsonFile));
  TRY_ASSIGN(const auto content, parseJson(text, file.filename().string()));
  TRY_ASSIGN(auto recipe,
             RecipeReader(file.filename().string(), file.parent_path(), check).read(content, classes_folder));
  recipe.text = std::move(text);
  return recipe;
}

}  // namespace

std::vector<FloorPlace> routePlaces(const StationStrategy& route) {
  std::vector<FloorPlace> all;
  double until_next = 0;  // along the leg
  for (std::size_t leg = 0; leg + 1 < route.through.size(); ++leg) {
    const auto &a = route.through[leg], &b = route.through[leg + 1];
    const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length = std::sqrt(dx * dx + dy * dy);
    for (; until_next <= length && all.size() <= kMostPlaces; until_next += route.spacing_m) {
      const double t = length > 0 ? until_next / length : 0;
      const auto z = a.z_m && b.z_m ? std::optional(*a.z_m + t * (*b.z_m - *a.z_m)) : std::nullopt;
      all.push_back({a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m), z});
    }
    until_next -= length;
  }
  return all;
}

const std::string& Recipe::splitOf(const RecipeEnvironment& environment) const {
  for (const auto& split : splits)
    for (const auto& building : split.buildings)
      if (building == environment.building) return split.name;
  return splits.front().name;
}

std::string Recipe::extension() const { return cloudFormatFor("x." + format)->extension; }

Result<Recipe> readRecipe(const fs::path& file) { return readRecipeFile(file, true, {}); }

Result<Recipe> readRecipeOfSet(const fs::path& set) {
  return readRecipeFile(set / "recipe.json", false, set / "classes");
}

}  // namespace standpoint

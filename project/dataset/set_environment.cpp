// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_environment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/sha256.h"
#include "project/dataset/set_pictures.h"
#include "project/materials/materials_verb.h"
#include "project/model/import_verb.h"
#include "project/storage/project_files.h"
#include "project/survey/station_placing.h"
#include "survey/instruments.h"
#include "survey/scanning/scan_identity.h"
#include "survey/stations/station_places.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Result<Document> readEnvironment(const RecipeEnvironment& environment, Report& report, Progress& progress) {
  if (!environment.project.empty()) return loadProject(environment.project, progress, &report);
  ImportVerbOptions options;
  options.files = {environment.model};
  TRY_ASSIGN(auto imported, runImport({}, options, progress));
  return std::move(imported.document);
}

// Finds the stations of one environment, strategy after strategy.
class StationFinder {
 public:
  StationFinder(const RecipeEnvironment& environment, std::uint64_t seed, SetEnvironment& made, Report& report)
      : environment_(environment), seed_(seed), made_(made), report_(report), before_(made.document.job) {}

  Result<void> find(Progress& progress) {
    Job job = *before_;
    job.stations.clear();
    made_.document.job = std::make_shared<const Job>(std::move(job));
    for (const auto& strategy : environment_.stations) {
      TRY(progress.check());
      const auto first = made_.station.size();
      TRY(strategy.kind == StationStrategy::Kind::project ? takeNamed(strategy) : findOf(strategy, progress));
      const auto found = std::count_if(made_.station.begin() + static_cast<std::ptrdiff_t>(first), made_.station.end(),
                                       [](const auto& s) { return s.has_value(); });
      if (static_cast<std::size_t>(found) < strategy.count)
        report_.note(environment_.id,
                     fmt::format("{}: {} of {} places have room for a tripod", strategy.id, found, strategy.count));
    }
    if (made_.document.job->stations.empty())
      return failure(ErrorKind::unusable, "no place of its strategies has room for a tripod", environment_.id);
    return {};
  }

 private:
  void add(Station station) {
    Job job = *made_.document.job;
    made_.station.emplace_back(job.stations.size());
    job.stations.push_back(std::move(station));
    made_.document.job = std::make_shared<const Job>(std::move(job));
  }

  // What the project placed stands as it was placed, under the name of this set.
  Result<void> takeNamed(const StationStrategy& strategy) {
    for (std::size_t k = 0; k < strategy.names.size(); ++k) {
      const auto& all = before_->stations;
      const auto at =
          std::find_if(all.begin(), all.end(), [&](const Station& s) { return s.name == strategy.names[k]; });
      if (at == all.end())
        return failure(ErrorKind::unusable, fmt::format("the project has no station '{}'", strategy.names[k]),
                       environment_.id);
      Station station = *at;
      station.name = fmt::format("{}-{}", strategy.id, k + 1);
      station.scans.clear();
      add(std::move(station));
    }
    return {};
  }

  StationOptions standing(const StationStrategy& strategy) const {
    StationOptions options;
    options.height_m = strategy.height_m;
    if (strategy.levelling_error_deg > 0) options.levelling_error_deg = strategy.levelling_error_deg;
    options.seed = seed_;
    return options;
  }

  Result<void> findOf(const StationStrategy& strategy, Progress& progress) {
    std::vector<FloorPlace> places;
    if (strategy.kind == StationStrategy::Kind::grid) {
      TRY_ASSIGN(places, gridPlaces(strategy, progress));
    } else if (strategy.kind == StationStrategy::Kind::route) {
      places = routePlaces(strategy);
    } else {
      places = strategy.through;
    }
    bool is_full = false;
    for (std::size_t k = 0; k < strategy.count; ++k) {
      auto options = standing(strategy);
      const bool greedy = strategy.kind == StationStrategy::Kind::greedy;
      if (!greedy && k < places.size()) options.on = places[k];
      if (is_full || (!greedy && k >= places.size())) {
        made_.station.emplace_back();
        continue;
      }
      Report remarks;
      auto station = placeStation(made_.document, *made_.scene, fmt::format("{}-{}", strategy.id, k + 1), options,
                                  remarks, progress);
      if (station) {
        add(*std::move(station));
        continue;
      }
      if (station.error().kind != ErrorKind::unusable) return failure(station.error());
      is_full = greedy;
      made_.station.emplace_back();
    }
    return {};
  }

  // Row by row from the lowest floor on, as far as a tripod can stand there; of too many evenly taken.
  Result<std::vector<FloorPlace>> gridPlaces(const StationStrategy& strategy, Progress& progress) const {
    const auto& scene = *made_.scene;
    const double height = strategy.height_m.value_or(kUsualHeight_m),
                 shift_z = made_.document.georeference->shift_m.z();
    const Eigen::Vector3d& shift = made_.document.georeference->shift_m;
    TRY_ASSIGN(const auto stand, readTripodStand(tripodStandFile()));
    const StationPlacement placement(scene, stand, kUsualTrunnion_m);
    const Bounds box = bounds(sceneOf(scene.environment()));
    std::vector<Eigen::Vector3d> floors;
    for (double y = box.min.y() + strategy.spacing_m / 2; y < box.max.y(); y += strategy.spacing_m) {
      TRY(progress.check());
      for (double x = box.min.x() + strategy.spacing_m / 2; x < box.max.x(); x += strategy.spacing_m)
        for (const double z : floorsAt(scene, x, y, height)) {
          const Eigen::Vector3d centre(x, y, z + height);
          const auto ground = placement.groundBelow(centre);
          if (!ground || !ground->index || !isMadeForStanding(scene.environment().products[*ground->index])) continue;
          if (placement.worthTrying(centre) && !placement.whyNot(centre)) floors.emplace_back(x, y, z);
        }
    }
    std::stable_sort(floors.begin(), floors.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
    std::vector<FloorPlace> places;
    const std::size_t most = std::min(strategy.count, floors.size());
    for (std::size_t k = 0; k < most; ++k) {
      const auto& at = floors[k * floors.size() / most];
      places.push_back({at.x() + shift.x(), at.y() + shift.y(), at.z() + shift_z});
    }
    return places;
  }

  const RecipeEnvironment& environment_;
  std::uint64_t seed_;
  SetEnvironment& made_;
  Report& report_;
  std::shared_ptr<const Job> before_;  // of the project
};

// Refuses a map that no product has a rule in, and lists what each one has no rule for.
Result<void> checkMaps(const Recipe& recipe, const RecipeEnvironment& environment, SetEnvironment& made) {
  std::map<std::string, std::size_t> products;  // by class
  for (const auto& p : made.document.environment()->products)
    if (p.inScene()) ++products[p.ifc_class];
  for (const auto& classes : recipe.classes) {
    bool any = false;
    for (const auto& [ifc_class, count] : products) {
      if (classes.map.hasRuleFor(ifc_class))
        any = true;
      else
        made.unmapped.push_back(fmt::format("{}: {}", classes.id, ifc_class.empty() ? "(no class)" : ifc_class));
    }
    if (!any)
      return failure(
          ErrorKind::unusable,
          fmt::format("the classes '{}' map nothing of this model; choose other classes, or import a model with "
                      "IFC classes",
                      classes.id),
          environment.id);
  }
  return {};
}

// What the entries of the axis of materials come to in a model.
struct MaterialEntries {
  std::map<std::string, std::set<std::string>> licences;  // of the sources that figures come from, by material
  Json without_effect = Json::array();                    // selectors and rules that match nothing of it
};

// A recipe is for many models: what matches nothing of one is said, not refused.
void addWithoutEffect(const std::string& environment, const RecipeMaterials& entry,
                      const std::vector<MaterialFinding>& findings, MaterialEntries& all, Report& report) {
  const auto is_found = [&](const std::string& kind, const std::string& source) {
    return std::any_of(findings.begin(), findings.end(), [&](const MaterialFinding& f) {
      return f.kind == kind && (source.empty() || f.source == source);
    });
  };
  for (const auto& assigned : overridesFrom(entry.assign)) {
    if (assigned.material == "rules" || !is_found("selector", assigned.selector)) continue;
    all.without_effect.push_back({{"materials", entry.id}, {"assign", assigned.selector}});
    report.warn(environment, fmt::format("materials '{}': the selector {} matches no surface and has no effect",
                                         entry.id, assigned.selector));
  }
  if (entry.rules.empty() || !is_found("idle-rules", {})) return;
  const auto file = entry.rules.filename().string();
  all.without_effect.push_back({{"materials", entry.id}, {"rules", file}});
  report.warn(environment, fmt::format("materials '{}': none of the rules in {} match", entry.id, file));
}

Result<MaterialEntries> materialEntries(const Recipe& recipe, const std::string& environment, const Document& document,
                                        Report& report, Progress& progress) {
  MaterialEntries all;
  for (const auto& entry : recipe.materials) {
    TRY_ASSIGN(const auto assigned, withMaterials(document, entry, progress));
    const auto& result = assigned.materials->result;
    for (const auto& material : result.assignment.materials)
      for (const auto& source : material.sources)
        if (auto& of_material = all.licences[material.id]; !source.licence.empty()) of_material.insert(source.licence);
    addWithoutEffect(environment, entry, result.report.findings, all, report);
  }
  return all;
}

// Where it is on a map: the corners of its plan and its heights, in metres of the CRS; null where it is nowhere.
Json placeOnMap(const Document& document) {
  const auto& g = *document.georeference;
  if (g.crs.empty()) return nullptr;
  const Bounds box = bounds(sceneOf(*document.environment()));
  const auto onMap = [&](double x, double y, double z) -> Eigen::Vector3d {
    const Eigen::Vector3d file = Eigen::Vector3d(x, y, z) + g.shift_m;
    return g.map_from_file ? mapFromFile(*g.map_from_file, file) : file;
  };
  const auto whole_mm = [](double metres) { return std::round(metres * 1e3) / 1e3; };
  Json corners = Json::array();
  for (const auto& [x, y] : {std::pair(box.min.x(), box.min.y()), std::pair(box.max.x(), box.min.y()),
                             std::pair(box.max.x(), box.max.y()), std::pair(box.min.x(), box.max.y())}) {
    const auto at = onMap(x, y, box.min.z());
    corners.push_back({whole_mm(at.x()), whole_mm(at.y())});
  }
  return {{"crs", g.crs},
          {"corners", std::move(corners)},
          {"heights", {whole_mm(onMap(0, 0, box.min.z()).z()), whole_mm(onMap(0, 0, box.max.z()).z())}}};
}

Result<std::string> describedEnvironment(const Recipe& recipe, std::size_t index, const SetEnvironment& made,
                                         Report& report, Progress& progress) {
  const auto& environment = recipe.environments[index];
  const auto& document = made.document;
  const Eigen::Vector3d shift = document.georeference->shift_m;
  Json stations = Json::array(), empty = Json::array();
  std::size_t k = 0;
  for (const auto& place : placesOf(recipe)) {
    if (place.environment != index) continue;
    const auto station = made.station[k++];
    if (!station) {
      empty.push_back(place.station);
      continue;
    }
    const auto& s = document.job->stations[*station];
    const Eigen::Vector3d at = s.true_pose.translation + shift;
    stations.push_back({{"name", s.name}, {"at", {at.x(), at.y(), at.z()}}, {"height_m", s.instrument_height_m}});
  }
  Json json = {{"environment", environment.id},
               {"building", environment.building},
               {"split", recipe.splitOf(environment)},
               {"license", environment.license}};
  if (!environment.model.empty()) {
    TRY_ASSIGN(const auto sum, sha256OfFile(environment.model, progress));
    json["model"] = environment.model.filename().string();
    json["model_sha256"] = sum;
  } else {
    json["project"] = fs::absolute(environment.project).lexically_normal().filename().string();
  }
  const auto world = scanWorld(document.environment(), document.job->targets, document.materials->result.assignment);
  json["world"] = fmt::format("{:016x}", fingerprintOf(world));
  json["products"] = document.environment()->products.size();
  json["triangles"] = sceneTriangleCount(*document.environment());
  json["map"] = placeOnMap(document);
  TRY_ASSIGN(const auto entries, materialEntries(recipe, environment.id, document, report, progress));
  json["materials"] = Json::array();
  for (const auto& [id, texts] : entries.licences) json["materials"].push_back({{"id", id}, {"licenses", texts}});
  if (!entries.without_effect.empty()) json["without_effect"] = entries.without_effect;
  json["picture"] = {{"path", pictureFile(environment).generic_string()},
                     {"bytes", made.picture.size()},
                     {"sha256", sha256Of(made.picture)}};
  json["stations"] = std::move(stations);
  json["without_room"] = std::move(empty);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<Document> withMaterials(const Document& document, const RecipeMaterials& materials, Progress& progress) {
  MaterialRequest request;
  request.rules = materials.rules;
  request.assign = overridesFrom(materials.assign);
  TRY_ASSIGN(auto assigned, assignDocumentMaterials(document, request, progress));
  return std::move(assigned.document);
}

Result<SetEnvironment> openEnvironment(const Recipe& recipe, std::size_t index, Report& report, Progress& progress) {
  const auto& environment = recipe.environments[index];
  SetEnvironment made;
  TRY_ASSIGN(made.document, readEnvironment(environment, report, progress));
  if (!made.document.hasModel() || sceneTriangleCount(*made.document.environment()) == 0)
    return failure(ErrorKind::unusable, "there is nothing in its scene", environment.id);
  TRY(checkMaps(recipe, environment, made));
  if (!made.document.materials) {
    TRY_ASSIGN(made.document, withMaterials(made.document, {}, progress));
  }
  TRY_ASSIGN(made.scene, RayScene::build(made.document.environment(), progress));
  TRY(StationFinder(environment, recipe.seed, made, report).find(progress));
  made.picture = plansOf(made.document);
  TRY_ASSIGN(made.described, describedEnvironment(recipe, index, made, report, progress));
  return made;
}

}  // namespace standpoint

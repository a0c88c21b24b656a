// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/shortest_rotation.h"
#include "project/answers.h"
#include "project/survey_verbs.h"
#include "project/target_placing.h"
#include "project/target_sight.h"

namespace standpoint {

namespace {

using nlohmann::json;

json targetRow(const Target& t, const Georeference& g) {
  json row = {{"name", t.name},
              {"kind", t.kind == TargetKind::sphere ? "sphere" : "checkerboard"},
              {"at", toJson(t.centre + g.shift_m)},
              {"size", t.size_m}};
  if (t.kind == TargetKind::checkerboard) row["normal"] = toJson(t.normal);
  return row;
}

// Builds the rays' scene, which only adding and looking need.
Result<json> sightRows(const Document& document, const RayScene& scene, const TargetKinds& kinds,
                       const std::vector<Target>& targets, const TargetOptions& options, Report& report) {
  const SightRequest request{options.instrument, options.settings};
  json rows = json::object();
  for (const auto& t : targets) {
    TRY_ASSIGN(const auto sights, sightsOf(document, scene, t, kinds.rules, request));
    tell(t, sights, report);
    rows[t.name] = toJson(sights);
  }
  return rows;
}

Result<Target> addedTarget(const Document& document, const TargetOptions& options, Outcome& outcome,
                           Progress& progress) {
  TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
  TRY_ASSIGN(auto article, targetArticleFrom(kinds, options));
  const auto& targets = document.job->targets;
  if (std::any_of(targets.begin(), targets.end(), [&](const Target& t) { return t.name == article.name; }))
    return failure(ErrorKind::usage,
                   fmt::format("target '{}' already exists; remove it, or use another name", article.name));
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), progress));
  std::string stands;
  auto target = placedTarget(document, *scene, std::move(article), options, stands, outcome.report);
  if (!target) return target;
  TRY_ASSIGN(auto sights, sightRows(document, *scene, kinds, {*target}, options, outcome.report));
  outcome.answer["placed"] = targetRow(*target, *document.georeference);
  if (!stands.empty()) outcome.answer["placed"]["stands_on"] = stands;
  outcome.answer["seen_from"] = std::move(sights[target->name]);
  return target;
}

Result<json> sightsOfAll(const Document& document, const TargetOptions& options, Report& report, Progress& progress) {
  TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), progress));
  return sightRows(document, *scene, kinds, document.job->targets, options, report);
}

// A unit sphere by subdividing an icosahedron: faceting error 0.06 mm on a 145 mm sphere at 4 levels.
Mesh sphereMesh(float radius, std::uint32_t surface) {
  const float g = (1 + std::sqrt(5.0F)) / 2;
  std::vector<Eigen::Vector3f> p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (auto& v : p) v.normalize();
  std::vector<Triangle> t = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < 4; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
      if (fresh) p.push_back((p[a] + p[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : t) {
      const auto ab = between(a, b);
      const auto bc = between(b, c);
      const auto ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (auto& v : p) v *= radius;
  return {std::move(p), std::move(t), std::vector<std::uint32_t>(20U << 8U, surface)};
}

// A plate of four squares, white and black in turn, in the YZ plane facing +X.
Mesh checkerboardMesh(float size, std::uint32_t white, std::uint32_t black) {
  Mesh m;
  const float h = size / 2;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      m.positions.emplace_back(0, static_cast<float>(i - 1) * h, static_cast<float>(j - 1) * h);
  for (std::uint32_t j = 0; j < 2; ++j)
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t a = j * 3 + i;
      m.triangles.push_back({a, a + 1, a + 4});
      m.triangles.push_back({a, a + 4, a + 3});
      m.surface_of_triangle.insert(m.surface_of_triangle.end(), 2, (i + j) % 2 == 0 ? white : black);
    }
  sortBySurface(m);
  return m;
}

PhysicalMaterial paint(const char* id, const char* label, double reflectance) {
  PhysicalMaterial m;
  m.id = id;
  m.label = label;
  m.reflectance = {{550, reflectance}};
  m.sources = {{"reflectance", "unsourced: engineering value for matt target paint", ""}};
  return m;
}

}  // namespace

std::span<const Choice<TargetKind>> choices(TargetKind) {
  static constexpr std::array kKinds = {Choice<TargetKind>{"sphere", TargetKind::sphere},
                                        Choice<TargetKind>{"checkerboard", TargetKind::checkerboard}};
  return kKinds;
}

const Fields<TargetOptions>& targetFields() {
  using O = TargetOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new target"},
      {"remove", &O::remove, "name of the target to remove"},
      {"at", &O::at, "X,Y,Z of its centre, in the file's frame", {.unit = "m"}},
      {"on", &O::on, "X,Y[,Z] of the floor for its tripod or pole; without Z the lowest with room", {.unit = "m"}},
      {"height", &O::height_m, "height of its centre above that floor", {.unit = "m", .minimum = 0.05, .maximum = 5}},
      {"on-surface", &O::on_surface, "X,Y,Z near the wall, column or ceiling to attach it to", {.unit = "m"}},
      {"stand-off",
       &O::stand_off_m,
       "depth of a magnetic base or bracket between surface and target",
       {.unit = "m", .minimum = 0, .maximum = 1}},
      {"type", &O::type,
       "article of scanners/targets/kinds.json: sphere-145, sphere-200, sphere-139, paper-150, bw-114, bw-152"},
      {"kind", &O::kind, "kind of target where no article is named"},
      {"size", &O::size_m, "diameter or side (default: the article's)", {.unit = "m", .minimum = 0.01, .maximum = 2}},
      {"normal", &O::normal, "direction that a checkerboard faces (default on a tripod: the nearest station)"},
      {"sight", &O::sight, "list how each station sees each target"},
      {"instrument", &O::instrument, "id of the measuring instrument (default: those used for scanning)"},
      {"set", &O::settings, "settings of the instrument, as of scan"}};
  return fields;
}

Result<Outcome> runTarget(const Document& document, const TargetOptions& options, Progress& progress) {
  progress.stage("Target");
  if (options.add && options.remove) return failure(ErrorKind::usage, "specify one of --add NAME, --remove NAME");
  Outcome outcome{document, json::object(), {}, {}};
  Job job = *document.job;
  const auto& g = *document.georeference;
  const auto find = [&](const std::string& wanted) {
    return std::find_if(job.targets.begin(), job.targets.end(), [&](const Target& t) { return t.name == wanted; });
  };
  if (options.add) {
    auto target = addedTarget(document, options, outcome, progress);
    if (!target) return failure(target.error());
    outcome.description = "Added target " + target->name;
    job.targets.push_back(*std::move(target));
  } else if (options.remove) {
    const auto at = find(*options.remove);
    if (at == job.targets.end()) return failure(ErrorKind::usage, fmt::format("unknown target '{}'", *options.remove));
    outcome.description = "Removed target " + at->name;
    job.targets.erase(at);
  } else if (options.sight) {
    TRY_ASSIGN(auto sights, sightsOfAll(document, options, outcome.report, progress));
    outcome.answer["seen_from"] = std::move(sights);
  }
  json rows = json::array();
  for (const auto& t : job.targets) rows.push_back(targetRow(t, g));
  outcome.answer["targets"] = std::move(rows);
  if (!outcome.description.empty()) outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

ScanWorld scanWorld(const Document& document, const MaterialAssignment& assignment) {
  if (document.job->targets.empty()) return {document.environment(), assignment};
  auto environment = std::make_shared<Environment>(*document.environment());
  ScanWorld world{nullptr, assignment};
  const auto white = static_cast<std::uint32_t>(environment->surfaces.size());
  environment->surfaces.push_back({"target white", {1, 1, 1, 1}, "target", {}, {}});
  environment->surfaces.push_back({"target black", {0.05F, 0.05F, 0.05F, 1}, "target", {}, {}});
  const auto white_paint = static_cast<std::int32_t>(world.assignment.materials.size());
  world.assignment.materials.push_back(paint("target_white", "Target, matt white", 0.9));
  world.assignment.materials.push_back(paint("target_black", "Target, matt black", 0.05));
  for (const auto& t : document.job->targets) {
    const auto product = static_cast<std::uint32_t>(environment->products.size());
    Product p;
    p.id = "target " + t.name;
    p.name = t.name;
    p.ifc_class = "Target";
    environment->products.push_back(std::move(p));
    const auto size = static_cast<float>(t.size_m);
    Instance i;
    i.mesh = static_cast<std::uint32_t>(environment->meshes.size());
    i.product = product;
    i.world_from_mesh = Eigen::Translation3d(t.centre) * shortestRotation(Eigen::Vector3d::UnitX(), t.normal);
    environment->meshes.push_back(std::make_shared<const Mesh>(
        t.kind == TargetKind::sphere ? sphereMesh(size / 2, white) : checkerboardMesh(size, white, white + 1)));
    environment->instances.push_back(i);
    world.assignment.surfaces.push_back({product, white, white_paint, "target", 1});
    if (t.kind == TargetKind::checkerboard)
      world.assignment.surfaces.push_back({product, white + 1, white_paint + 1, "target", 1});
  }
  world.environment = std::move(environment);
  return world;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/output_place.h"
#include "core/split_by_material.h"
#include "core/unused_meshes.h"
#include "core/visible_colour.h"
#include "importers/gltf/gltf_writer.h"
#include "importers/helios/helios_writer.h"
#include "importers/ifc/writer/ifc_writer.h"
#include "importers/obj/obj_writer.h"
#include "project/dataset/program_version.h"
#include "project/model/optimize_verb.h"
#include "project/storage/project_json.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr double kNoLimit = 1000;  // m: a level of detail is bought with deviation, which is measured and written

std::string lowerExtension(const fs::path& file) {
  auto extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

Result<std::vector<std::uint64_t>> budgetsOf(const std::vector<std::string>& texts, std::uint64_t triangles) {
  std::vector<std::uint64_t> budgets;
  for (const auto& text : texts) {
    std::uint64_t value = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (wrong != std::errc() || end != text.data() + text.size() || value == 0)
      return failure(ErrorKind::usage, fmt::format("'{}' is not a triangle count", text), "--levels");
    const auto before = budgets.empty() ? triangles : budgets.back();
    if (value >= before)
      return failure(ErrorKind::usage,
                     fmt::format("each level of detail must have fewer triangles than the previous one: {} follows {}",
                                 value, before),
                     "--levels");
    budgets.push_back(value);
  }
  return budgets;
}

// The levels with the environments that they point to.
struct Levels {
  std::vector<std::unique_ptr<Environment>> environments;
  std::vector<GltfLevel> levels;
  std::vector<ExportLevel> answer;
};

Result<Levels> makeLevels(const Document& document, const std::vector<std::uint64_t>& budgets, Report& report,
                          Progress& progress) {
  Levels result;
  for (const auto budget : budgets) {
    SimplificationRequest request;
    request.budget = budget;
    request.max_deviation_m = kNoLimit;
    TRY_ASSIGN(const auto plan, planLightening(document, request, progress));
    TRY_ASSIGN(auto lighter, optimize(*document.imported, plan.options, progress));
    result.environments.push_back(std::make_unique<Environment>(sceneOf(lighter.environment)));
    GltfLevel level{fmt::format("LOD{}: {} triangles", result.levels.size() + 1, lighter.all.triangles_after),
                    result.environments.back().get(),
                    {},
                    {}};
    for (const auto& loss : lighter.products) {
      level.max_deviation_m.push_back(loss.max_deviation_m);
      level.mean_deviation_m.push_back(loss.mean_deviation_m);
    }
    if (!lighter.budget_reached)
      report.warn("--levels",
                  fmt::format("cannot reach {} triangles; the level has {}", budget, lighter.all.triangles_after));
    result.answer.push_back({lighter.all.triangles_after, lighter.all.max_deviation_m, lighter.all.mean_deviation_m});
    result.levels.push_back(std::move(level));
  }
  return result;
}

GltfCollision collisionOf(const CollideResult& collision, const Environment& shapes, CollisionNaming naming) {
  GltfCollision result{&shapes, {}, naming};
  for (const auto& shape : collision.shapes) result.convex.push_back(shape.kind != CollisionShapeKind::mesh);
  return result;
}

// Unreal makes a hull of each shape, which would fill what is hollow, so a shape that is not convex stays out: its mesh
// is to collide with its own triangles there. Returns how many do.
std::size_t noteWithoutHull(const CollideResult& collision, const Environment& model, Report& report) {
  constexpr std::size_t kNamed = 10;
  std::size_t shapes = 0;
  std::vector<std::uint32_t> products;  // shapes are sorted by them
  for (const auto& shape : collision.shapes) {
    if (shape.kind != CollisionShapeKind::mesh) continue;
    ++shapes;
    if (products.empty() || products.back() != shape.product) products.push_back(shape.product);
  }
  if (shapes == 0) return 0;
  std::string names;
  for (std::size_t k = 0; k < std::min(products.size(), kNamed); ++k) {
    const auto& product = model.products[products[k]];
    names += (k == 0 ? "" : ", ") + (product.name.empty() ? product.id : product.name);
  }
  if (products.size() > kNamed) names += ", …";
  report.warn(
      "--collision",
      fmt::format("collision shapes that are not convex, which Unreal would fill to a hull, were not exported: "
                  "{} of {} products ({}); in Unreal, set the Collision Complexity of these meshes to Use Complex "
                  "Collision As Simple",
                  shapes, products.size(), names));
  return shapes;
}

std::uint64_t sizeWithCompanions(const fs::path& file) {
  const auto extension = lowerExtension(file);
  std::vector<fs::path> files = {file};
  if (extension == ".gltf") files.push_back(fs::path(file).replace_extension(".bin"));
  if (extension == ".obj") files.push_back(fs::path(file).replace_extension(".mtl"));
  return sizeOf(files);
}

// One for each surface; empty where the project has no materials.
std::vector<const PhysicalMaterial*> physicalSurfaces(const Document& document,
                                                      std::span<Environment* const> environments, LooksOfSplit looks) {
  std::vector<const PhysicalMaterial*> physical;
  if (!document.materials) return physical;
  const auto& assignment = document.materials->result.assignment;
  for (const auto material : splitByMaterial(environments, assignment, looks))
    physical.push_back(material < 0 ? nullptr : &assignment.materials[static_cast<std::size_t>(material)]);
  return physical;
}

Result<void> exportGltf(const Document& document, Environment& scene, const fs::path& file,
                        const ExportOptions& options, Answered<ExportAnswer>& outcome, Progress& progress) {
  GltfCompanions companions;
  TRY_ASSIGN(const auto budgets, budgetsOf(options.levels, triangleCount(scene)));
  TRY_ASSIGN(auto levels, makeLevels(document, budgets, outcome.report, progress));
  companions.levels = std::move(levels.levels);
  std::vector<Environment*> all = {&scene};
  for (const auto& environment : levels.environments) all.push_back(environment.get());
  companions.physical = physicalSurfaces(document, all, LooksOfSplit::kept);
  outcome.answer.levels = std::move(levels.answer);
  Environment shapes;
  if (options.collision) {
    if (!document.collision)
      return failure(ErrorKind::usage, "there are no collision shapes; compute them first", "--collision");
    shapes = collisionEnvironment(*document.collision);
    companions.collision = collisionOf(*document.collision, shapes, *options.collision);
    outcome.answer.collision_shapes = shapes.instances.size();
    if (*options.collision == CollisionNaming::unreal)
      *outcome.answer.collision_shapes -= noteWithoutHull(*document.collision, scene, outcome.report);
  }
  return exportEnvironmentGltf(scene, *document.georeference, file, progress, companions);
}

// The physical materials instead of the looks.
Result<void> exportPhysical(const Document& document, Environment& scene, const fs::path& file, bool helios,
                            Report& report, Progress& progress) {
  if (!document.materials) return failure(ErrorKind::usage, "there are no materials; assign them first", file.string());
  const std::array all = {&scene};
  const auto physical = physicalSurfaces(document, all, LooksOfSplit::left_out);
  if (helios) return writeHeliosScene(scene, physical, *document.georeference, file, report, progress);
  for (std::size_t i = 0; i < physical.size(); ++i) {
    if (physical[i] == nullptr) continue;
    auto& surface = scene.surfaces[i];
    surface.name = physical[i]->id;
    surface.colour = visibleColour(*physical[i]);
    if (!physical[i]->transmittance.empty()) surface.colour.a = 0.3F;
  }
  return writeEnvironmentObj(scene, *document.georeference, file, progress);
}

// Rooms are in it, too: their class says that nobody walks into them.
Result<void> exportIfc(const Document& document, Environment& all, const fs::path& file,
                       Answered<ExportAnswer>& outcome, Progress& progress) {
  const std::array environments = {&all};
  const auto physical = physicalSurfaces(document, environments, LooksOfSplit::kept);
  const fs::path named = document.sources.empty() ? file : fs::path(document.sources.front());
  TRY_ASSIGN(const auto summary, writeIfc(all, physical, *document.georeference, file, named.stem().string(),
                                          fmt::format("Standpoint {}", programVersion()), outcome.report, progress));
  outcome.answer.triangles = summary.triangles;
  outcome.answer.schema = summary.schema;
  return {};
}

}  // namespace

std::span<const Choice<CollisionNaming>> choices(CollisionNaming) {
  static constexpr std::array kNamings = {Choice<CollisionNaming>{"unreal", CollisionNaming::unreal},
                                          Choice<CollisionNaming>{"godot", CollisionNaming::godot},
                                          Choice<CollisionNaming>{"physics", CollisionNaming::physics}};
  return kNamings;
}

const Fields<ExportOptions>& exportFields() {
  using O = ExportOptions;
  static const Fields<O> fields = {
      {"output",
       &O::output,
       "file to write (.ifc, .glb, .gltf, .obj; .xml for HELIOS++)",
       {.required = true, .label = "File"}},
      {"physical",
       &O::physical,
       "OBJ only: write the assigned materials, as a scanner sees them, instead of the appearance",
       {.label = "Assigned materials", .term = "physical materials: reflectance, roughness, transmittance"}},
      {"levels",
       &O::levels,
       "glTF only: triangles of each simpler version of the model, from fine to coarse: 10000 2000",
       {.label = "Simpler versions", .term = "levels of detail, glTF extension MSFT_lod"}},
      {"collision",
       &O::collision,
       "glTF only: add the collision shapes, named for an engine",
       {.label = "Collision shapes",
        .term = "names that Unreal or Godot read, or extension KHR_physics_rigid_bodies"}}};
  return fields;
}

const AnswerFields<ExportLevel>& answerFields(const ExportLevel*) {
  using A = ExportLevel;
  static const AnswerFields<A> fields = {{"triangles", &A::triangles},
                                         {"max_deviation_m", &A::max_deviation_m},
                                         {"mean_deviation_m", &A::mean_deviation_m}};
  return fields;
}

const AnswerFields<ExportAnswer>& answerFields(const ExportAnswer*) {
  using A = ExportAnswer;
  static const AnswerFields<A> fields = {{"file", &A::file},
                                         {"triangles", &A::triangles},
                                         {"bytes", &A::bytes},
                                         {"schema", &A::schema, kLeftOut},
                                         {"levels", &A::levels, kLeftOut},
                                         {"collision_shapes", &A::collision_shapes, kLeftOut}};
  return fields;
}

Result<Answered<ExportAnswer>> runExport(const Document& document, const ExportOptions& options, Progress& progress) {
  const fs::path& file = options.output;
  progress.stage("Export " + file.filename().string());
  const auto extension = lowerExtension(file);
  const bool gltf = extension == ".glb" || extension == ".gltf", helios = extension == ".xml";
  const bool ifc = extension == ".ifc";
  const bool physical = options.physical;
  if (!gltf && !helios && !ifc && extension != ".obj")
    return failure(ErrorKind::usage,
                   fmt::format("unsupported format '{}'; use .ifc, .glb, .gltf, .obj, or .xml for HELIOS++", extension),
                   "--output");
  if (physical && extension != ".obj")
    return failure(
        ErrorKind::usage,
        "this option applies to .obj only; IFC, glTF and HELIOS++ scenes always contain the physical materials",
        "--physical");
  if (!gltf && (!options.levels.empty() || options.collision))
    return failure(ErrorKind::usage, "levels of detail and collision shapes can be exported to .glb or .gltf only",
                   "--output");
  TRY(checkFolderOf(file, "--output"));
  Environment scene = ifc ? *document.environment() : sceneOf(*document.environment());
  dropUnusedMeshes(scene);
  Answered<ExportAnswer> outcome{document, {file, triangleCount(scene)}};
  TRY(ifc                  ? exportIfc(document, scene, file, outcome, progress)
      : gltf               ? exportGltf(document, scene, file, options, outcome, progress)
      : helios || physical ? exportPhysical(document, scene, file, helios, outcome.report, progress)
                           : writeEnvironmentObj(scene, *document.georeference, file, progress));
  if (const auto left_out = document.environment()->instances.size() - scene.instances.size(); left_out > 0)
    outcome.report.note(
        "spaces", fmt::format("{} bodies outside the scene (spaces, excluded products) were not exported", left_out));
  outcome.answer.bytes = sizeWithCompanions(file);
  outcome.description = "Exported " + file.filename().string();
  return outcome;
}

}  // namespace standpoint

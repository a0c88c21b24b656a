// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <map>
#include <string>
#include <tuple>

#include <tbb/parallel_for.h>

#include "importers/ifc/body.h"
#include "importers/ifc/georeference.h"
#include "importers/ifc/mapping.h"
#include "importers/ifc/product.h"
#include "importers/ifc/style.h"
#include "importers/importers.h"

namespace standpoint {
namespace ifc {
namespace {

// Surfaces and meshes of the environment, each kept once.
class Assembly {
 public:
  Assembly(const Model& model, const Relations& relations, Environment& environment)
      : model_(model), relations_(relations), environment_(environment), style_of_material_(stylesOfMaterials(model.file)) {}

  void add(std::uint32_t product, const Entity& entity, const std::vector<PlacedBody>& bodies, const Eigen::Vector3d& shift) {
    const ProductMaterials materials = materialsOf(entity, relations_, model_);
    for (const PlacedBody& placed : bodies) {
      const Body& body = *placed.body;
      Instance instance;
      instance.product = product;
      instance.mesh = mesh(placed, materials);
      Eigen::Affine3d t = placed.file_from_items;
      t.translation() = placed.file_from_items * body.origin - shift;
      instance.world_from_mesh = t;
      environment_.instances.push_back(instance);
    }
  }

 private:
  std::uint32_t mesh(const PlacedBody& placed, const ProductMaterials& materials) {
    std::map<std::uint32_t, std::uint32_t> surface_of_tag;
    for (const std::uint32_t tag : placed.body->tags)
      if (!surface_of_tag.contains(tag)) surface_of_tag.emplace(tag, surface(tag ? tag : placed.style, materials));
    std::vector<std::uint32_t> key;
    for (const auto& [tag, index] : surface_of_tag) key.push_back(index);
    const auto [it, is_new] = meshes_.try_emplace({placed.body.get(), key}, static_cast<std::uint32_t>(environment_.meshes.size()));
    if (!is_new) return it->second;
    auto m = std::make_shared<Mesh>();
    m->positions = placed.body->positions;
    m->triangles = placed.body->triangles;
    for (const std::uint32_t tag : placed.body->tags) m->surface_of_triangle.push_back(surface_of_tag.at(tag));
    sortBySurface(*m);
    environment_.meshes.push_back(std::move(m));
    return it->second;
  }

  // The material's name with the style's colour. Of several materials that are no layers the style tells which is meant.
  std::uint32_t surface(std::uint32_t tag, const ProductMaterials& materials) {
    std::size_t which = 0;
    bool sure = materials.layered || materials.names.size() == 1;
    auto style = styleOfTag(model_.file, tag);
    for (std::size_t i = 0; style && !sure && i < materials.names.size(); ++i) {
      const auto of_material = style_of_material_.find(materials.ids[i]);
      if (materials.names[i] == style->name || (of_material != style_of_material_.end() && of_material->second == tag)) which = i, sure = true;
    }
    if (!style && !materials.ids.empty())
      if (const auto of_material = style_of_material_.find(materials.ids[which]); of_material != style_of_material_.end()) style = styleOfTag(model_.file, of_material->second);
    Surface s;
    if (style) s.colour = style->colour, s.name = style->name;
    if (!materials.names.empty() && (sure || s.name.empty())) s.name = materials.names[which], s.source = "#" + std::to_string(materials.ids[which]);
    else if (tag != kNoStyle && tag < kFirstColour) s.source = "#" + std::to_string(tag);
    const auto key = std::make_tuple(s.name, s.colour.r, s.colour.g, s.colour.b, s.colour.a);
    const auto [it, is_new] = surfaces_.try_emplace(key, static_cast<std::uint32_t>(environment_.surfaces.size()));
    if (is_new) environment_.surfaces.push_back(std::move(s));
    return it->second;
  }

  const Model& model_;
  const Relations& relations_;
  Environment& environment_;
  std::map<Id, Id> style_of_material_;
  std::map<std::tuple<std::string, float, float, float, float>, std::uint32_t> surfaces_;
  std::map<std::pair<const Body*, std::vector<std::uint32_t>>, std::uint32_t> meshes_;   // looked up, never walked
};

Bounds placedBounds(const Bodies& bodies) {
  Bounds all;
  for (const auto& of_product : bodies.of_product)
    for (const PlacedBody& b : of_product)
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d &lo = b.body->bounds.min, &hi = b.body->bounds.max;
        all.extend(b.file_from_items * Eigen::Vector3d(corner & 1 ? hi.x() : lo.x(), corner & 2 ? hi.y() : lo.y(), corner & 4 ? hi.z() : lo.z()));
      }
  return all;
}

std::vector<Product> describeAll(const std::vector<Entity>& entities, const Relations& relations, const Model& model) {
  std::vector<Product> products(entities.size());
  tbb::parallel_for(std::size_t{0}, entities.size(), [&](std::size_t i) { products[i] = describeProduct(entities[i], relations, model); });
  return products;
}

Result<ImportedModel> readIfc(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  ImportedModel result;
  progress.stage("Reading", 0, 0.2);
  auto file = StepFile::read(path, result.report);
  if (!file) return failure(file.error());
  if (auto go = progress.check(); !go) return failure(go.error());
  const Model model{*file, readUnits(*file, result.report), {options.chord_error_m, options.max_segment_angle_rad}, mappingOfTypes(*file),
                    stylesOfItems(*file), colourMaps(*file), newCurveCache()};
  for (const Entity& cant : file->all("IFCSEGMENTEDREFERENCECURVE")) result.report.warn(cant.place(), "the cant of the alignment is not followed");
  const Relations relations(*file);
  const std::vector<Entity> entities = productEntities(*file);
  auto bodies = buildBodies(entities, relations, model, progress);
  if (!bodies) return failure(bodies.error());
  progress.stage("Properties", 0.95, 1);
  Environment& environment = result.environment;
  environment.products = describeAll(entities, relations, model);
  environment.spatial = spatialTree(model, relations, result.report);
  linkProducts(environment.products, entities, environment.spatial, relations, *file);
  result.georeference = readGeoreference(model, relations, result.report);
  result.georeference.shift_m = chooseShift(options, placedBounds(*bodies));
  Assembly assembly(model, relations, environment);
  for (std::size_t i = 0; i < entities.size(); ++i) assembly.add(static_cast<std::uint32_t>(i), entities[i], bodies->of_product[i], result.georeference.shift_m);
  result.report.append(bodies->report);
  if (auto go = progress.check(); !go) return failure(go.error());
  if (const std::string wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, path.filename().string());
  return result;
}

constexpr std::array<const char*, 2> kExtensions{".ifc", ".ifczip"};

}  // namespace
}  // namespace ifc

extern const Importer kIfcImporter;
constinit const Importer kIfcImporter{"ifc", "Industry Foundation Classes, STEP physical file (ISO 16739)", ifc::kExtensions, ifc::readIfc};

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <string>

#include <tbb/parallel_for.h>

#include "importers/files/importer.h"
#include "importers/ifc/assembly.h"
#include "importers/ifc/body.h"
#include "importers/ifc/georeference.h"
#include "importers/ifc/model/style.h"
#include "importers/ifc/product.h"
#include "importers/ifc/properties.h"
#include "importers/ifc/shapes/mapping.h"

namespace standpoint {
namespace ifc {
namespace {

Bounds placedBounds(const Bodies& bodies, const Eigen::Affine3d& up) {
  Bounds all;
  for (const auto& of_product : bodies.of_product)
    for (const PlacedBody& b : of_product)
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d &lo = b.body->bounds.min, &hi = b.body->bounds.max;
        all.extend(
            up * b.file_from_items *
            Eigen::Vector3d(corner & 1 ? hi.x() : lo.x(), corner & 2 ? hi.y() : lo.y(), corner & 4 ? hi.z() : lo.z()));
      }
  return all;
}

// Y becomes Z in a file whose Y points up, against the schema.
Eigen::Affine3d standing(const ImportOptions& options) {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  if (options.up == UpAxis::y) t.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return t;
}

// In blocks, so that sets which a small file shares among many products are noticed before they fill the memory.
std::vector<Product> describeAll(const std::vector<Entity>& entities, const Relations& relations, const Model& model,
                                 Report& report) {
  constexpr std::size_t kBlock = 256;
  std::vector<Product> products(entities.size());
  std::size_t properties = 0, bare = 0;
  for (std::size_t begin = 0; begin < entities.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, entities.size());
    const bool full = properties > kMostPropertiesInAll;
    tbb::parallel_for(begin, end,
                      [&](std::size_t i) { products[i] = describeProduct(entities[i], !full, relations, model); });
    for (std::size_t i = begin; i < end; ++i) {
      properties += products[i].properties.size();
      if (products[i].properties.size() >= kMostProperties)
        report.lose(entities[i].place(), "has more than 10 000 properties; the rest were skipped");
    }
    if (full) bare += end - begin;
  }
  if (bare > 0)
    report.lose("model",
                "more than 5 000 000 properties in total; those of " + std::to_string(bare) + " products were skipped");
  return products;
}

Result<ImportedModel> readIfc(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  ImportedModel result;
  progress.stage("Reading", 0, 0.2);
  TRY_ASSIGN(auto file, StepFile::read(path, result.report));
  TRY(progress.check());
  const TextureMaps textures(file);
  const Model model{file,
                    readUnits(file, options.metres_per_unit, result.report),
                    {options.chord_error_m, options.max_segment_angle_rad},
                    mappingOfTypes(file),
                    textures,
                    ShapeAspects(file),
                    stylesOfItems(file, textures),
                    colourMaps(file),
                    newCurveCache()};
  const Relations relations(file);
  const std::vector<Entity> entities = productEntities(file, relations, options.types);
  TRY_ASSIGN(auto bodies, buildBodies(entities, relations, model, progress));
  progress.stage("Properties", 0.95, 1);
  Environment& environment = result.environment;
  environment.products = describeAll(entities, relations, model, result.report);
  environment.spatial = spatialTree(model, relations, result.report);
  tellCircles(relations, file, result.report);
  linkProducts(environment.products, entities, environment.spatial, relations, file);
  result.georeference = readGeoreference(model, relations, result.report);
  result.metres_per_unit = model.units.length_m;
  result.georeference.shift_m = chooseShift(options, placedBounds(bodies, standing(options)));
  Assembly assembly(model, relations, environment, standing(options), path.parent_path(), result.report);
  for (std::size_t i = 0; i < entities.size(); ++i)
    assembly.add(static_cast<std::uint32_t>(i), entities[i], bodies.of_product[i], result.georeference.shift_m);
  result.report.append(bodies.report);
  if (!bodies.any) tellUnplacedBodies(relations, model, result.report);
  TRY(progress.check());
  if (const std::string wrong = validate(environment); !wrong.empty())
    return failure(ErrorKind::internal, wrong, path.filename().string());
  return result;
}

constexpr std::array<const char*, 2> kExtensions{".ifc", ".ifczip"};

}  // namespace
}  // namespace ifc

extern const Importer kIfcImporter;
constinit const Importer kIfcImporter{"ifc", "Industry Foundation Classes, STEP physical file (ISO 16739)",
                                      ifc::kExtensions, ifc::readIfc, UpAxis::z};

}  // namespace standpoint

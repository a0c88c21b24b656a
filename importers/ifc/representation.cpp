// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/representation.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string>

#include "importers/ifc/model/style.h"
#include "importers/ifc/shapes/mapping.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

constexpr std::size_t kMostParts = 1'000'000;  // of one product: mapped items multiply

bool hasBody(const Entity& representation, const Model& model, int depth) {
  for (const Entity& e : representation.refs(3)) {
    if (e.is("IFCMAPPEDITEM")) {
      if (depth < 16 && hasBody(e.ref(0).ref(1), model, depth + 1)) return true;
    } else if (e.is("IFCGEOMETRICSET")) {  // only its surfaces are a body
      const auto elements = e.refs(0);
      if (std::any_of(elements.begin(), elements.end(), [&](const Entity& part) {
            const Mapping* m = model.mapping_of_type[part.type()];
            return m && m->item;
          }))
        return true;
    } else if (const Mapping* m = model.mapping_of_type[e.type()]; m && m->item) {
      return true;
    }
  }
  return false;
}

// Smaller is better. What only stands for the body (the room it needs, its box) is never taken for it; a solid that
// some exporter files under "Axis" is taken when there is nothing else.
int rank(const Entity& representation) {
  const std::string id = representation[1].text();
  constexpr std::array kNever{"Box", "Annotation", "Reference", "Clearance", "CoG", "Lighting", "SurveyPoints"};
  constexpr std::array kLast{"Axis", "FootPrint", "Plan", "Profile"};
  if (id == "Body") return 0;
  if (id == "Facetation" || id == "Tessellation" || id == "Mesh" || id == "Body-FallBack") return 1;
  if (std::find(kNever.begin(), kNever.end(), id) != kNever.end()) return 9;
  return std::find(kLast.begin(), kLast.end(), id) != kLast.end() ? 3 : 2;
}

Entity bestOf(const std::vector<Entity>& representations, const Model& model) {
  Entity best;
  int best_rank = 9;
  for (const Entity& r : representations)
    if (const int k = rank(r); k < best_rank && hasBody(r, model, 0)) best = r, best_rank = k;
  return best;
}

struct Walk {
  Scope& scope;
  std::vector<Part> parts;

  Result<void> representation(const Entity& r, const Eigen::Affine3d& placed, std::uint32_t style, int depth) {
    if (depth > 24) return fail(r, "mapped items nest too deeply or form a cycle");
    bool direct = false;
    for (const Entity& e : r.refs(3)) {
      if (!e.is("IFCMAPPEDITEM")) {
        direct = true;
        continue;
      }
      const std::uint32_t part = scope.model.aspects.tagOf(e),
                          own = part ? part : scope.model.style_of_item[scope.model.file.indexOf(e)];
      const Entity map = e.ref(0);
      if (!map.ref(1)) {
        scope.report.lose(e.place(), "the mapped item has no representation");
        continue;
      }
      const Eigen::Affine3d next =
          placed * transformationOperator(e.ref(1), scope) * Eigen::Affine3d(axisPlacement(map.ref(0), scope));
      if (auto done = representation(map.ref(1), next, own ? own : style, depth + 1); !done) return done;
    }
    if (direct) parts.push_back({r.id(), placed, style});
    if (parts.size() > kMostParts) return fail(r, "mapped items produce too many instances");
    return scope.spend(1) ? Result<void>{} : fail(r, "mapped items produce too many instances");
  }
};

void appendItem(Items& items, const Entity& e, Scope& scope) {
  const Mapping* mapping = scope.model.mapping_of_type[e.type()];
  const bool flat = !mapping || !mapping->item;
  auto mesh = item(e, scope);
  if (!mesh) {
    // Curves and points beside a body are drawing, not body.
    if (flat)
      items.report.note(e.place(), std::string(e.typeName()) + " is not a supported solid or surface and was skipped");
    else
      items.report.lose(mesh.error().source.empty() ? e.place() : mesh.error().source,
                        e.place() + " has no geometry: " + mesh.error().message);
    return;
  }
  const std::uint32_t part = scope.model.aspects.tagOf(e), style = part ? part : styleOf(e, scope.model);
  for (auto& face : mesh->faces)
    if (face.tag == kNoStyle) face.tag = style;
  items.meshes.push_back(std::move(*mesh));
}

}  // namespace

Result<std::vector<Part>> partsOfShape(const Entity& shape, Scope& scope) {
  Walk walk{scope, {}};
  const Entity body = bestOf(shape.refs(2), scope.model);
  if (!body) return walk.parts;
  TRY(walk.representation(body, Eigen::Affine3d::Identity(), kNoStyle, 0));
  return walk.parts;
}

Result<std::vector<Part>> partsOfType(const Entity& type, Scope& scope) {
  Walk walk{scope, {}};
  const std::vector<Entity> maps = type.refs(6);
  std::vector<Entity> representations;
  for (const Entity& map : maps) representations.push_back(map.ref(1));
  const Entity body = bestOf(representations, scope.model);
  for (const Entity& map : maps)
    if (body && map.ref(1) == body) {
      const Eigen::Affine3d placed(axisPlacement(map.ref(0), scope));
      TRY(walk.representation(body, placed, kNoStyle, 0));
      break;
    }
  return walk.parts;
}

Items itemsOf(const Entity& representation, const Model& model) {
  Items items;
  Scope scope(model);
  for (const Entity& e : representation.refs(3)) {
    if (e.is("IFCMAPPEDITEM")) continue;
    try {
      appendItem(items, e, scope);
    } catch (const std::exception& problem) {  // a library's, or no memory: this item is lost, not the file
      items.report.lose(e.place(), std::string("has no geometry: ") + problem.what());
      scope.depth = 0;
    }
  }
  items.report.append(scope.report);
  items.repairs = scope.repairs;
  return items;
}

}  // namespace standpoint::ifc

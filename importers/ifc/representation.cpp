// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/representation.h"

#include <algorithm>
#include <array>
#include <exception>
#include <set>
#include <string>

#include "importers/ifc/model/style.h"
#include "importers/ifc/shapes/mapping.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

constexpr std::size_t kMostParts = 1'000'000;  // of one product: mapped items multiply

// The first item for which that holds: direct ones, the parts of sets and what is mapped, each representation once.
template <class Condition>
Entity firstItem(const Entity& representation, const Condition& holds) {
  std::vector<Entity> open{representation};
  std::set<Id> seen;
  while (!open.empty()) {
    const Entity at = open.back();
    open.pop_back();
    for (const Entity& e : at.refs(at.is("IFCGEOMETRICSET") ? 0 : 3)) {
      if (e.is("IFCGEOMETRICSET")) {  // only its surfaces are a body
        if (seen.insert(e.id()).second) open.push_back(e);
      } else if (e.is("IFCMAPPEDITEM")) {
        if (const Entity mapped = e.ref(0).ref(1); seen.insert(mapped.id()).second) open.push_back(mapped);
      } else if (holds(e)) {
        return e;
      }
    }
  }
  return {};
}

bool hasBody(const Entity& representation, const Model& model) {
  return static_cast<bool>(firstItem(representation, [&](const Entity& e) {
    const Mapping* m = model.mapping_of_type[e.type()];
    return m && m->item;
  }));
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
    if (const int k = rank(r); k < best_rank && hasBody(r, model)) best = r, best_rank = k;
  return best;
}

struct Walk {
  Scope& scope;
  std::vector<Part> parts;

  void lookForNothing(const Entity& r) {
    if (const Value nothing = r.dangling(3); nothing.present()) scope.misread(r, "refers to " + notInFile(nothing));
  }

  Result<void> representation(const Entity& r, const Eigen::Affine3d& placed, std::uint32_t style, int depth) {
    if (depth > 24) return fail(r, "mapped items nest too deeply or form a cycle");
    lookForNothing(r);
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
        scope.misread(e, "the mapped item has no representation");
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
  const bool flat = (!mapping || !mapping->item) && !isUnreadBody(e, scope.model);
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
  if (const Value nothing = shape.dangling(2); nothing.present())
    scope.misread(shape, "refers to " + notInFile(nothing));
  const Entity body = bestOf(shape.refs(2), scope.model);
  if (!body) {
    for (const Entity& r : shape.refs(2)) walk.lookForNothing(r);
    return walk.parts;
  }
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

std::string unreadBodyOf(const Entity& shape, const Model& model) {
  for (const Entity& representation : shape.refs(2))
    if (const Entity e = firstItem(representation, [&](const Entity& i) { return isUnreadBody(i, model); }))
      return std::string(e.typeName());
  return {};
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
  if (scope.unread)
    items.report.lose(scope.unread->source, scope.unread->message + "; the shape is not as it was meant");
  items.repairs = scope.repairs;
  return items;
}

}  // namespace standpoint::ifc

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/mapping.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/profile.h"
#include "importers/ifc/shapes/solid.h"
#include "importers/ifc/shapes/surfaces.h"

namespace standpoint::ifc {

struct CurveCache {
  std::mutex mutex;
  std::map<Id, Result<Path>> paths;
};

namespace {

constexpr Mapping solid(const char* name, Result<geometry::PolyMesh> (*f)(const Entity&, Scope&)) { return {name, f}; }
constexpr Mapping curved(const char* name, Result<Path> (*f)(const Entity&, Scope&)) { return {name, nullptr, f}; }
constexpr Mapping area(const char* name, Result<Regions> (*f)(const Entity&, Scope&)) {
  return {name, nullptr, nullptr, f};
}

constexpr Mapping bent(const char* name, Result<SurfacePtr> (*f)(const Entity&, Scope&)) {
  return {name, nullptr, nullptr, nullptr, f};
}

constexpr std::array kMappings{
    solid("IFCEXTRUDEDAREASOLID", extrudedAreaSolid),
    solid("IFCEXTRUDEDAREASOLIDTAPERED", extrudedAreaSolidTapered),
    solid("IFCREVOLVEDAREASOLID", revolvedAreaSolid),
    solid("IFCREVOLVEDAREASOLIDTAPERED", revolvedAreaSolidTapered),
    solid("IFCSWEPTDISKSOLID", sweptDiskSolid),
    solid("IFCSWEPTDISKSOLIDPOLYGONAL", sweptDiskSolid),
    solid("IFCSURFACECURVESWEPTAREASOLID", curveSweptAreaSolid),
    solid("IFCFIXEDREFERENCESWEPTAREASOLID", curveSweptAreaSolid),
    solid("IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID", curveSweptAreaSolid),
    solid("IFCSECTIONEDSOLIDHORIZONTAL", sectionedSolidHorizontal),
    solid("IFCSECTIONEDSURFACE", sectionedSurface),
    solid("IFCSECTIONEDSPINE", sectionedSpine),
    solid("IFCFACETEDBREP", facetedBrep),
    solid("IFCFACETEDBREPWITHVOIDS", facetedBrep),
    solid("IFCADVANCEDBREP", facetedBrep),
    solid("IFCADVANCEDBREPWITHVOIDS", facetedBrep),
    solid("IFCFACEBASEDSURFACEMODEL", surfaceModel),
    solid("IFCSHELLBASEDSURFACEMODEL", surfaceModel),
    solid("IFCCONNECTEDFACESET", faceSetItem),
    solid("IFCCLOSEDSHELL", faceSetItem),
    solid("IFCOPENSHELL", faceSetItem),
    solid("IFCFACE", faceItem),
    solid("IFCFACESURFACE", faceItem),
    solid("IFCADVANCEDFACE", faceItem),
    solid("IFCGEOMETRICSET", geometricSet),
    solid("IFCTRIANGULATEDFACESET", triangulatedFaceSet),
    solid("IFCTRIANGULATEDIRREGULARNETWORK", triangulatedFaceSet),
    solid("IFCPOLYGONALFACESET", polygonalFaceSet),
    solid("IFCBLOCK", block),
    solid("IFCRECTANGULARPYRAMID", rectangularPyramid),
    solid("IFCRIGHTCIRCULARCONE", rightCircularCone),
    solid("IFCRIGHTCIRCULARCYLINDER", rightCircularCylinder),
    solid("IFCSPHERE", sphereSolid),
    solid("IFCCSGSOLID", csgSolid),
    solid("IFCBOOLEANRESULT", booleanResult),
    solid("IFCBOOLEANCLIPPINGRESULT", booleanResult),

    curved("IFCPOLYLINE", polyline),
    curved("IFCLINE", line),
    curved("IFCCOMPOSITECURVE", compositeCurve),
    curved("IFC2DCOMPOSITECURVE", compositeCurve),
    curved("IFCCOMPOSITECURVEONSURFACE", compositeCurve),
    curved("IFCBOUNDARYCURVE", compositeCurve),
    curved("IFCOUTERBOUNDARYCURVE", compositeCurve),
    curved("IFCINDEXEDPOLYCURVE", indexedPolyCurve),
    curved("IFCCIRCLE", conicCurve),
    curved("IFCELLIPSE", conicCurve),
    curved("IFCTRIMMEDCURVE", trimmedCurve),
    curved("IFCBSPLINECURVEWITHKNOTS", bSplineCurve),
    curved("IFCRATIONALBSPLINECURVEWITHKNOTS", bSplineCurve),
    curved("IFCBEZIERCURVE", bSplineCurve),
    curved("IFCRATIONALBEZIERCURVE", bSplineCurve),
    curved("IFCOFFSETCURVE2D", offsetCurve),
    curved("IFCOFFSETCURVE3D", offsetCurve),
    curved("IFCOFFSETCURVEBYDISTANCES", offsetCurve),
    curved("IFCPCURVE", pcurve),
    curved("IFCSURFACECURVE", surfaceCurve),
    curved("IFCSEAMCURVE", surfaceCurve),
    curved("IFCINTERSECTIONCURVE", surfaceCurve),
    curved("IFCGRADIENTCURVE", gradientCurve),
    curved("IFCSEGMENTEDREFERENCECURVE", segmentedReferenceCurve),

    area("IFCRECTANGLEPROFILEDEF", rectangleProfile),
    area("IFCROUNDEDRECTANGLEPROFILEDEF", roundedRectangleProfile),
    area("IFCRECTANGLEHOLLOWPROFILEDEF", rectangleHollowProfile),
    area("IFCTRAPEZIUMPROFILEDEF", trapeziumProfile),
    area("IFCCIRCLEPROFILEDEF", circleProfile),
    area("IFCCIRCLEHOLLOWPROFILEDEF", circleHollowProfile),
    area("IFCELLIPSEPROFILEDEF", ellipseProfile),
    area("IFCISHAPEPROFILEDEF", iShapeProfile),
    area("IFCASYMMETRICISHAPEPROFILEDEF", asymmetricIShapeProfile),
    area("IFCLSHAPEPROFILEDEF", lShapeProfile),
    area("IFCTSHAPEPROFILEDEF", tShapeProfile),
    area("IFCUSHAPEPROFILEDEF", uShapeProfile),
    area("IFCCSHAPEPROFILEDEF", cShapeProfile),
    area("IFCZSHAPEPROFILEDEF", zShapeProfile),
    area("IFCCRANERAILASHAPEPROFILEDEF", craneRailAProfile),
    area("IFCCRANERAILFSHAPEPROFILEDEF", craneRailFProfile),
    area("IFCARBITRARYCLOSEDPROFILEDEF", arbitraryClosedProfile),
    area("IFCARBITRARYPROFILEDEFWITHVOIDS", arbitraryClosedProfile),
    area("IFCCENTERLINEPROFILEDEF", centreLineProfile),
    area("IFCCOMPOSITEPROFILEDEF", compositeProfile),
    area("IFCDERIVEDPROFILEDEF", derivedProfile),
    area("IFCMIRROREDPROFILEDEF", derivedProfile),

    bent("IFCPLANE", planeSurface),
    bent("IFCCYLINDRICALSURFACE", cylindricalSurface),
    bent("IFCSPHERICALSURFACE", sphericalSurface),
    bent("IFCTOROIDALSURFACE", toroidalSurface),
    bent("IFCBSPLINESURFACEWITHKNOTS", bSplineSurface),
    bent("IFCRATIONALBSPLINESURFACEWITHKNOTS", bSplineSurface),
    Mapping{"IFCSURFACEOFLINEAREXTRUSION", extrudedSurface, nullptr, nullptr, surfaceOfLinearExtrusion},
    Mapping{"IFCSURFACEOFREVOLUTION", revolvedSurface, nullptr, nullptr, surfaceOfRevolution},
    Mapping{"IFCCURVEBOUNDEDPLANE", curveBoundedPlane, nullptr, nullptr, basisSurface},
    Mapping{"IFCCURVEBOUNDEDSURFACE", curveBoundedSurface, nullptr, nullptr, basisSurface},
    Mapping{"IFCRECTANGULARTRIMMEDSURFACE", rectangularTrimmedSurface, nullptr, nullptr, basisSurface},
};

const Mapping* mappingOf(const Entity& entity, const Scope& scope) {
  return entity ? scope.model.mapping_of_type[entity.type()] : nullptr;
}

// Input may nest or share endlessly: depth and work are bounded, and both bounds are far beyond any real file.
template <class T>
Result<T> guarded(Result<T> (*function)(const Entity&, Scope&), const Entity& entity, Scope& scope, const char* kind) {
  if (!entity) return failure(ErrorKind::unusable, std::string("a ") + kind + " is missing");
  if (!function) return fail(entity, std::string(entity.typeName()) + " is not supported as a " + kind);
  if (scope.depth >= Scope::kDeepest) return fail(entity, "nested too deeply or circular");
  if (!scope.spend(1)) return fail(entity, "the representation is too complex");
  ++scope.depth;
  auto result = function(entity, scope);
  --scope.depth;
  return result;
}

}  // namespace

std::span<const Mapping> mappings() { return kMappings; }

std::vector<const Mapping*> mappingOfTypes(const StepFile& file) {
  std::vector<const Mapping*> mappings;
  for (const std::string& name : file.typeNames()) {
    const auto it =
        std::find_if(kMappings.begin(), kMappings.end(), [&](const Mapping& m) { return name == m.entity; });
    mappings.push_back(it == kMappings.end() ? nullptr : &*it);
  }
  return mappings;
}

bool isUnreadBody(const Entity& e, const Model& model) {
  const Mapping* m = model.mapping_of_type[e.type()];
  if (m) return m->surface && !m->item;
  const std::string_view name = e.typeName();
  if (name.starts_with("IFCPOINT") || name.find("CURVE") != name.npos) return false;
  constexpr std::array kWords{"SURFACE", "SOLID", "BREP", "FACESET", "SHELL", "HALFSPACE"};
  return std::any_of(kWords.begin(), kWords.end(), [&](const char* word) { return name.find(word) != name.npos; });
}

Result<geometry::PolyMesh> item(const Entity& e, Scope& s) {
  const Mapping* m = mappingOf(e, s);
  return guarded(m ? m->item : nullptr, e, s, "solid or surface");
}

std::shared_ptr<CurveCache> newCurveCache() { return std::make_shared<CurveCache>(); }

Result<Path> curve(const Entity& e, Scope& s) {
  const Mapping* m = mappingOf(e, s);
  if (!m || (m->curve != gradientCurve && m->curve != segmentedReferenceCurve))
    return guarded(m ? m->curve : nullptr, e, s, "curve");
  CurveCache& cache = *s.model.curves;
  {
    const std::lock_guard lock(cache.mutex);
    if (const auto known = cache.paths.find(e.id()); known != cache.paths.end()) return known->second;
  }
  const auto unread_before = std::exchange(s.unread, std::nullopt);
  auto path = guarded(m->curve, e, s, "curve");     // by two threads at once, perhaps: both find the same
  if (path && s.unread) path = failure(*s.unread);  // whoever comes next must learn of it, too
  s.unread = unread_before;
  const std::lock_guard lock(cache.mutex);
  return cache.paths.emplace(e.id(), std::move(path)).first->second;
}

Result<Regions> profile(const Entity& e, Scope& s) {
  const Mapping* m = mappingOf(e, s);
  auto regions = guarded(m ? m->profile : nullptr, e, s, "profile");
  if (regions && regions->empty()) return fail(e, "the profile is empty");
  return regions;
}

Result<SurfacePtr> surface(const Entity& e, Scope& s) {
  const Mapping* m = mappingOf(e, s);
  return guarded(m ? m->surface : nullptr, e, s, "surface");
}

}  // namespace standpoint::ifc

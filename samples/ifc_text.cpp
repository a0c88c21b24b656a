// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/ifc_text.h"

#include <fmt/format.h>

namespace standpoint::samples {

IfcText::IfcText(std::string file_name) {
  text_ = fmt::format(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [DesignTransferView_V1.0]'),'2;1');\n"
      "FILE_NAME('{}','2024-01-01T00:00:00',(''),(''),'Standpoint','Standpoint','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;"
      "\nDATA;\n",
      file_name);
  const int person = add("IFCPERSON($,'Author',$,$,$,$,$,$)");
  const int organization = add("IFCORGANIZATION($,'Standpoint',$,$,$)");
  const int both = add(fmt::format("IFCPERSONANDORGANIZATION(#{},#{},$)", person, organization));
  const int application =
      add(fmt::format("IFCAPPLICATION(#{},'0.1','Standpoint samples','standpoint-samples')", organization));
  owner_ = add(fmt::format("IFCOWNERHISTORY(#{},#{},$,.NOCHANGE.,$,$,$,1704067200)", both, application));
  const int metre = add("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)");
  const int square = add("IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.)");
  const int cubic = add("IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)");
  const int radian = add("IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
  units_ = add(fmt::format("IFCUNITASSIGNMENT((#{},#{},#{},#{}))", metre, square, cubic, radian));
  context_ = add(fmt::format("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#{},$)", axes({0, 0, 0})));
  body_context_ =
      add(fmt::format("IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,#{},$,.MODEL_VIEW.,$)", context_));
  // Karlsruhe, turned by 23° from grid east to the house's x axis.
  const int crs = add(
      fmt::format("IFCPROJECTEDCRS('EPSG:25832','ETRS89 / UTM zone 32N','ETRS89','DHHN2016','UTM','32N',#{})", metre));
  add(fmt::format("IFCMAPCONVERSION(#{},#{},456780.25,5429120.5,115.3,0.920504853452,0.390731128489,1.)", context_,
                  crs));
}

int IfcText::add(const std::string& entity) {
  text_ += fmt::format("#{}={};\n", next_, entity);
  return next_++;
}

// 128 bits in buildingSMART's base 64: two of them, then twenty-one times six.
std::string IfcText::guid() {
  constexpr char kDigits[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  std::string result;
  std::uint64_t state = ++guids_;
  for (int i = 0; i < 22; ++i) {
    state += 0x9E3779B97F4A7C15ULL;  // splitmix64
    std::uint64_t z = state;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    z ^= z >> 31U;
    result += kDigits[i == 0 ? z % 4 : z % 64];
  }
  return result;
}

std::string IfcText::real(double value) {
  auto text = fmt::format("{:.9f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  return text == "-0." ? "0." : text;
}

std::string IfcText::list(const std::vector<int>& ids) {
  std::string text = "(";
  for (const int id : ids) text += (text.size() > 1 ? ",#" : "#") + std::to_string(id);
  return text + ")";
}

int IfcText::point(P3 p) {
  return add(fmt::format("IFCCARTESIANPOINT(({},{},{}))", real(p[0]), real(p[1]), real(p[2])));
}
int IfcText::direction(P3 d) {
  return add(fmt::format("IFCDIRECTION(({},{},{}))", real(d[0]), real(d[1]), real(d[2])));
}

int IfcText::axes(P3 origin, P3 z, P3 x) {
  const int p = point(origin), dz = direction(z), dx = direction(x);
  return add(fmt::format("IFCAXIS2PLACEMENT3D(#{},#{},#{})", p, dz, dx));
}

int IfcText::placement(int parent, P3 origin, P2 x) {
  const int at = axes(origin, {0, 0, 1}, {x[0], x[1], 0});
  return add(fmt::format("IFCLOCALPLACEMENT({},#{})", parent == 0 ? "$" : "#" + std::to_string(parent), at));
}

int IfcText::painted(int item, const Paint& paint) {
  auto& style = styles_[paint.name];
  if (style == 0) {
    const int rgb = add(fmt::format("IFCCOLOURRGB('{}',{},{},{})", paint.name, real(paint.rgb[0]), real(paint.rgb[1]),
                                    real(paint.rgb[2])));
    const int look =
        add(fmt::format("IFCSURFACESTYLERENDERING(#{},{},$,$,$,$,$,$,.NOTDEFINED.)", rgb, real(paint.transparency)));
    style = add(fmt::format("IFCSURFACESTYLE('{}',.BOTH.,(#{}))", paint.name, look));
  }
  add(fmt::format("IFCSTYLEDITEM(#{},(#{}),'{}')", item, style, paint.name));
  return item;
}

int IfcText::rectangle(double dx, double dy) {
  const int centre = add(fmt::format("IFCCARTESIANPOINT(({},{}))", real(dx / 2), real(dy / 2)));
  const int at = add(fmt::format("IFCAXIS2PLACEMENT2D(#{},$)", centre));
  return add(fmt::format("IFCRECTANGLEPROFILEDEF(.AREA.,$,#{},{},{})", at, real(dx), real(dy)));
}

int IfcText::unpaintedBox(P3 corner, P3 size) {
  const int profile = rectangle(size[0], size[1]), at = axes(corner), up = direction({0, 0, 1});
  return add(fmt::format("IFCEXTRUDEDAREASOLID(#{},#{},#{},{})", profile, at, up, real(size[2])));
}

int IfcText::box(P3 corner, P3 size, const Paint& paint) { return painted(unpaintedBox(corner, size), paint); }

int IfcText::unpaintedPrism(const std::vector<P2>& outline, const std::vector<std::vector<P2>>& holes, int frame,
                            double depth) {
  const auto closed = [this](const std::vector<P2>& corners) {
    std::vector<int> points;
    for (const auto& c : corners)
      points.push_back(add(fmt::format("IFCCARTESIANPOINT(({},{}))", real(c[0]), real(c[1]))));
    points.push_back(points.front());
    return add("IFCPOLYLINE(" + list(points) + ")");
  };
  const int outer = closed(outline);
  std::vector<int> inner;
  for (const auto& hole : holes) inner.push_back(closed(hole));
  const int profile = inner.empty()
                          ? add(fmt::format("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#{})", outer))
                          : add(fmt::format("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#{},{})", outer, list(inner)));
  const int up = direction({0, 0, 1});
  return add(fmt::format("IFCEXTRUDEDAREASOLID(#{},#{},#{},{})", profile, frame, up, real(depth)));
}

int IfcText::prism(const std::vector<P2>& outline, const std::vector<std::vector<P2>>& holes, int frame, double depth,
                   const Paint& paint) {
  return painted(unpaintedPrism(outline, holes, frame, depth), paint);
}

int IfcText::cylinder(P3 foot, double radius, double height, const Paint& paint) {
  const int profile = add(fmt::format("IFCCIRCLEPROFILEDEF(.AREA.,$,$,{})", real(radius)));
  const int at = axes(foot), up = direction({0, 0, 1});
  return painted(add(fmt::format("IFCEXTRUDEDAREASOLID(#{},#{},#{},{})", profile, at, up, real(height))), paint);
}

int IfcText::rod(const std::vector<P3>& path, double radius, const Paint& paint) {
  std::vector<int> points;
  for (const auto& p : path) points.push_back(point(p));
  const int line = add("IFCPOLYLINE(" + list(points) + ")");
  return painted(add(fmt::format("IFCSWEPTDISKSOLID(#{},{},$,$,$)", line, real(radius))), paint);
}

int IfcText::faces(const std::vector<P3>& vertices, const std::vector<std::array<int, 3>>& triangles, bool closed,
                   const Paint& paint) {
  std::string points, indices;
  for (const auto& v : vertices)
    points += fmt::format("{}({},{},{})", points.empty() ? "" : ",", real(v[0]), real(v[1]), real(v[2]));
  for (const auto& t : triangles)
    indices += fmt::format("{}({},{},{})", indices.empty() ? "" : ",", t[0] + 1, t[1] + 1, t[2] + 1);
  const int table = add("IFCCARTESIANPOINTLIST3D((" + points + "))");
  return painted(add(fmt::format("IFCTRIANGULATEDFACESET(#{},$,{},({}),$)", table, closed ? ".T." : ".F.", indices)),
                 paint);
}

int IfcText::body(const std::vector<int>& items, const char* kind) {
  const int shape = add(fmt::format("IFCSHAPEREPRESENTATION(#{},'Body','{}',{})", body_context_, kind, list(items)));
  return add(fmt::format("IFCPRODUCTDEFINITIONSHAPE($,$,(#{}))", shape));
}

int IfcText::shared(const std::vector<int>& items, const char* kind) {
  const int shape = add(fmt::format("IFCSHAPEREPRESENTATION(#{},'Body','{}',{})", body_context_, kind, list(items)));
  return add(fmt::format("IFCREPRESENTATIONMAP(#{},#{})", axes({0, 0, 0}), shape));
}

int IfcText::mapped(int map) {
  const int origin = point({0, 0, 0});
  const int target = add(fmt::format("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#{},1.,$)", origin));
  return body({add(fmt::format("IFCMAPPEDITEM(#{},#{})", map, target))}, "MappedRepresentation");
}

int IfcText::material(const std::string& name) {
  auto& id = materials_[name];
  if (id == 0) id = add(fmt::format("IFCMATERIAL('{}',$,$)", name));
  return id;
}

int IfcText::layers(const std::string& name, const std::vector<std::pair<std::string, double>>& outside_to_inside) {
  std::vector<int> ids;
  for (const auto& [layer_material, thickness] : outside_to_inside) {
    const int id = material(layer_material);
    ids.push_back(add(fmt::format("IFCMATERIALLAYER(#{},{},$,'{}',$,$,$)", id, real(thickness), layer_material)));
  }
  return add(fmt::format("IFCMATERIALLAYERSET({},'{}',$)", list(ids), name));
}

int IfcText::layerUsage(int layer_set, const char* axis) {
  return add(fmt::format("IFCMATERIALLAYERSETUSAGE(#{},.{}.,.POSITIVE.,0.,$)", layer_set, axis));
}

int IfcText::constituents(const std::string& name,
                          const std::vector<std::pair<std::string, std::string>>& part_and_material) {
  std::vector<int> ids;
  for (const auto& [part, part_material] : part_and_material)
    ids.push_back(add(fmt::format("IFCMATERIALCONSTITUENT('{}',$,#{},$,$)", part, material(part_material))));
  return add(fmt::format("IFCMATERIALCONSTITUENTSET('{}',$,{})", name, list(ids)));
}

int IfcText::product(const char* ifc_class, const std::string& name, int placement, int shape, const std::string& tail,
                     const std::string& object_type) {
  const auto reference = [](int id) { return id == 0 ? std::string("$") : "#" + std::to_string(id); };
  return add(fmt::format("{}('{}',#{},'{}',$,{},{},{},$,{})", ifc_class, guid(), owner_, name,
                         object_type.empty() ? "$" : quoted(object_type), reference(placement), reference(shape),
                         tail));
}

void IfcText::aggregate(int whole, const std::vector<int>& parts) {
  add(fmt::format("IFCRELAGGREGATES('{}',#{},$,$,#{},{})", guid(), owner_, whole, list(parts)));
}

void IfcText::voids(int element, int opening) {
  add(fmt::format("IFCRELVOIDSELEMENT('{}',#{},$,$,#{},#{})", guid(), owner_, element, opening));
}

void IfcText::fills(int opening, int element) {
  add(fmt::format("IFCRELFILLSELEMENT('{}',#{},$,$,#{},#{})", guid(), owner_, opening, element));
}

void IfcText::properties(int product, const std::string& set,
                         const std::vector<std::pair<std::string, std::string>>& values) {
  std::vector<int> ids;
  for (const auto& [name, value] : values)
    ids.push_back(add(fmt::format("IFCPROPERTYSINGLEVALUE('{}',$,{},$)", name, value)));
  const int id = add(fmt::format("IFCPROPERTYSET('{}',#{},'{}',$,{})", guid(), owner_, set, list(ids)));
  add(fmt::format("IFCRELDEFINESBYPROPERTIES('{}',#{},$,$,(#{}),#{})", guid(), owner_, product, id));
}

void IfcText::quantities(int product, const std::string& set,
                         const std::vector<std::pair<std::string, std::string>>& values) {
  std::vector<int> ids;
  for (const auto& [kind_and_name, value] : values)
    ids.push_back(add(fmt::format("{},$,$,{},$)", kind_and_name, value)));
  const int id = add(fmt::format("IFCELEMENTQUANTITY('{}',#{},'{}',$,$,{})", guid(), owner_, set, list(ids)));
  add(fmt::format("IFCRELDEFINESBYPROPERTIES('{}',#{},$,$,(#{}),#{})", guid(), owner_, product, id));
}

int IfcText::project(const std::string& name) {
  return add(fmt::format("IFCPROJECT('{}',#{},'{}',$,$,$,$,(#{}),#{})", guid(), owner_, name, context_, units_));
}

std::string IfcText::finish() {
  for (const auto& [structure, products] : contained_)
    add(fmt::format("IFCRELCONTAINEDINSPATIALSTRUCTURE('{}',#{},$,$,{},#{})", guid(), owner_, list(products),
                    structure));
  for (const auto& [definition, products] : associated_)
    add(fmt::format("IFCRELASSOCIATESMATERIAL('{}',#{},$,$,{},#{})", guid(), owner_, list(products), definition));
  for (const auto& [object, products] : typed_)
    add(fmt::format("IFCRELDEFINESBYTYPE('{}',#{},$,$,{},#{})", guid(), owner_, list(products), object));
  return text_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace standpoint::samples

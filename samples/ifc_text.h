// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace standpoint::samples {

using P2 = std::array<double, 2>;
using P3 = std::array<double, 3>;

struct Paint {
  const char* name;
  P3 rgb;
  double transparency = 0;
};

// The IFC4 physical file of a sample, written front to back. Everything in it, GlobalIds too, follows from the order of
// the calls, so that two runs give the same bytes.
class IfcText {
 public:
  explicit IfcText(std::string file_name);

  int add(const std::string& entity);  // "IFCWALL(…)" → its number
  std::string guid();
  static std::string real(double value);  // "0.35", "10."
  static std::string quoted(const std::string& ascii) { return "'" + ascii + "'"; }
  static std::string list(const std::vector<int>& ids);  // "(#1,#2)"

  // Placements: origin and the direction of local x in the parent's plan.
  int point(P3 p);
  int direction(P3 d);
  int axes(P3 origin, P3 z = {0, 0, 1}, P3 x = {1, 0, 0});
  int placement(int parent, P3 origin, P2 x = {1, 0});

  // Solids in the product's frame, each painted (the style bears the paint's name).
  int box(P3 corner, P3 size, const Paint& paint);
  int prism(const std::vector<P2>& outline, const std::vector<std::vector<P2>>& holes, int frame, double depth,
            const Paint& paint);
  int cylinder(P3 foot, double radius, double height, const Paint& paint);
  int rod(const std::vector<P3>& path, double radius, const Paint& paint);
  int faces(const std::vector<P3>& vertices, const std::vector<std::array<int, 3>>& triangles, bool closed,
            const Paint& paint);
  // Openings and rooms have no paint.
  int unpaintedBox(P3 corner, P3 size);
  int unpaintedPrism(const std::vector<P2>& outline, const std::vector<std::vector<P2>>& holes, int frame,
                     double depth);

  int body(const std::vector<int>& items, const char* kind = "SweptSolid");    // IfcProductDefinitionShape
  int shared(const std::vector<int>& items, const char* kind = "SweptSolid");  // IfcRepresentationMap
  int mapped(int map);                                                         // IfcProductDefinitionShape

  int material(const std::string& name);
  int layers(const std::string& name, const std::vector<std::pair<std::string, double>>& outside_to_inside);
  int layerUsage(int layer_set, const char* axis);
  int constituents(const std::string& name, const std::vector<std::pair<std::string, std::string>>& part_and_material);

  // A product of any class: the head that all share, then the attributes after Tag.
  int product(const char* ifc_class, const std::string& name, int placement, int shape, const std::string& tail,
              const std::string& object_type = {});

  void contain(int product, int structure) { contained_[structure].push_back(product); }
  void associate(int product, int material) { associated_[material].push_back(product); }
  void aggregate(int whole, const std::vector<int>& parts);
  void voids(int element, int opening);
  void fills(int opening, int element);
  void type(int product, int type_object) { typed_[type_object].push_back(product); }
  void properties(int product, const std::string& set,
                  const std::vector<std::pair<std::string, std::string>>& name_and_value);
  void quantities(int product, const std::string& set,
                  const std::vector<std::pair<std::string, std::string>>& name_and_entity);

  int owner() const { return owner_; }
  int bodyContext() const { return body_context_; }
  int project(const std::string& name);
  std::string finish();  // writes the relations and closes the file

 private:
  int painted(int item, const Paint& paint);
  int rectangle(double dx, double dy);

  std::string text_;
  int next_ = 1;
  std::uint64_t guids_ = 0;
  int owner_ = 0, context_ = 0, body_context_ = 0, units_ = 0;
  std::map<std::string, int> materials_, styles_;
  std::map<int, std::vector<int>> contained_, associated_, typed_;
};

}  // namespace standpoint::samples

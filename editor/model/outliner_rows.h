// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/environment.h"

namespace standpoint {

struct OutlinerRow {
  enum class Kind { spatial, group, product };
  Kind kind = Kind::product;
  int depth = 0;
  std::uint32_t node = 0;  // into Outliner's nodes
  bool expandable = false;
  bool expanded = false;
};

// The tree project › site › building › storey › class › product of one environment, and the rows of it that are open.
// A room is a product, and what stands in it is below it. A model without spatial structure (glTF, OBJ) is one list of
// products.
class Outliner {
 public:
  struct Node {
    OutlinerRow::Kind kind = OutlinerRow::Kind::spatial;
    std::uint32_t index = 0;  // of the spatial node or product; of a group, its first product
    std::int32_t parent = -1;
    std::string label;
    std::vector<std::uint32_t> children;
    std::uint32_t products = 0;  // below
  };

  Outliner() = default;
  explicit Outliner(const Environment& environment);

  const Node& node(std::uint32_t n) const { return nodes_[n]; }  // the first are those of Environment::spatial
  // Rows from top to bottom. With a filter, what matches and its ancestors, all open.
  std::vector<OutlinerRow> rows(const Environment& environment, const std::string& filter) const;
  bool expanded(std::uint32_t node) const { return expanded_.count(node) != 0; }
  void expand(std::uint32_t node, bool open);
  void expandAll(bool open);
  // Opens what lies above a product, so that rows() holds it.
  void reveal(std::uint32_t product);
  // Every product at or below.
  std::vector<std::uint32_t> productsBelow(std::uint32_t node) const;

 private:
  std::uint32_t add(OutlinerRow::Kind kind, std::uint32_t index, std::int32_t parent, std::string label);
  void addSpatial(const Environment& environment);
  void nameRooms(const Environment& environment);
  void sortRooms(const Environment& environment, std::vector<std::uint32_t>& children) const;
  void addProducts(const Environment& environment);
  void countProducts();

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> roots_;
  std::vector<std::int32_t> node_of_product_;
  std::set<std::uint32_t> expanded_;
};

// "IfcWallStandardCase" → "Wall standard case"; "" → "Object".
std::string readableClass(const std::string& ifc_class);
// Name, else what can be said instead.
std::string productLabel(const Product& product);
// "IfcSlab 'Roof' and IfcWall #12 touch" → "Slab 'Roof' and Wall #12 touch", in the language that is spoken: what the
// command line says of products, as the editor calls them. Only before a name or an id.
std::string withReadableClasses(const std::string& text);
// Case-insensitive: every word of the filter is in the name, long name, class, id, GlobalId or a material.
bool matchesFilter(const Product& product, const std::string& filter);

}  // namespace standpoint

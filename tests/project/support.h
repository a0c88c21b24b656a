// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "project/verb.h"
#include "tests/temporary_folder.h"

namespace standpoint {

// Adds the six inner or outer faces of a box from `min` to `max` as one product.
inline void addBox(Environment& e, const std::string& id, const std::string& ifc_class, const Eigen::Vector3d& min,
                   const Eigen::Vector3d& max, std::uint32_t surface = 0) {
  auto m = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i)
    m->positions.emplace_back(static_cast<float>((i & 1) != 0 ? max.x() - min.x() : 0),
                              static_cast<float>((i & 2) != 0 ? max.y() - min.y() : 0),
                              static_cast<float>((i & 4) != 0 ? max.z() - min.z() : 0));
  m->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  m->surface_of_triangle.assign(12, surface);
  Product p;
  p.id = id;
  p.ifc_class = ifc_class;
  p.name = id;
  e.instances.push_back({static_cast<std::uint32_t>(e.meshes.size()), static_cast<std::uint32_t>(e.products.size()),
                         Eigen::Affine3d(Eigen::Translation3d(min))});
  e.products.push_back(std::move(p));
  e.meshes.push_back(std::move(m));
}

// Two storeys of one room each, 6 x 4 m, floors at 0 and 3 m, walls of 0.2 m, with a table in the lower one; the file's
// frame is 500 000 / 5 600 000 away.
inline Document twoStoreyDocument() {
  auto e = std::make_shared<Environment>();
  e->surfaces.push_back({"Concrete", {0.6F, 0.6F, 0.6F, 1}, "#1", {}, {}});
  e->spatial.push_back({"#10", "IfcProject", "Test", "", -1, 0});
  for (int storey = 0; storey < 3; ++storey)
    addBox(*e, "slab" + std::to_string(storey), "IfcSlab", {0, 0, storey * 3.0 - 0.2}, {6, 4, storey * 3.0});
  for (int storey = 0; storey < 2; ++storey) {
    const double z = storey * 3.0;
    addBox(*e, "south" + std::to_string(storey), "IfcWall", {0, -0.2, z}, {6, 0, z + 2.8});
    addBox(*e, "north" + std::to_string(storey), "IfcWall", {0, 4, z}, {6, 4.2, z + 2.8});
    addBox(*e, "west" + std::to_string(storey), "IfcWall", {-0.2, 0, z}, {0, 4, z + 2.8});
    addBox(*e, "east" + std::to_string(storey), "IfcWall", {6, 0, z}, {6.2, 4, z + 2.8});
  }
  addBox(*e, "table", "IfcFurniture", {4, 2.5, 0}, {5, 3.5, 0.75});
  Document d;
  d.name = "test";
  d.sources = {"house.ifc"};
  d.imported = e;
  Georeference g;
  g.shift_m = {500000, 5600000, 0};
  d.georeference = std::make_shared<const Georeference>(g);
  d.import_report = std::make_shared<const Report>();
  d.job = std::make_shared<const Job>();
  return d;
}

// All that a report says, a line each.
inline std::string said(const Report& report) {
  std::string text;
  for (const auto& i : report.issues) text += i.source + ": " + i.message + "\n";
  return text;
}

inline Result<Outcome> run(const char* verb, const Document& d, const nlohmann::json& options) {
  Progress progress;
  const Verb* found = findVerb(verbs(), verb);
  return found == nullptr ? Result<Outcome>(failure(ErrorKind::usage, "no such verb"))
                          : runVerb(*found, d, options, progress);
}

}  // namespace standpoint

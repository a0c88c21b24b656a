// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "importers/dxf/dxf_drawing.h"
#include "importers/dxf/dxf_entity.h"
#include "importers/geometry/kernel.h"

namespace standpoint {

// A POLYLINE and the VERTEX entities after it.
struct DxfPolyline {
  DxfEntity head;
  DxfLook look;
  struct Vertex {
    Eigen::Vector3d at;
    double bulge;
    std::array<double, 2> widths;
  };
  std::vector<Vertex> vertices;
  struct Face {  // of a polyface mesh
    std::array<std::uint32_t, 4> corners;
    std::uint32_t count;
    DxfLook look;
    std::size_t line;
  };
  std::vector<Face> faces;
};

// Makes faces of entities and gives them to a block.
class DxfShapes {
 public:
  // Arcs become chords whose number is that of `tessellation` at this unit.
  void begin(const geometry::Tessellation& tessellation, double metres_per_unit) {
    tessellation_ = tessellation;
    metres_per_unit_ = metres_per_unit;
  }

  void face3d(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const;
  Result<void> mesh(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to) const;
  // SOLID and TRACE; LINE, CIRCLE, ARC, LWPOLYLINE and POLYLINE, which have faces where they have a thickness.
  void solid(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const;
  void line(const DxfEntity& e, const DxfLook& look, DxfBlock& to) const;
  Result<void> circle(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to);
  Result<void> lwPolyline(const DxfEntity& e, const DxfLook& look, const DxfGroups& groups, DxfBlock& to);
  Result<void> polyline(const DxfPolyline& p, const DxfGroups& groups, DxfBlock& to);

 private:
  struct Knot {
    Eigen::Vector3d at;  // in the object's frame
    double bulge = 0;    // of the piece that begins here
    std::array<double, 2> widths{};
  };
  struct Path {
    std::vector<Knot> knots;
    bool closed = false;
  };
  static std::optional<double> widthOf(const Path& path);
  Result<std::vector<Eigen::Vector3d>> flattened(const Path& path, std::size_t line, const DxfGroups& groups);
  Result<void> extrudePath(const DxfEntity& e, const Path& path, const DxfLook& look, const DxfGroups& groups,
                           DxfBlock& to);
  void polygonMesh(const DxfPolyline& p, std::size_t m, std::size_t n, DxfBlock& to) const;
  void polyfaceMesh(const DxfPolyline& p, DxfBlock& to) const;

  geometry::Tessellation tessellation_;
  double metres_per_unit_ = 1;
  std::size_t chords_ = 0;
};

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which layer of a wall or slab each of its faces shows (IfcMaterialLayerSetUsage).
//  - A face across the layers (a wall's two sides, the back of a niche) shows the layer that lies behind it there; the
//    outermost faces show the outermost layer that has a material, also one without thickness (paint, a membrane).
//  - End faces, reveals and tops are cut along the boundaries of the layers and show each in its place. Every edge is
//  cut
//    at the same point for both of its faces, so bounds, volume and closedness stay what they were. Where a cut would
//    multiply the triangles beyond kMostGrowth, and on curved walls, they show the thickest layer instead.
//  - The layers are laid against the body: where their sum is the body's thickness (within 1 mm + 1 %) an offset that
//    puts them elsewhere is not believed, only their order. Where the sum is not the body's thickness nothing is cut:
//    the faces that look along the axis show the outermost layers, all others the thickest.

#include <optional>
#include <vector>

#include "importers/ifc/body.h"
#include "importers/ifc/material.h"

namespace standpoint::ifc {

constexpr std::size_t kMostGrowth = 8;

// The line that "AXIS2" is across: the wall's Axis representation in the product's XY plane, in metres; empty: its x
// axis.
using ReferenceLine = std::vector<Eigen::Vector2d>;
ReferenceLine referenceLine(const Entity& product, const Model& model);

struct LayeredBody {
  std::vector<Eigen::Vector3f> positions;  // as in the body, then the cuts
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> tags;   // per triangle, the body's
  std::vector<std::uint32_t> layer;  // per triangle, index into ProductMaterials::layers
};

// Nothing when the materials have no usage, or no two layers of different materials.
std::optional<LayeredBody> layeredBody(const Body& body, const Eigen::Affine3d& product_from_items,
                                       const ProductMaterials& materials, const ReferenceLine& line);
// Equal for bodies that layeredBody() treats alike: two walls may share a mesh then.
std::vector<double> layeringKey(const Eigen::Affine3d& product_from_items, const ProductMaterials& materials,
                                const ReferenceLine& line);

}  // namespace standpoint::ifc

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "importers/ifc/body.h"
#include "importers/ifc/layer_sides.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/texture.h"
#include "importers/ifc/surface_pool.h"

namespace standpoint::ifc {

// From bodies to the environment's meshes, surfaces and instances. A body that several products place is one mesh as
// long as it looks the same on all of them: equal walls of other layers have meshes of their own.
class Assembly {
 public:
  // `up_from_file` is no identity where another axis than the file's Z points up.
  Assembly(const Model& model, const Relations& relations, Environment& environment,
           const Eigen::Affine3d& up_from_file, std::filesystem::path folder, Report& report)
      : model_(model),
        relations_(relations),
        environment_(environment),
        report_(report),
        up_from_file_(up_from_file),
        placements_(model),
        pool_(model, environment, std::move(folder), report) {}

  void add(std::uint32_t product, const Entity& entity, const std::vector<PlacedBody>& bodies,
           const Eigen::Vector3d& shift_m);

 private:
  using Key = std::tuple<const Body*, std::vector<std::uint32_t>, std::vector<double>>;
  struct Layering;

  std::uint32_t mesh(const PlacedBody& placed, const ProductMaterials& materials, const Layering& layering);
  std::uint32_t plainMesh(const PlacedBody& placed, const ProductMaterials& materials);
  std::uint32_t layeredMesh(const PlacedBody& placed, const ProductMaterials& materials, const Layering& layering,
                            std::vector<double> key);
  std::uint32_t keep(Key key, Mesh mesh);
  using Corners = std::array<Eigen::Vector2f, 3>;
  bool isPictured(const PlacedBody& placed) const;
  std::optional<Corners> listedCorners(const Body& body, std::size_t triangle);
  Corners generatedCorners(const Body& body, std::size_t triangle, const Entity& texture) const;
  void placePictures(Mesh& mesh, const PlacedBody& placed);

  const Model& model_;
  const Relations& relations_;
  Environment& environment_;
  Report& report_;
  Eigen::Affine3d up_from_file_;
  Placements placements_;
  SurfacePool pool_;
  std::map<Id, TexturedItem> textured_;
  std::map<Key, std::uint32_t> meshes_;  // looked up, never walked
  std::map<std::tuple<const Body*, std::uint32_t, std::vector<double>>, std::uint32_t>
      layered_;  // whole layerings done before
};

}  // namespace standpoint::ifc

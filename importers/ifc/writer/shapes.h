// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/environment.h"
#include "importers/ifc/writer/class_table.h"
#include "importers/ifc/writer/step_writer.h"

namespace standpoint::ifc {

// Local frame to metres of the file's axes without its shift: the shift stands in the place of the site.
Ref axisPlacement(const Eigen::Isometry3d& at, StepWriter& out);

// The meshes as triangulated face sets, one for each surface of a mesh; those that several instances show as maps.
class ShapeWriter {
 public:
  // `styles`: one for each surface, 0 for none.
  ShapeWriter(const Environment& environment, std::vector<Ref> styles, Schema schema, Ref context, StepWriter& out);

  struct Shape {
    Ref definition = 0;  // IfcProductDefinitionShape; 0: no triangles
    Eigen::Isometry3d local_from_product = Eigen::Isometry3d::Identity();
    std::size_t triangles = 0;
  };
  // Of a product's instances. A turned and moved mesh stays as it is; one that is mirrored, stretched or sheared is
  // written once more, in metres.
  // The shape is in the frame of the first instance, unless another one is asked for.
  Shape write(std::span<const Instance> instances, const std::vector<std::string>& layers,
              const std::optional<Eigen::Isometry3d>& local_from_product = {});
  // IfcPresentationLayerAssignment.
  void finish();

 private:
  struct Placed {
    std::uint32_t mesh = 0;
    bool as_it_is = true;  // else its vertices are turned by `linear`
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  };
  static Placed placed(const Instance& instance);
  std::vector<Ref> faceSets(const Placed& placed);
  Ref representation(const char* kind, const std::vector<Ref>& items);
  Ref map(const Placed& placed);  // 0: no triangles

  const Environment& environment_;
  std::vector<Ref> styles_;
  Schema schema_;
  Ref context_;
  StepWriter& out_;
  std::vector<std::uint32_t> uses_;  // of each mesh, by instances
  std::map<std::string, Ref> maps_;  // by mesh and what turned it
  std::map<std::string, std::vector<Ref>> layers_;
};

}  // namespace standpoint::ifc

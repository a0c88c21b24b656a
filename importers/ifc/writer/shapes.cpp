// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/shapes.h"

#include <array>
#include <utility>

#include "core/mesh.h"

namespace standpoint::ifc {
namespace {

constexpr double kRigid = 1e-9;

Ref point(const Eigen::Vector3d& p, StepWriter& out) {
  return out.shared(StepRecord("IFCCARTESIANPOINT").reals(p + Eigen::Vector3d::Zero()));  // no -0.
}

Ref directionOf(const Eigen::Vector3d& d, StepWriter& out) {
  return out.shared(StepRecord("IFCDIRECTION").reals(d + Eigen::Vector3d::Zero()));
}

std::string corners(const Mesh& mesh, std::size_t first, std::size_t end, bool mirrored) {
  std::string list = "(";
  for (std::size_t i = first; i < end; ++i) {
    auto t = mesh.triangles[i];
    if (mirrored) std::swap(t[1], t[2]);
    list += i == first ? "(" : ",(";
    list += std::to_string(t[0] + 1) + ',' + std::to_string(t[1] + 1) + ',' + std::to_string(t[2] + 1) + ')';
  }
  return list + ')';
}

}  // namespace

Ref axisPlacement(const Eigen::Isometry3d& at, StepWriter& out) {
  StepRecord record("IFCAXIS2PLACEMENT3D");
  record.ref(point(at.translation(), out));
  if (at.linear().isIdentity(0)) return out.shared(record.none(2));
  const Ref z = directionOf(at.linear().col(2), out), x = directionOf(at.linear().col(0), out);
  return out.shared(record.ref(z).ref(x));
}

ShapeWriter::ShapeWriter(const Environment& environment, std::vector<Ref> styles, Schema schema, Ref context,
                         StepWriter& out)
    : environment_(environment),
      styles_(std::move(styles)),
      schema_(schema),
      context_(context),
      out_(out),
      uses_(environment.meshes.size(), 0) {
  for (const Instance& instance : environment.instances) ++uses_[instance.mesh];
}

ShapeWriter::Placed ShapeWriter::placed(const Instance& instance) {
  Placed result;
  result.mesh = instance.mesh;
  result.linear = instance.world_from_mesh.linear();
  result.pose.translation() = instance.world_from_mesh.translation();
  const bool rigid = (result.linear.transpose() * result.linear).isIdentity(kRigid) && result.linear.determinant() > 0;
  if (rigid)
    result.pose.linear() = std::exchange(result.linear, Eigen::Matrix3d::Identity());
  else
    result.as_it_is = false;
  return result;
}

std::vector<Ref> ShapeWriter::faceSets(const Placed& placed) {
  const Mesh& mesh = *environment_.meshes[placed.mesh];
  if (mesh.triangles.empty()) return {};
  std::string list = "(";
  for (const Eigen::Vector3f& p : mesh.positions) {
    const Eigen::Vector3f at = placed.as_it_is ? p : Eigen::Vector3f((placed.linear * p.cast<double>()).cast<float>());
    list += list.size() > 1 ? ",(" : "(";
    list += stepReal(at.x()) + ',' + stepReal(at.y()) + ',' + stepReal(at.z()) + ')';
  }
  StepRecord points("IFCCARTESIANPOINTLIST3D");
  points.raw(list + ')');
  if (schema_ == Schema::ifc4x3) points.none();
  const Ref coordinates = out_.add(points);
  const bool mirrored = placed.linear.determinant() < 0;
  const bool one_surface = mesh.surface_of_triangle.front() == mesh.surface_of_triangle.back();
  std::vector<Ref> sets;
  for (std::size_t first = 0; first < mesh.triangles.size();) {
    std::size_t end = first + 1;
    const std::uint32_t surface = mesh.surface_of_triangle[first];
    while (end < mesh.triangles.size() && mesh.surface_of_triangle[end] == surface) ++end;
    const Ref set = out_.add(StepRecord("IFCTRIANGULATEDFACESET")
                                 .ref(coordinates)
                                 .none()
                                 .symbol(one_surface && isClosed(mesh) ? "T" : "F")
                                 .raw(corners(mesh, first, end, mirrored))
                                 .none());
    if (styles_[surface] != 0) out_.add(StepRecord("IFCSTYLEDITEM").ref(set).refs(std::array{styles_[surface]}).none());
    sets.push_back(set);
    first = end;
  }
  return sets;
}

Ref ShapeWriter::representation(const char* kind, const std::vector<Ref>& items) {
  return out_.add(StepRecord("IFCSHAPEREPRESENTATION").ref(context_).text("Body").text(kind).refs(items));
}

Ref ShapeWriter::map(const Placed& placed) {
  std::string key = std::to_string(placed.mesh);
  if (!placed.as_it_is)
    for (const double x : placed.linear.reshaped()) key += ' ' + stepReal(x);
  if (const auto it = maps_.find(key); it != maps_.end()) return it->second;
  const std::vector<Ref> sets = faceSets(placed);
  Ref& map = maps_[std::move(key)];
  if (sets.empty()) return map = 0;
  const Ref origin = axisPlacement(Eigen::Isometry3d::Identity(), out_);
  return map = out_.add(StepRecord("IFCREPRESENTATIONMAP").ref(origin).ref(representation("Tessellation", sets)));
}

ShapeWriter::Shape ShapeWriter::write(std::span<const Instance> instances, const std::vector<std::string>& layers,
                                      const std::optional<Eigen::Isometry3d>& local_from_product) {
  Shape shape;
  if (instances.empty()) return shape;
  std::vector<Placed> all;
  for (const Instance& instance : instances) {
    all.push_back(placed(instance));
    shape.triangles += environment_.meshes[instance.mesh]->triangles.size();
  }
  shape.local_from_product = local_from_product.value_or(all[0].pose);
  std::vector<Ref> items;
  const bool mapped = all.size() > 1 || uses_[all[0].mesh] > 1 || local_from_product;
  if (!mapped) {
    items = faceSets(all[0]);
  } else {
    for (const Placed& one : all) {
      const Ref source = map(one);
      if (source == 0) continue;
      const bool same = !local_from_product && &one == all.data();
      const Eigen::Isometry3d at = same ? Eigen::Isometry3d::Identity() : shape.local_from_product.inverse() * one.pose;
      StepRecord target("IFCCARTESIANTRANSFORMATIONOPERATOR3D");
      const Ref origin = point(at.translation(), out_);
      if (at.linear().isIdentity(0)) {
        target.none(2).ref(origin).none(2);
      } else {
        std::array<Ref, 3> axes{};
        for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = directionOf(at.linear().col(i), out_);
        target.ref(axes[0]).ref(axes[1]).ref(origin).none().ref(axes[2]);
      }
      items.push_back(out_.add(StepRecord("IFCMAPPEDITEM").ref(source).ref(out_.shared(target))));
    }
  }
  if (items.empty()) return shape;
  const Ref body = representation(mapped ? "MappedRepresentation" : "Tessellation", items);
  for (const std::string& layer : layers) layers_[layer].push_back(body);
  shape.definition = out_.add(StepRecord("IFCPRODUCTDEFINITIONSHAPE").none(2).refs(std::array{body}));
  return shape;
}

void ShapeWriter::finish() {
  for (const auto& [name, items] : layers_)
    out_.add(StepRecord("IFCPRESENTATIONLAYERASSIGNMENT").raw(stepText(name)).none().refs(items).none());
}

}  // namespace standpoint::ifc

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/merged_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "core/assigned.h"
#include "core/face_patches.h"

namespace standpoint {

namespace {

constexpr double kSharp_rad = 0.5;  // 29°: a cylinder of 12 or more sides has no lines along it

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255)); }
Rgba rgba(const Colour& c) { return {byte(c.r), byte(c.g), byte(c.b), byte(c.a)}; }

void appendPositions(std::vector<float>& out, const Mesh& mesh, const Eigen::Affine3d& placed) {
  for (const auto& p : mesh.positions) {
    const Eigen::Vector3f world = (placed * p.cast<double>()).cast<float>();
    out.insert(out.end(), {world.x(), world.y(), world.z()});
  }
}

void appendTriangle(MergedTriangles& out, const Triangle& t, std::int64_t offset, bool mirrored, Rgba colour) {
  out.corners.insert(out.corners.end(),
                     {offset + t[0], offset + (mirrored ? t[2] : t[1]), offset + (mirrored ? t[1] : t[2])});
  out.colours.push_back(colour);
}

std::int64_t pointCount(const MergedTriangles& out) { return static_cast<std::int64_t>(out.positions.size() / 3); }

Colour physicalColour(const MaterialAssignment& assignment, std::int32_t material, const ViewState& state) {
  if (material < 0) return materialColour(nullptr);
  const auto& m = assignment.materials[static_cast<std::size_t>(material)];
  const float alpha = m.transmittance.empty() ? 1.0F : 0.35F;
  if (state.colour == ColourMode::reflectance) {
    const auto grey = static_cast<float>(std::clamp(atWavelength(m.reflectance, state.wavelength_nm), 0.03, 1.0));
    return {grey, grey, grey, alpha};
  }
  Colour c = materialColour(&m);
  c.a = alpha;
  return c;
}

double confidenceOf(const MaterialAssignment& assignment, std::uint32_t product, std::uint32_t surface) {
  const auto* assigned = assignedSurface(assignment, product, surface);
  return assigned != nullptr && assigned->material >= 0 ? assigned->confidence : -1;
}

class Painter {
 public:
  explicit Painter(const ViewState& state) : state_(state) {
    if (state.materials && showsMaterials()) triangles_.emplace(*state.environment, state.materials->result.assignment);
  }

  // Single faces of it have another material than the rest.
  bool byFace(std::uint32_t product, std::uint32_t surface) const {
    return triangles_ && !assignedFaces(state_.materials->result.assignment, product, surface).empty();
  }

  Rgba ofFace(PlacedTriangle face) const {
    return rgba(physicalColour(state_.materials->result.assignment,
                               triangles_->materialOf(face.instance, face.triangle), state_));
  }

  Rgba of(std::uint32_t product, std::uint32_t surface) const {
    if (state_.colour == ColourMode::deviation)
      return state_.deviation ? Rgba{255, 255, 255, 255} : deviationColour(0, 1);
    if (isExpected(state_.colour)) return deviationColour(0, 1);
    if (state_.colour != ColourMode::model) {
      if (!state_.materials) return rgba(materialColour(nullptr));
      const auto& assignment = state_.materials->result.assignment;
      if (state_.colour == ColourMode::confidence)
        return rgba(confidenceColour(confidenceOf(assignment, product, surface)));
      return rgba(physicalColour(assignment, materialOf(assignment, product, surface), state_));
    }
    Colour c = state_.environment->surfaces[surface].colour;
    if (c.a < 1) c.a = std::clamp(c.a, 0.15F, 0.85F);  // glass stays to be seen
    return rgba(c);
  }

 private:
  bool showsMaterials() const {
    return state_.colour == ColourMode::material || state_.colour == ColourMode::reflectance;
  }

  const ViewState& state_;
  std::optional<AssignedTriangles> triangles_;
};

// Takes one placed mesh into the parts of the scene, its vertices once into each part that needs them. A vertex whose
// colour runs into those of its neighbours stands there once for each surface that it has a part in.
class MeshMerger {
 public:
  // `gradation` is empty, or has what each vertex's colour multiplies that of the surface with.
  MeshMerger(const ViewState& state, const Mesh& mesh, const Instance& instance, std::span<const Rgba> gradation,
             MergedScene& scene)
      : state_(state),
        mesh_(mesh),
        instance_(instance),
        gradation_(gradation),
        scene_(scene),
        mirrored_(instance.world_from_mesh.linear().determinant() < 0),
        graded_(!gradation.empty()) {}

  void add(std::size_t triangle, Rgba colour) {
    const auto surface = mesh_.surface_of_triangle[triangle];
    const auto& t = mesh_.triangles[triangle];
    const bool opaque = colour[3] == 255 && (!graded_ || opaqueCorners(t));
    if (out_ == nullptr || surface != surface_ || opaque != opaque_) aim(surface, opaque);
    if (graded_)
      addGraded(t, colour);
    else
      appendTriangle(*out_, t, offset_, mirrored_, colour);
  }

 private:
  void aim(std::uint32_t index, bool opaque) {
    surface_ = index;
    opaque_ = opaque;
    const Surface& surface = state_.environment->surfaces[index];
    const bool shows_image =
        state_.colour == ColourMode::model && surface.image >= 0 && !mesh_.texture_coordinates.empty();
    painted_ = shows_image ? &scene_.painted[{surface.image, graded_}] : nullptr;
    if (painted_ != nullptr) {
      out_ = &painted_->triangles;
      painted_->unlit = surface.unlit;
    } else if (graded_) {
      out_ = opaque ? &scene_.graded : &scene_.graded_transparent;
    } else {
      out_ = opaque ? &scene_.opaque : &scene_.transparent;
    }
    out_->graded = graded_;
    if (graded_) {
      graded_vertex_.clear();
      return;
    }
    const auto [found, fresh] = offsets_.try_emplace(out_, pointCount(*out_));
    offset_ = found->second;
    if (!fresh) return;
    appendPositions(out_->positions, mesh_, instance_.world_from_mesh);
    if (painted_ != nullptr)
      for (std::uint32_t v = 0; v < mesh_.texture_coordinates.size(); ++v) appendCoordinates(v);
  }

  void appendCoordinates(std::uint32_t vertex) {
    const auto& t = mesh_.texture_coordinates[vertex];
    painted_->coordinates.insert(painted_->coordinates.end(), {t.x(), 1 - t.y()});
  }

  bool opaqueCorners(const Triangle& t) const {
    return gradation_[t[0]][3] == 255 && gradation_[t[1]][3] == 255 && gradation_[t[2]][3] == 255;
  }

  void addGraded(const Triangle& t, const Rgba& colour) {
    for (const auto k : {0, mirrored_ ? 2 : 1, mirrored_ ? 1 : 2}) out_->corners.push_back(gradedVertex(t[k], colour));
  }

  std::int64_t gradedVertex(std::uint32_t vertex, const Rgba& colour) {
    const auto [found, fresh] = graded_vertex_.try_emplace(vertex, pointCount(*out_));
    if (!fresh) return found->second;
    const Eigen::Vector3f world = (instance_.world_from_mesh * mesh_.positions[vertex].cast<double>()).cast<float>();
    out_->positions.insert(out_->positions.end(), {world.x(), world.y(), world.z()});
    Rgba product{};
    for (std::size_t k = 0; k < 4; ++k) product[k] = static_cast<std::uint8_t>(colour[k] * gradation_[vertex][k] / 255);
    out_->colours.push_back(product);
    if (painted_ != nullptr) appendCoordinates(vertex);
    return found->second;
  }

  const ViewState& state_;
  const Mesh& mesh_;
  const Instance& instance_;
  std::span<const Rgba> gradation_;
  MergedScene& scene_;
  bool mirrored_, graded_;
  std::map<const MergedTriangles*, std::int64_t> offsets_;         // of the mesh's first vertex in each part
  std::unordered_map<std::uint32_t, std::int64_t> graded_vertex_;  // of this surface
  MergedTriangles* out_ = nullptr;                                 // where the last triangle went
  PaintedTriangles* painted_ = nullptr;                            // the same, when it shows an image
  std::int64_t offset_ = 0;
  std::uint32_t surface_ = 0;
  bool opaque_ = true;
};

std::vector<Rgba> coloursOf(const DeviationField& field, std::size_t instance) {
  std::vector<Rgba> colours;
  for (const float d : field.of_instance[instance]->distance_m)
    colours.push_back(deviationColour(d, field.full_scale_m));
  return colours;
}

}  // namespace

namespace {

std::size_t endOf(InstanceRange range, const Environment& environment) {
  return std::min(range.end, environment.instances.size());
}

}  // namespace

bool isShown(const ViewState& state, std::uint32_t product) {
  if (!state.environment->products[product].inScene() || isDrawnApart(state, product)) return false;
  return !state.hidden || product >= state.hidden->size() || (*state.hidden)[product] == 0;
}

ViewState stateOfDoors(const ViewState& state) {
  ViewState doors = state;
  doors.environment = state.doors;
  doors.doors.reset();
  doors.deviation.reset();
  doors.selected.reset();
  if (state.materials && !state.materials->result.assignment.faces.empty()) {  // they are of the whole model's faces
    auto plain = std::make_shared<MaterialChoice>(*state.materials);
    plain->result.assignment.faces.clear();
    doors.materials = std::move(plain);
  }
  return doors;
}

MergedScene mergeVisible(const ViewState& state, InstanceRange range) {
  MergedScene scene;
  const Painter painter(state);
  const bool deviations = state.colour == ColourMode::deviation && state.deviation;
  std::vector<Rgba> distances;
  for (std::size_t i = range.first; i < endOf(range, *state.environment); ++i) {
    const auto& instance = state.environment->instances[i];
    if (!range.holds(*state.environment, i) || !isShown(state, instance.product)) continue;
    const Mesh& mesh = *state.environment->meshes[instance.mesh];
    if (deviations) distances = coloursOf(*state.deviation, i);
    std::span<const Rgba> gradation;
    if (deviations)
      gradation = distances;
    else if (state.colour == ColourMode::model)
      gradation = mesh.colours;
    MeshMerger merger(state, mesh, instance, gradation, scene);
    std::uint32_t surface = ~0U;
    bool by_face = false;
    Rgba colour{};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const bool next = mesh.surface_of_triangle[t] != surface;
      if (next) by_face = painter.byFace(instance.product, surface = mesh.surface_of_triangle[t]);
      if (by_face)
        colour = painter.ofFace({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(t)});
      else if (next)
        colour = painter.of(instance.product, surface);
      merger.add(t, colour);
    }
  }
  return scene;
}

std::optional<MergedColours> mergeColours(const ViewState& state, InstanceRange range) {
  const auto& environment = *state.environment;
  if (state.colour == ColourMode::deviation && state.deviation) return std::nullopt;
  if (state.colour == ColourMode::model &&
      (!environment.images.empty() || std::any_of(environment.meshes.begin(), environment.meshes.end(),
                                                  [](const auto& m) { return !m->colours.empty(); })))
    return std::nullopt;
  MergedColours merged;
  merged.runs.push_back(0);
  const Painter painter(state);
  const auto append = [&](Rgba colour, std::uint32_t count) {
    const bool opaque = colour[3] == 255;
    auto& colours = opaque ? merged.opaque : merged.transparent;
    colours.insert(colours.end(), count, colour);
    if (opaque != (merged.runs.size() % 2 == 1)) merged.runs.push_back(0);
    merged.runs.back() += count;
  };
  for (std::size_t i = range.first; i < endOf(range, environment); ++i) {
    const auto& instance = environment.instances[i];
    if (!range.holds(environment, i) || !isShown(state, instance.product)) continue;
    const auto& of = environment.meshes[instance.mesh]->surface_of_triangle;
    for (std::size_t t = 0; t < of.size();) {
      const auto end = static_cast<std::size_t>(
          std::upper_bound(of.begin() + static_cast<std::ptrdiff_t>(t), of.end(), of[t]) - of.begin());
      if (!painter.byFace(instance.product, of[t]))
        append(painter.of(instance.product, of[t]), static_cast<std::uint32_t>(end - t));
      else
        for (auto face = t; face < end; ++face)
          append(painter.ofFace({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(face)}), 1);
      t = end;
    }
  }
  return merged;
}

MergedTriangles mergeProducts(const Environment& environment, const std::vector<std::uint32_t>& products, Rgba colour) {
  MergedTriangles out;
  for (const auto& instance : environment.instances) {
    if (!std::binary_search(products.begin(), products.end(), instance.product)) continue;
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const auto offset = pointCount(out);
    appendPositions(out.positions, mesh, instance.world_from_mesh);
    for (const auto& t : mesh.triangles) appendTriangle(out, t, offset, false, colour);
  }
  return out;
}

MergedTriangles mergeShapes(const CollideResult& collision) {
  static constexpr std::array<Rgba, 3> kColours = {Rgba{116, 170, 222, 255}, Rgba{134, 196, 148, 255},
                                                   Rgba{222, 178, 110, 255}};
  MergedTriangles out;
  for (const auto& shape : collision.shapes) {
    const auto offset = pointCount(out);
    appendPositions(out.positions, shape.mesh, Eigen::Affine3d::Identity());
    for (const auto& t : shape.mesh.triangles)
      appendTriangle(out, t, offset, false, kColours[static_cast<std::size_t>(shape.kind)]);
  }
  return out;
}

MergedTriangles mergeWalkable(const Mesh& mesh, Rgba colour) {
  constexpr float kLift_m = 0.03F, kStep_m = 0.12F;  // a stair has higher steps
  MergedTriangles out;
  appendPositions(out.positions, mesh, Eigen::Affine3d::Identity());
  for (const auto& t : mesh.triangles) appendTriangle(out, t, 0, false, colour);
  std::vector<std::size_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto at = [&](std::size_t i) { return &out.positions[3 * i]; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::lexicographical_compare(at(b), at(b) + 3, at(a), at(a) + 3);
  });
  float above = 0, height = 0;  // of the corner before, and what it is drawn at
  for (std::size_t k = 0; k < order.size(); ++k) {
    float* p = at(order[k]);
    const float* before = k > 0 ? at(order[k - 1]) : nullptr;
    const bool meets = before != nullptr && before[0] == p[0] && before[1] == p[1] && above - p[2] < kStep_m;
    above = p[2];
    if (!meets) height = p[2] + kLift_m;
    p[2] = height;
  }
  return out;
}

const std::vector<EdgeLine>& EdgeCache::edgesOf(const std::shared_ptr<const Mesh>& mesh) {
  auto& entry = entries_[mesh.get()];
  if (entry.mesh.lock() != mesh) entry = {mesh, featureEdges(*mesh, kSharp_rad)};
  return entry.lines;
}

void EdgeCache::forgetLost() {
  std::erase_if(entries_, [](const auto& e) { return e.second.mesh.expired(); });
}

MergedLines EdgeCache::edges(const ViewState& state, const std::vector<std::uint32_t>* only, InstanceRange range) {
  MergedLines out;
  for (std::size_t i = range.first; i < endOf(range, *state.environment); ++i) {
    const auto& instance = state.environment->instances[i];
    if (!range.holds(*state.environment, i) || !isShown(state, instance.product)) continue;
    if (only != nullptr && !std::binary_search(only->begin(), only->end(), instance.product)) continue;
    const auto& mesh = state.environment->meshes[instance.mesh];
    std::map<std::uint32_t, std::int64_t> placed;
    const auto place = [&](std::uint32_t corner) {
      const auto [entry, fresh] = placed.try_emplace(corner, static_cast<std::int64_t>(out.positions.size() / 3));
      if (fresh) {
        const Eigen::Vector3f p = (instance.world_from_mesh * mesh->positions[corner].cast<double>()).cast<float>();
        out.positions.insert(out.positions.end(), {p.x(), p.y(), p.z()});
      }
      return entry->second;
    };
    for (const auto& line : edgesOf(mesh)) {
      out.ends.push_back(place(line[0]));
      out.ends.push_back(place(line[1]));
    }
  }
  return out;
}

}  // namespace standpoint

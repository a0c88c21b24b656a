// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace standpoint {

namespace {

std::uint16_t sixteenBits(float value) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(value, 0.0F, 1.0F)));
}

class MeshReader {
 public:
  MeshReader(GltfFile& file, const GltfMaterials& materials, std::uint32_t no_material, const GltfPose& pose,
             Report& report)
      : file_(file), materials_(materials), no_material_(no_material), pose_(pose), report_(report) {}

  void add(const tinygltf::Primitive& gltf, const std::string& place) {
    GltfPrimitive primitive(file_, gltf, place);
    const auto material = gltfIndex(gltf.material);
    if (material && *material >= materials_.surface_of_material.size())
      file_.fail(place + "/material", "does not exist");
    if (file_.failed()) return;
    if (!primitive.isSurface())
      return report_.lose(place, "holds " + primitive.whatItIs() + ", which are not surfaces");
    const auto surface = material ? materials_.surface_of_material[*material] : no_material_;
    const auto [base, count] =
        vertices(primitive, material ? materials_.texture_of_material[*material] : materials_.without_material);
    if (file_.failed()) return;
    append(primitive.triangles(count, report_), base, surface);
  }

  // Vertices without triangles: our writer keeps them as points.
  void addPoints(const tinygltf::Primitive& gltf, const std::string& place) {
    GltfPrimitive primitive(file_, gltf, place);
    if (!file_.failed()) vertices(primitive, materials_.without_material);
  }

  GltfMesh take() {
    sortBySurface(mesh_);
    if (!features_.empty()) feature_of_vertex_.resize(mesh_.positions.size(), -1);
    return {std::move(mesh_), std::move(features_), std::move(feature_of_vertex_)};
  }

 private:
  struct Range {
    std::size_t base = 0, count = 0;
  };

  Range vertices(GltfPrimitive& primitive, const GltfTextureUse& use) {
    const std::string texture = "TEXCOORD_" + std::to_string(use.set);
    const auto& matrix = use.image_from_set.matrix();
    // Two primitives share their vertices when all that makes them is the same.
    const Key key{primitive.accessor("POSITION"),
                  primitive.accessor(texture),
                  primitive.accessor("COLOR_0"),
                  {matrix.data(), matrix.data() + matrix.size()},
                  poseKey(primitive) + featureKey(primitive) + (use.vertex_alpha ? "alpha" : "")};
    if (file_.failed()) return {};
    const bool shared = !primitive.compressed();
    if (const auto known = ranges_.find(key); shared && known != ranges_.end()) return known->second;
    auto positions = primitive.positions();
    const Range range{mesh_.positions.size(), positions.size()};
    applyPose(file_, primitive, pose_, positions);
    if (file_.failed()) return {};
    if (mesh_.positions.empty())
      mesh_.positions = std::move(positions);
    else
      mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
    textureCoordinates(primitive, texture, use, range);
    colours(primitive, use, range);
    features(primitive, range);
    if (shared) ranges_[key] = range;
    return range;
  }

  std::string poseKey(const GltfPrimitive& primitive) const {
    if (pose_ == GltfPose{}) return {};
    return nlohmann::json(primitive.gltf().targets).dump() + nlohmann::json(primitive.gltf().attributes).dump();
  }

  static std::string featureKey(const GltfPrimitive& primitive) {
    const auto features = gltfExtension(primitive.gltf(), "EXT_mesh_features");
    return features.is_null() ? "" : features.dump() + nlohmann::json(primitive.gltf().attributes).dump();
  }

  bool fits(GltfPrimitive& primitive, const std::string& attribute, std::size_t rows, std::size_t count) {
    if (rows != count && !file_.failed())
      file_.fail(primitive.place() + "/attributes/" + attribute,
                 "has " + std::to_string(rows) + " elements for " + std::to_string(count) + " vertices");
    return !file_.failed();
  }

  void textureCoordinates(GltfPrimitive& primitive, const std::string& attribute, const GltfTextureUse& use,
                          Range range) {
    auto& all = mesh_.texture_coordinates;
    const bool present = primitive.accessor(attribute).has_value();
    if (!present && all.empty()) return;
    if (!file_.spend(mesh_.positions.size() * 8 - all.size() * 8, primitive.place())) return;
    all.resize(mesh_.positions.size(), Eigen::Vector2f::Zero());
    if (!present) return;
    std::size_t components = 0;
    const auto values = primitive.floats(attribute, components);
    const bool plain = use.image_from_set.matrix().isIdentity(0);
    if (components != 2 && !file_.failed())
      file_.fail(primitive.place() + "/attributes/" + attribute, "must consist of pairs");
    if (file_.failed() || !fits(primitive, attribute, values.size() / 2, range.count)) return;
    for (std::size_t i = 0; i < range.count; ++i) {
      auto& t = all[range.base + i] = {values[2 * i], values[2 * i + 1]};
      if (!plain) t = (use.image_from_set * t.cast<double>()).cast<float>();
      if (!t.allFinite())
        return file_.fail(primitive.place() + "/attributes/" + attribute,
                          "element " + std::to_string(i) + " is not a finite number");
    }
  }

  void colours(GltfPrimitive& primitive, const GltfTextureUse& use, Range range) {
    auto& all = mesh_.colours;
    const bool present = primitive.accessor("COLOR_0").has_value();
    if (!present && all.empty()) return;
    if (!file_.spend(mesh_.positions.size() * 4 - all.size() * 4, primitive.place())) return;
    all.resize(mesh_.positions.size(), {255, 255, 255, 255});
    if (!present) return;
    std::size_t n = 0;
    const auto values = primitive.floats("COLOR_0", n);
    if (n != 3 && n != 4 && !file_.failed())
      file_.fail(primitive.place() + "/attributes/COLOR_0", "must consist of three or four numbers");
    if (file_.failed() || !fits(primitive, "COLOR_0", values.size() / n, range.count)) return;
    for (std::size_t i = 0; i < range.count; ++i) {
      auto& c = all[range.base + i];
      for (std::size_t k = 0; k < n; ++k) {
        if (!std::isfinite(values[n * i + k]))
          return file_.fail(primitive.place() + "/attributes/COLOR_0",
                            "element " + std::to_string(i) + " is not a finite number");
        const auto bits = sixteenBits(values[n * i + k]);
        if (k < 3)
          c[k] = srgb8FromLinear16(bits);
        else if (use.vertex_alpha)
          c[k] = static_cast<std::uint8_t>((bits + 128) / 257);
      }
    }
  }

  void features(GltfPrimitive& primitive, Range range) {
    const auto ids = featureIdsOf(file_, primitive.gltf(), "EXT_mesh_features", primitive.place());
    if (!ids.present || ids.attribute.empty() || file_.failed()) return;  // a feature for each vertex is no product
    std::size_t components = 0;
    const auto values = primitive.floats(ids.attribute, components);
    if (file_.failed() || !fits(primitive, ids.attribute, values.size(), range.count)) return;
    if (!file_.spend(mesh_.positions.size() * 4, primitive.place())) return;
    feature_of_vertex_.resize(mesh_.positions.size(), -1);
    for (std::size_t i = 0; i < range.count; ++i) {
      if (!(values[i] >= 0 && values[i] < 4e9F))
        return file_.fail(primitive.place() + "/attributes/" + ids.attribute,
                          "element " + std::to_string(i) + " is not a feature id");
      const auto row = static_cast<std::size_t>(values[i]);
      if (row == ids.null) continue;
      const auto [found, fresh] =
          index_of_feature_.try_emplace({ids.table, row}, static_cast<std::int32_t>(features_.size()));
      if (fresh) features_.push_back({ids.table, row});
      feature_of_vertex_[range.base + i] = found->second;
    }
  }

  void append(std::vector<Triangle>&& triangles, std::size_t base, std::uint32_t surface) {
    const auto offset = static_cast<std::uint32_t>(base);
    if (offset != 0)
      for (auto& t : triangles) t = {t[0] + offset, t[1] + offset, t[2] + offset};
    if (mesh_.triangles.empty())
      mesh_.triangles = std::move(triangles);
    else
      mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
    mesh_.surface_of_triangle.resize(mesh_.triangles.size(), surface);
  }

  using Key = std::tuple<std::optional<std::size_t>, std::optional<std::size_t>, std::optional<std::size_t>,
                         std::vector<double>, std::string>;

  GltfFile& file_;
  const GltfMaterials& materials_;
  std::uint32_t no_material_;
  const GltfPose& pose_;
  Report& report_;
  Mesh mesh_;
  std::map<Key, Range> ranges_;
  std::vector<GltfFeature> features_;
  std::map<GltfFeature, std::int32_t> index_of_feature_;
  std::vector<std::int32_t> feature_of_vertex_;
};

}  // namespace

bool GltfPose::operator==(const GltfPose& other) const {
  return weights == other.weights && joints.size() == other.joints.size() &&
         std::equal(joints.begin(), joints.end(), other.joints.begin(),
                    [](const auto& a, const auto& b) { return a.matrix() == b.matrix(); });
}

GltfMesh readGltfMesh(GltfFile& file, std::size_t index, const GltfMaterials& materials, std::uint32_t no_material,
                      const GltfPose& pose, Report& report) {
  const std::string place = "/meshes/" + std::to_string(index);
  const auto& primitives = file.element(file.model().meshes, "meshes", index, place).primitives;
  MeshReader reader(file, materials, no_material, pose, report);
  for (std::size_t i = 0; !file.failed() && i < primitives.size(); ++i)
    reader.add(primitives[i], place + "/primitives/" + std::to_string(i));
  return reader.take();
}

Mesh readGltfPoints(GltfFile& file, std::size_t index) {
  const std::string place = "/meshes/" + std::to_string(index);
  const auto& primitives = file.element(file.model().meshes, "meshes", index, place).primitives;
  Report ignored;
  GltfMaterials none;
  none.without_material.vertex_alpha = true;  // our own file: nothing is left out
  const GltfPose rest;
  MeshReader reader(file, none, 0, rest, ignored);
  if (!primitives.empty()) reader.addPoints(primitives[0], place + "/primitives/0");
  return reader.take().mesh;
}

}  // namespace standpoint

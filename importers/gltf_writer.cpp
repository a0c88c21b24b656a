// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <Eigen/SVD>
#include <nlohmann/json.hpp>

#include "importers/gltf_georeference.h"
#include "importers/gltf_mesh.h"
#include "importers/importers.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUnsignedInt = 5125, kFloat = 5126;
constexpr int kPoints = 0, kTriangles = 4;

// Written by hand with nlohmann-json, whose numbers read back bit for bit; tinygltf would not say so.
class GlbWriter {
 public:
  GlbWriter(const Environment& environment, const Georeference& georeference) : environment_(environment) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Standpoint"}};
    auto& ours = json_["asset"]["extras"]["standpoint"];
    ours = toJson(georeference);
    ours["products"] = environment.products.size();
    addMaterials();
    for (const auto& mesh : environment.meshes) addMesh(*mesh);
    ours["meshes"] = gltf_mesh_of_;
    addNodes();
    if (size_ > 0) json_["buffers"] = Json::array({Json{{"byteLength", size_}}});
  }

  Result<void> write(const std::filesystem::path& file, Progress& progress) const {
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + (size_ > 0 ? 8 + size_ : 0);
    if (total > 0xFFFFFFFFU)
      return failure(ErrorKind::unusable, "the environment needs more than the 4 GiB that a GLB can hold", file.string());
    std::ofstream out(file, std::ios::binary);
    const auto word = [&](std::size_t value) {
      const auto v = static_cast<std::uint32_t>(value);
      out.write(reinterpret_cast<const char*>(&v), 4);
    };
    out.write("glTF", 4);
    word(2);
    word(total);
    word(text.size());
    out.write("JSON", 4);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (size_ > 0) {
      word(size_);
      out.write("BIN\0", 4);
    }
    for (std::size_t i = 0; i < environment_.meshes.size() && out; ++i) {
      if (auto ok = progress.check(); !ok) return ok;
      writeMesh(*environment_.meshes[i], out);
      progress.advance(static_cast<double>(i + 1) / static_cast<double>(environment_.meshes.size()));
    }
    out.close();
    if (!out) return failure(ErrorKind::file_system, "cannot write", file.string());
    return {};
  }

 private:
  void addMaterials() {
    for (const auto& s : environment_.surfaces) {
      const auto& c = s.colour;
      Json extras = {{"srgb", {c.r, c.g, c.b, c.a}}, {"source", s.source}};
      if (s.metallic) extras["metallic"] = *s.metallic;
      if (s.roughness) extras["roughness"] = *s.roughness;
      const auto unit = [](float value) { return std::clamp(value, 0.0F, 1.0F); };
      Json material = {{"name", s.name}, {"doubleSided", true}, {"extras", {{"standpoint", std::move(extras)}}}};
      material["pbrMetallicRoughness"] = {
          {"baseColorFactor", {linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b), unit(c.a)}},
          {"metallicFactor", unit(s.metallic.value_or(0.0F))},
          {"roughnessFactor", unit(s.roughness.value_or(1.0F))}};
      if (c.a < 1) material["alphaMode"] = "BLEND";
      json_["materials"].push_back(std::move(material));
    }
  }

  std::size_t addView(std::size_t bytes, int target) {
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes}, {"target", target}});
    size_ += bytes;
    return json_["bufferViews"].size() - 1;
  }

  std::size_t addAccessor(Json accessor) {
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
  }

  std::size_t addPositions(const Mesh& mesh) {
    Eigen::Vector3f low = mesh.positions[0], high = mesh.positions[0];
    for (const auto& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return addAccessor({{"bufferView", addView(mesh.positions.size() * 12, kArrayBuffer)},
                        {"componentType", kFloat},
                        {"type", "VEC3"},
                        {"count", mesh.positions.size()},
                        {"min", {low.x(), low.y(), low.z()}},
                        {"max", {high.x(), high.y(), high.z()}}});
  }

  // One primitive for each run of a surface; a mesh of vertices only is kept as points, for a glTF mesh cannot be empty.
  void addMesh(const Mesh& mesh) {
    if (mesh.positions.empty()) return gltf_mesh_of_.push_back(nullptr);
    const std::size_t position = addPositions(mesh);
    Json primitives = Json::array();
    const auto& surfaces = mesh.surface_of_triangle;
    const std::size_t indices = surfaces.empty() ? 0 : addView(mesh.triangles.size() * 12, kElementArrayBuffer);
    for (std::size_t from = 0, to = 0; from < surfaces.size(); from = to) {
      while (to < surfaces.size() && surfaces[to] == surfaces[from]) ++to;
      const auto accessor = addAccessor({{"bufferView", indices},
                                         {"byteOffset", from * 12},
                                         {"componentType", kUnsignedInt},
                                         {"type", "SCALAR"},
                                         {"count", (to - from) * 3}});
      primitives.push_back({{"attributes", {{"POSITION", position}}}, {"indices", accessor}, {"material", surfaces[from]}, {"mode", kTriangles}});
    }
    if (primitives.empty()) primitives.push_back({{"attributes", {{"POSITION", position}}}, {"mode", kPoints}});
    gltf_mesh_of_.push_back(json_["meshes"].is_null() ? 0 : json_["meshes"].size());
    json_["meshes"].push_back({{"primitives", std::move(primitives)}});
  }

  // Node 0 turns our Z-up world into glTF's Y-up one by an exchange of axes, which costs no bit.
  void addNodes() {
    Json root = {{"name", "Z-up"}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}};
    json_["nodes"] = Json::array({root});
    Json children = Json::array();
    for (const auto& instance : environment_.instances) children.push_back(addInstance(instance));
    if (!children.empty()) json_["nodes"][0]["children"] = std::move(children);
    json_["scene"] = 0;
    json_["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
  }

  std::size_t addInstance(const Instance& instance) {
    const auto& m = instance.world_from_mesh.matrix();
    const Json matrix(std::vector<double>(m.data(), m.data() + 16));
    const auto& product = environment_.products[instance.product];
    Json extras = {{"standpoint", {{"product", instance.product}, {"mesh", instance.mesh}}}};
    if (!product.ifc_class.empty()) extras["ifc_class"] = product.ifc_class;
    if (!product.global_id.empty()) extras["global_id"] = product.global_id;
    Json node = {{"name", product.name}};
    const Json& mesh = gltf_mesh_of_[instance.mesh];
    if (isRotationAndScale(instance.world_from_mesh.linear())) {
      if (!m.isIdentity(0)) node["matrix"] = matrix;
      if (!mesh.is_null()) node["mesh"] = mesh;
    } else {
      extras["standpoint"]["matrix"] = matrix;
      addSheared(instance, mesh, node);
    }
    node["extras"] = std::move(extras);
    json_["nodes"].push_back(std::move(node));
    return json_["nodes"].size() - 1;
  }

  // A node's matrix must be rotation · scale (glTF 2.0 §3.5.3); what is sheared becomes two nodes by M = (U S) Vᵀ.
  void addSheared(const Instance& instance, const Json& mesh, Json& node) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(instance.world_from_mesh.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU(), v = svd.matrixV();
    Eigen::Vector3d s = svd.singularValues();
    if (u.determinant() < 0) { u = -u; s = -s; }
    if (v.determinant() < 0) { v = -v; s = -s; }
    const auto rotation = [](const Eigen::Matrix3d& r) {
      const Eigen::Quaterniond q = Eigen::Quaterniond(r).normalized();
      return Json{q.x(), q.y(), q.z(), q.w()};
    };
    const auto& t = instance.world_from_mesh.translation();
    node["translation"] = {t.x(), t.y(), t.z()};
    node["rotation"] = rotation(u);
    node["scale"] = {s.x(), s.y(), s.z()};
    Json inner = {{"name", node["name"]}, {"rotation", rotation(v.transpose())}, {"extras", {{"standpoint", {{"product", instance.product}}}}}};
    if (!mesh.is_null()) inner["mesh"] = mesh;
    json_["nodes"].push_back(std::move(inner));
    node["children"] = Json::array({json_["nodes"].size() - 1});
  }

  static bool isRotationAndScale(const Eigen::Matrix3d& linear) {
    const Eigen::Matrix3d dots = linear.transpose() * linear;
    if (std::abs(linear.determinant()) < 1e-9) return false;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < i; ++k)
        if (std::abs(dots(i, k)) > 1e-6 * std::sqrt(dots(i, i) * dots(k, k))) return false;
    return true;
  }

  static void writeMesh(const Mesh& mesh, std::ofstream& out) {
    static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Triangle) == 12);
    const auto bytes = [](std::size_t count) { return static_cast<std::streamsize>(count * 12); };
    out.write(reinterpret_cast<const char*>(mesh.positions.data()), bytes(mesh.positions.size()));
    if (!mesh.positions.empty()) out.write(reinterpret_cast<const char*>(mesh.triangles.data()), bytes(mesh.triangles.size()));
  }

  const Environment& environment_;
  Json json_ = Json::object();
  std::vector<Json> gltf_mesh_of_;   // null for a mesh without vertices
  std::size_t size_ = 0;             // of the binary chunk; every part is a multiple of 4
};

bool finiteColours(const Environment& environment) {
  return std::all_of(environment.surfaces.begin(), environment.surfaces.end(), [](const Surface& s) {
    const auto& c = s.colour;
    return std::isfinite(c.r + c.g + c.b + c.a + s.metallic.value_or(0) + s.roughness.value_or(0));
  });
}

}  // namespace

Result<void> writeEnvironmentGlb(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress) {
  progress.stage("Writing glTF");
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, file.string());
  if (!finiteColours(environment)) return failure(ErrorKind::internal, "a surface's colour is not finite", file.string());
  return GlbWriter(environment, georeference).write(file, progress);
}

}  // namespace standpoint

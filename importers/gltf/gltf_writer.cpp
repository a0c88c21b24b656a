// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include <Eigen/SVD>
#include <nlohmann/json.hpp>

#include "importers/gltf/gltf_companions.h"
#include "importers/gltf/gltf_georeference.h"
#include "importers/gltf/gltf_physical_material.h"
#include "importers/gltf/gltf_product.h"
#include "importers/gltf/gltf_writer_material.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kPoints = 0, kTriangles = 4;

std::string percentEncoded(const std::string& name) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string result;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if ((std::isalnum(u) != 0 && u < 128) || c == '-' || c == '_' || c == '.')
      result += c;
    else
      ((result += '%') += kDigits[u >> 4U]) += kDigits[u & 15U];
  }
  return result;
}

// Written by hand with nlohmann-json, whose numbers read back bit for bit; tinygltf would not say so.
class GlbWriter {
 public:
  enum class For { project, others };

  GlbWriter(const Environment& environment, const Georeference& georeference, For reader,
            const GltfCompanions& companions = {})
      : environment_(environment), reader_(reader) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Standpoint"}};
    auto& ours = json_["asset"]["extras"]["standpoint"];
    ours = toJson(georeference);
    ours["products"] = environment.products.size();
    addMaterials(companions);
    for (const auto& mesh : environment.meshes) gltf_mesh_of_.push_back(addMesh(mesh, true));
    if (reader == For::others) nameMeshes();
    listExtensions();
    ours["meshes"] = gltf_mesh_of_;
    addNodes(companions);
    if (size_ > 0) json_["buffers"] = Json::array({Json{{"byteLength", size_}}});
  }

  // JSON and a binary file of the same name beside it, which is there before the JSON names it.
  Result<void> writeText(const std::filesystem::path& file, Progress& progress) {
    auto beside = file;
    beside.replace_extension(".bin");
    if (size_ > 0) {
      json_["buffers"][0]["uri"] = percentEncoded(beside.filename().string());
      std::ofstream binary(beside, std::ios::binary);
      if (auto ok = writeBinary(binary, progress); !ok) return ok;
      binary.close();
      if (!binary) return failure(ErrorKind::file_system, "cannot write", beside.string());
    }
    std::ofstream out(file, std::ios::binary);
    out << text() << '\n';
    out.close();
    if (!out) return failure(ErrorKind::file_system, "cannot write", file.string());
    return {};
  }

  Result<void> write(const std::filesystem::path& file, Progress& progress) const {
    std::string text = this->text();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + (size_ > 0 ? 8 + size_ : 0);
    if (total > 0xFFFFFFFFU)
      return failure(ErrorKind::unusable, "the environment exceeds the 4 GiB limit of GLB files", file.string());
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
    if (auto ok = writeBinary(out, progress); !ok) return ok;
    out.close();
    if (!out) return failure(ErrorKind::file_system, "cannot write", file.string());
    return {};
  }

 private:
  std::string text() const { return json_.dump(-1, ' ', false, Json::error_handler_t::replace); }

  Result<void> writeBinary(std::ofstream& out, Progress& progress) const {
    for (const auto& image : environment_.images) writeImage(*image, out);
    for (std::size_t i = 0; i < stored_.size() && out; ++i) {
      if (auto ok = progress.check(); !ok) return ok;
      writeMesh(*stored_[i], out);
      progress.advance(static_cast<double>(i + 1) / static_cast<double>(stored_.size()));
    }
    return {};
  }

  void addMaterials(const GltfCompanions& companions) {
    for (std::size_t i = 0; i < environment_.surfaces.size(); ++i)
      json_["materials"].push_back(gltfMaterial(environment_.surfaces[i]));
    for (std::size_t i = 0; i < companions.physical.size(); ++i)
      if (companions.physical[i] != nullptr)
        json_["materials"][i]["extensions"][kGltfPhysicalMaterial] = gltfPhysicalMaterial(*companions.physical[i]);
    addImages();
    for (std::size_t i = 0; i < environment_.surfaces.size(); ++i)
      if (const auto texture = textureOf(i); !texture.is_null())
        json_["materials"][i]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  }

  // All images go into the file; those that glTF knows also as images of it.
  void addImages() {
    Json all = Json::array();
    for (const auto& image : environment_.images) {
      Json stored = {{"name", image->name}, {"media_type", image->media_type}};
      texture_of_image_.push_back(nullptr);
      if (!image->bytes.empty()) {
        stored["bufferView"] = addView(image->bytes.size());
        if (gltfMediaType(image->bytes) == image->media_type && !image->media_type.empty()) {
          texture_of_image_.back() = json_["textures"].is_null() ? 0 : json_["textures"].size();
          json_["images"].push_back(
              {{"bufferView", stored["bufferView"]}, {"mimeType", image->media_type}, {"name", image->name}});
          json_["textures"].push_back({{"source", json_["images"].size() - 1}});
        }
      }
      all.push_back(std::move(stored));
    }
    if (!all.empty()) json_["asset"]["extras"]["standpoint"]["images"] = std::move(all);
  }

  Json textureOf(std::size_t surface) const {
    const auto image = environment_.surfaces[surface].image;
    return image < 0 ? Json() : texture_of_image_[static_cast<std::size_t>(image)];
  }

  // A mesh without texture coordinates cannot use a material with an image: it gets the same material without it.
  std::size_t materialFor(const Mesh& mesh, std::size_t surface) {
    if (!mesh.texture_coordinates.empty() || textureOf(surface).is_null()) return surface;
    const auto [found, fresh] = plain_of_.try_emplace(surface, json_["materials"].size());
    if (fresh) {
      Json plain = json_["materials"][surface];
      plain["pbrMetallicRoughness"].erase("baseColorTexture");
      plain["extras"]["standpoint"]["plain_of"] = surface;
      json_["materials"].push_back(std::move(plain));
    }
    return found->second;
  }

  std::size_t addView(std::size_t bytes, int target = 0) {
    Json view = {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(std::move(view));
    size_ += (bytes + 3) / 4 * 4;
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

  Json addAttributes(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    Json attributes = {{"POSITION", addPositions(mesh)}};
    if (!mesh.texture_coordinates.empty())
      attributes["TEXCOORD_0"] = addAccessor({{"bufferView", addView(count * 8, kArrayBuffer)},
                                              {"componentType", kFloat},
                                              {"type", "VEC2"},
                                              {"count", count}});
    if (!mesh.colours.empty())
      attributes["COLOR_0"] = addAccessor({{"bufferView", addView(count * 8, kArrayBuffer)},
                                           {"componentType", kUnsignedShort},
                                           {"normalized", true},
                                           {"type", "VEC4"},
                                           {"count", count}});
    return attributes;
  }

  // One primitive for each run of a surface; a mesh of vertices only is kept as points, for a glTF mesh cannot be
  // empty.
  Json addMesh(const std::shared_ptr<const Mesh>& shared, bool with_materials) {
    const Mesh& mesh = *shared;
    stored_.push_back(shared);
    if (mesh.positions.empty()) return nullptr;
    const Json attributes = addAttributes(mesh);
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
      primitives.push_back({{"attributes", attributes}, {"indices", accessor}, {"mode", kTriangles}});
      if (with_materials) primitives.back()["material"] = materialFor(mesh, surfaces[from]);
    }
    if (primitives.empty()) primitives.push_back({{"attributes", attributes}, {"mode", kPoints}});
    json_["meshes"].push_back({{"primitives", std::move(primitives)}});
    return json_["meshes"].size() - 1;
  }

  // Of a companion: stored once, whoever shows it.
  Json meshOf(const std::shared_ptr<const Mesh>& mesh, const std::string& name, bool with_materials) {
    if (gltf_mesh_.empty())
      for (std::size_t i = 0; i < environment_.meshes.size(); ++i)
        gltf_mesh_.emplace(environment_.meshes[i].get(), gltf_mesh_of_[i]);
    const auto [found, fresh] = gltf_mesh_.try_emplace(mesh.get(), nullptr);
    if (!fresh) return found->second;
    found->second = addMesh(mesh, with_materials);
    if (!found->second.is_null()) json_["meshes"][found->second.get<std::size_t>()]["name"] = name;
    return found->second;
  }

  void listExtensions() {
    std::set<std::string> used;
    for (const auto& material : json_["materials"])
      if (material.contains("extensions"))
        for (const auto& [name, ignored] : material["extensions"].items()) used.insert(name);
    if (!used.empty()) json_["extensionsUsed"] = used;
    if (json_["materials"].is_null()) json_.erase("materials");
  }

  // Node 0 turns our Z-up world into glTF's Y-up one by an exchange of axes, which costs no bit.
  void addNodes(const GltfCompanions& companions) {
    Json root = {{"name", "Z-up"}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}};
    json_["nodes"] = Json::array({root});
    Json children = Json::array();
    const auto& instances = environment_.instances;
    for (std::size_t first = 0, last = 0; first < instances.size(); first = last) {
      while (last < instances.size() && instances[last].product == instances[first].product) ++last;
      if (reader_ == For::others) {
        children.push_back(addProduct(first, last));
        node_of_product_[instances[first].product] = children.back();
      } else {
        for (std::size_t i = first; i < last; ++i)
          children.push_back(addInstance(instances[i], gltf_mesh_of_[instances[i].mesh]));
      }
    }
    GltfScene scene{json_, [&](const auto& mesh, const auto& name) { return meshOf(mesh, name, true); },
                    [&](const auto& mesh, const auto& name) { return meshOf(mesh, name, false); },
                    [&](const auto& instance, const auto& mesh) { return addInstance(instance, mesh); }};
    addGltfLevels(scene, environment_, companions.levels, node_of_product_);
    if (companions.collision)
      for (const auto node : addGltfCollision(scene, environment_, *companions.collision, node_of_product_))
        children.push_back(node);
    if (!children.empty()) json_["nodes"][0]["children"] = std::move(children);
    json_["scene"] = 0;
    json_["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
  }

  std::size_t addProduct(std::size_t first, std::size_t last) {
    const auto index = environment_.instances[first].product;
    const auto& product = environment_.products[index];
    Json extras = toExtras(product);
    extras["standpoint"] = {{"product", index}};
    Json parts = Json::array();
    for (std::size_t i = first; i < last; ++i) {
      parts.push_back(addInstance(environment_.instances[i], gltf_mesh_of_[environment_.instances[i].mesh]));
      json_["nodes"].back().erase("extras");
    }
    if (parts.size() == 1) {
      json_["nodes"].back()["extras"] = std::move(extras);
      return parts[0];
    }
    json_["nodes"].push_back({{"name", product.name}, {"children", std::move(parts)}, {"extras", std::move(extras)}});
    return json_["nodes"].size() - 1;
  }

  // After the first product that shows them, as people look for them in a list.
  void nameMeshes() {
    for (const auto& instance : environment_.instances)
      if (const auto& mesh = gltf_mesh_of_[instance.mesh];
          !mesh.is_null() && !json_["meshes"][mesh.get<std::size_t>()].contains("name"))
        json_["meshes"][mesh.get<std::size_t>()]["name"] = environment_.products[instance.product].name;
  }

  std::size_t addInstance(const Instance& instance, const Json& mesh) {
    const auto& m = instance.world_from_mesh.matrix();
    const Json matrix(std::vector<double>(m.data(), m.data() + 16));
    const auto& product = environment_.products[instance.product];
    Json extras = {{"standpoint", {{"product", instance.product}, {"mesh", instance.mesh}}}};
    if (!product.ifc_class.empty()) extras["ifc_class"] = product.ifc_class;
    if (!product.global_id.empty()) extras["global_id"] = product.global_id;
    Json node = {{"name", product.name}};
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
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(instance.world_from_mesh.linear(),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU(), v = svd.matrixV();
    Eigen::Vector3d s = svd.singularValues();
    if (u.determinant() < 0) {
      u = -u;
      s = -s;
    }
    if (v.determinant() < 0) {
      v = -v;
      s = -s;
    }
    const auto rotation = [](const Eigen::Matrix3d& r) {
      const Eigen::Quaterniond q = Eigen::Quaterniond(r).normalized();
      return Json{q.x(), q.y(), q.z(), q.w()};
    };
    const auto& t = instance.world_from_mesh.translation();
    node["translation"] = {t.x(), t.y(), t.z()};
    node["rotation"] = rotation(u);
    node["scale"] = {s.x(), s.y(), s.z()};
    Json inner = {{"name", node["name"]},
                  {"rotation", rotation(v.transpose())},
                  {"extras", {{"standpoint", {{"product", instance.product}}}}}};
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

  template <class T>
  static void writeAll(const std::vector<T>& values, std::ofstream& out) {
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  }

  // In the order of the views that addImages and addMesh made.
  static void writeMesh(const Mesh& mesh, std::ofstream& out) {
    static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Triangle) == 12 && sizeof(Eigen::Vector2f) == 8);
    if (mesh.positions.empty()) return;
    writeAll(mesh.positions, out);
    writeAll(mesh.texture_coordinates, out);
    std::vector<std::array<std::uint16_t, 4>> linear;
    linear.reserve(mesh.colours.size());
    for (const auto& c : mesh.colours)
      linear.push_back({linear16FromSrgb8(c[0]), linear16FromSrgb8(c[1]), linear16FromSrgb8(c[2]),
                        static_cast<std::uint16_t>(c[3] * 257)});
    writeAll(linear, out);
    writeAll(mesh.triangles, out);
  }

  static void writeImage(const Image& image, std::ofstream& out) {
    writeAll(image.bytes, out);
    out.write("\0\0\0", static_cast<std::streamsize>((4 - image.bytes.size() % 4) % 4));
  }

  const Environment& environment_;
  For reader_;
  Json json_ = Json::object();
  std::vector<Json> gltf_mesh_of_;         // of the environment's meshes; null for one without vertices
  std::map<const Mesh*, Json> gltf_mesh_;  // with those of companions
  std::map<std::uint32_t, std::size_t> node_of_product_;
  std::vector<std::shared_ptr<const Mesh>> stored_;  // in the order of the views
  std::vector<Json> texture_of_image_;               // null for an image that glTF does not know
  std::map<std::size_t, std::size_t> plain_of_;      // surface with an image → material without it
  std::size_t size_ = 0;                             // of the binary chunk; every part is a multiple of 4
};

Result<void> writable(const Environment& environment, const std::filesystem::path& file) {
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, file.string());
  if (!std::all_of(environment.surfaces.begin(), environment.surfaces.end(), isFinite))
    return failure(ErrorKind::internal, "a surface's colour is not finite", file.string());
  return {};
}

}  // namespace

Result<void> writeEnvironmentGlb(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress) {
  progress.stage("Writing glTF");
  if (auto ok = writable(environment, file); !ok) return ok;
  return GlbWriter(environment, georeference, GlbWriter::For::project).write(file, progress);
}

Result<void> exportEnvironmentGltf(const Environment& environment, const Georeference& georeference,
                                   const std::filesystem::path& file, Progress& progress,
                                   const GltfCompanions& companions) {
  progress.stage("Writing glTF");
  if (auto ok = writable(environment, file); !ok) return ok;
  GlbWriter writer(environment, georeference, GlbWriter::For::others, companions);
  return file.extension() == ".gltf" ? writer.writeText(file, progress) : writer.write(file, progress);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <streambuf>
#include <utility>

#include <Eigen/Geometry>

#include "core/decompositions.h"
#include "core/part_file.h"
#include "importers/gltf/gltf_companions.h"
#include "importers/gltf/gltf_georeference.h"
#include "importers/gltf/gltf_physical_material.h"
#include "importers/gltf/gltf_product.h"
#include "importers/gltf/gltf_writer_material.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

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

// What tinygltf writes to a stream goes to a file being made.
class PartBuffer : public std::streambuf {
 public:
  explicit PartBuffer(PartFile& file) : file_(file) {}
  Result<void> flushed() {
    sync();
    return written_;
  }

 private:
  static constexpr std::size_t kBuffered = 1U << 20U;

  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char byte = traits_type::to_char_type(c);
    return xsputn(&byte, 1) == 1 ? c : traits_type::eof();
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    buffer_.append(bytes, static_cast<std::size_t>(count));
    return buffer_.size() < kBuffered || sync() == 0 ? count : 0;
  }
  int sync() override {
    if (written_) written_ = file_.append(buffer_);
    buffer_.clear();
    return written_ ? 0 : -1;
  }

  PartFile& file_;
  std::string buffer_;
  Result<void> written_;
};

// Fills a tinygltf model, which tinygltf serialises.
class GltfWriter {
 public:
  enum class For { project, others };

  GltfWriter(const Environment& environment, const Georeference& georeference, For reader,
             const GltfCompanions& companions = {})
      : environment_(environment), reader_(reader) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Standpoint";
    model_.defaultScene = 0;
    Json ours = toJson(georeference);
    ours["products"] = environment.products.size();
    addMaterials(companions);
    if (auto images = addImages(); !images.empty()) ours["images"] = std::move(images);
    useImages();
    for (const auto& mesh : environment.meshes) gltf_mesh_of_.push_back(addMesh(mesh, true));
    if (reader == For::others) nameMeshes();
    listExtensions();
    ours["meshes"] = gltf_mesh_of_;
    model_.asset.extras = gltfValue({{"standpoint", ours}});
    addNodes(companions);
  }

  // JSON, and beside it a binary file of the same name.
  Result<void> writeText(const std::filesystem::path& file, Progress& progress) {
    auto beside = file;
    beside.replace_extension(".bin");
    TRY(fillBuffer(file, progress));
    const auto buffers = std::exchange(model_.buffers, {});  // which tinygltf would embed as text
    std::ostringstream text;
    if (!serialise(text, false)) return failure(ErrorKind::internal, "tinygltf cannot serialise it", file.string());
    Json json = Json::parse(text.str());
    if (!buffers.empty()) {
      const auto& data = buffers[0].data;
      json["buffers"] = {{{"byteLength", data.size()}, {"uri", percentEncoded(beside.filename().string())}}};
      TRY_ASSIGN(auto binary, PartFile::create(beside));
      TRY(binary.append(data));
      TRY_ASSIGN(auto out, PartFile::create(file));
      TRY(out.append(json.dump() + '\n'));
      TRY(binary.commit());
      return out.commit();
    }
    return writeWholeText(file, json.dump() + '\n');
  }

  Result<void> write(PartFile& file, Progress& progress) {
    TRY(fillBuffer(file.file(), progress));
    PartBuffer buffer(file);
    std::ostream out(&buffer);
    const bool serialised = serialise(out, true);
    TRY(buffer.flushed());
    if (!serialised) return failure(ErrorKind::internal, "tinygltf cannot serialise it", file.file().string());
    return file.size() > std::uint64_t{kLargestGlb} ? tooLarge(file.file()) : Result<void>{};  // its header lies then
  }

 private:
  static constexpr std::int64_t kLargestGlb = 0xFFFFFFFF;

  static Result<void> tooLarge(const std::filesystem::path& file) {
    return failure(ErrorKind::unusable, "the environment exceeds the 4 GiB limit of GLB files", file.string());
  }

  bool serialise(std::ostream& out, bool binary) const {
    try {
      return tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, binary);
    } catch (const std::exception&) {
      return false;
    }
  }

  // In the order of the views that addImages and addMesh made.
  Result<void> fillBuffer(const std::filesystem::path& file, Progress& progress) {
    if (size_ > std::size_t{kLargestGlb}) return tooLarge(file);
    if (size_ == 0) return {};
    model_.buffers.resize(1);
    auto& data = model_.buffers[0].data;
    data.reserve(size_);
    for (const auto& image : environment_.images) append(image->bytes, data);
    for (std::size_t i = 0; i < stored_.size(); ++i) {
      if (auto ok = progress.check(); !ok) return ok;
      appendMesh(*stored_[i], data);
      progress.advance(static_cast<double>(i + 1) / static_cast<double>(stored_.size()));
    }
    return {};
  }

  void addMaterials(const GltfCompanions& companions) {
    for (const auto& surface : environment_.surfaces) model_.materials.push_back(gltfMaterial(surface));
    for (std::size_t i = 0; i < companions.physical.size(); ++i)
      if (companions.physical[i] != nullptr)
        model_.materials[i].extensions[kGltfPhysicalMaterial] =
            gltfValue(gltfPhysicalMaterial(*companions.physical[i]));
  }

  // All images go into the file; those that glTF knows also as images of it. Returns how to find them all.
  Json addImages() {
    Json all = Json::array();
    for (const auto& image : environment_.images) {
      Json stored = {{"name", image->name}, {"media_type", image->media_type}};
      texture_of_image_.push_back(-1);
      if (!image->bytes.empty()) {
        const int view = addView(image->bytes.size());
        stored["bufferView"] = view;
        if (gltfMediaType(image->bytes) == image->media_type && !image->media_type.empty())
          texture_of_image_.back() = addTexture(*image, view);
      }
      all.push_back(std::move(stored));
    }
    return all;
  }

  int addTexture(const Image& image, int view) {
    tinygltf::Image gltf_image;
    gltf_image.bufferView = view;
    gltf_image.mimeType = image.media_type;
    gltf_image.name = gltfName(image.name);
    tinygltf::Texture texture;
    texture.source = added(model_.images, std::move(gltf_image));
    return added(model_.textures, std::move(texture));
  }

  void useImages() {
    for (std::size_t i = 0; i < environment_.surfaces.size(); ++i)
      model_.materials[i].pbrMetallicRoughness.baseColorTexture.index = textureOf(i);
  }

  int textureOf(std::size_t surface) const {
    const auto image = environment_.surfaces[surface].image;
    return image < 0 ? -1 : texture_of_image_[static_cast<std::size_t>(image)];
  }

  // A mesh without texture coordinates cannot use a material with an image: it gets the same material without it.
  int materialFor(const Mesh& mesh, std::uint32_t surface) {
    if (!mesh.texture_coordinates.empty() || textureOf(surface) < 0) return static_cast<int>(surface);
    const auto [found, fresh] = plain_of_.try_emplace(surface, static_cast<int>(model_.materials.size()));
    if (fresh) {
      tinygltf::Material plain = model_.materials[surface];
      plain.pbrMetallicRoughness.baseColorTexture.index = -1;
      memberOf(memberOf(plain.extras, "standpoint"), "plain_of") = gltfValue(surface);
      model_.materials.push_back(std::move(plain));
    }
    return found->second;
  }

  template <class T>
  static int added(std::vector<T>& list, T element) {
    list.push_back(std::move(element));
    return static_cast<int>(list.size() - 1);
  }

  int addView(std::size_t bytes, int target = 0) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = size_;
    view.byteLength = bytes;
    view.target = target;
    size_ += (bytes + 3) / 4 * 4;
    return added(model_.bufferViews, std::move(view));
  }

  // With a view of its own: tinygltf writes an accessor's own offset with 32 bits.
  int addAccessor(int component_type, int type, std::size_t count, int target) {
    tinygltf::Accessor accessor;
    const auto component = static_cast<std::uint32_t>(component_type), columns = static_cast<std::uint32_t>(type);
    const auto size = tinygltf::GetComponentSizeInBytes(component) * tinygltf::GetNumComponentsInType(columns);
    accessor.bufferView = addView(count * static_cast<std::size_t>(size), target);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    return added(model_.accessors, std::move(accessor));
  }

  int addVertices(int component_type, int type, const Mesh& mesh) {
    return addAccessor(component_type, type, mesh.positions.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  int addPositions(const Mesh& mesh) {
    Eigen::Vector3f low = mesh.positions[0], high = mesh.positions[0];
    for (const auto& p : mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const int index = addVertices(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh);
    model_.accessors.back().minValues.assign(low.begin(), low.end());
    model_.accessors.back().maxValues.assign(high.begin(), high.end());
    return index;
  }

  std::map<std::string, int> addAttributes(const Mesh& mesh) {
    std::map<std::string, int> attributes = {{"POSITION", addPositions(mesh)}};
    if (!mesh.texture_coordinates.empty())
      attributes["TEXCOORD_0"] = addVertices(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, mesh);
    if (!mesh.colours.empty()) {
      attributes["COLOR_0"] = addVertices(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, mesh);
      model_.accessors.back().normalized = true;
    }
    return attributes;
  }

  // One primitive for each run of a surface; a mesh of vertices only is kept as points, for a glTF mesh cannot be
  // empty. One without vertices is no glTF mesh: −1.
  int addMesh(const std::shared_ptr<const Mesh>& shared, bool with_materials) {
    const Mesh& mesh = *shared;
    stored_.push_back(shared);
    if (mesh.positions.empty()) return -1;
    tinygltf::Primitive primitive;
    primitive.attributes = addAttributes(mesh);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Mesh result;
    const auto& surfaces = mesh.surface_of_triangle;
    for (std::size_t from = 0, to = 0; from < surfaces.size(); from = to) {
      while (to < surfaces.size() && surfaces[to] == surfaces[from]) ++to;
      primitive.indices = addAccessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, (to - from) * 3,
                                      TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      if (with_materials) primitive.material = materialFor(mesh, surfaces[from]);
      result.primitives.push_back(primitive);
    }
    if (result.primitives.empty()) {
      primitive.mode = TINYGLTF_MODE_POINTS;
      result.primitives.push_back(primitive);
    }
    return added(model_.meshes, std::move(result));
  }

  // Of a companion: stored once, whoever shows it.
  int meshOf(const std::shared_ptr<const Mesh>& mesh, const std::string& name, bool with_materials) {
    if (gltf_mesh_.empty())
      for (std::size_t i = 0; i < environment_.meshes.size(); ++i)
        gltf_mesh_.emplace(environment_.meshes[i].get(), gltf_mesh_of_[i]);
    const auto [found, fresh] = gltf_mesh_.try_emplace(mesh.get(), -1);
    if (!fresh) return found->second;
    found->second = addMesh(mesh, with_materials);
    if (found->second >= 0) model_.meshes.back().name = gltfName(name);
    return found->second;
  }

  void listExtensions() {
    std::set<std::string> used;
    for (const auto& material : model_.materials)
      for (const auto& [name, ignored] : material.extensions) used.insert(name);
    model_.extensionsUsed.assign(used.begin(), used.end());
  }

  // Node 0 turns our Z-up world into glTF's Y-up one by an exchange of axes, which costs no bit.
  void addNodes(const GltfCompanions& companions) {
    tinygltf::Node root;
    root.name = "Z-up";
    root.matrix = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    model_.nodes.push_back(std::move(root));
    std::vector<int> children;
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
    GltfScene scene{model_, [&](const auto& mesh, const auto& name) { return meshOf(mesh, name, true); },
                    [&](const auto& mesh, const auto& name) { return meshOf(mesh, name, false); },
                    [&](const auto& instance, int mesh) { return addInstance(instance, mesh); }};
    addGltfLevels(scene, environment_, companions.levels, node_of_product_);
    if (companions.collision)
      for (const int node : addGltfCollision(scene, environment_, *companions.collision, node_of_product_))
        children.push_back(node);
    model_.nodes[0].children = std::move(children);
    model_.scenes.resize(1);
    model_.scenes[0].nodes = {0};
  }

  int addProduct(std::size_t first, std::size_t last) {
    const auto index = environment_.instances[first].product;
    const auto& product = environment_.products[index];
    Json extras = toExtras(product);
    extras["standpoint"] = {{"product", index}};
    const auto of_part = last - first > 1 ? partExtras(product) : Json::object();
    std::vector<int> parts;
    for (std::size_t i = first; i < last; ++i) {
      parts.push_back(addInstance(environment_.instances[i], gltf_mesh_of_[environment_.instances[i].mesh]));
      model_.nodes.back().extras = of_part.empty() ? tinygltf::Value() : gltfValue(of_part);
    }
    if (parts.size() > 1) {
      tinygltf::Node node;
      node.name = gltfName(product.name);
      node.children = std::move(parts);
      model_.nodes.push_back(std::move(node));
    }
    model_.nodes.back().extras = gltfValue(extras);
    return static_cast<int>(model_.nodes.size() - 1);
  }

  // After the first product that shows them, as people look for them in a list.
  void nameMeshes() {
    for (const auto& instance : environment_.instances) {
      const int mesh = gltf_mesh_of_[instance.mesh];
      if (mesh < 0) continue;
      auto& name = model_.meshes[static_cast<std::size_t>(mesh)].name;
      if (name.empty()) name = gltfName(environment_.products[instance.product].name);
    }
  }

  int addInstance(const Instance& instance, int mesh) {
    const auto& m = instance.world_from_mesh.matrix();
    const std::vector<double> matrix(m.data(), m.data() + 16);
    const auto& product = environment_.products[instance.product];
    Json extras = {{"standpoint", {{"product", instance.product}, {"mesh", instance.mesh}}}};
    if (!product.ifc_class.empty()) extras["ifc_class"] = product.ifc_class;
    if (!product.global_id.empty()) extras["global_id"] = product.global_id;
    tinygltf::Node node;
    node.name = gltfName(product.name);
    if (isRotationAndScale(instance.world_from_mesh.linear())) {
      if (!m.isIdentity(0)) node.matrix = matrix;
      node.mesh = mesh;
    } else {
      extras["standpoint"]["matrix"] = matrix;
      addSheared(instance, mesh, node);
    }
    node.extras = gltfValue(extras);
    return added(model_.nodes, std::move(node));
  }

  // A node's matrix must be rotation · scale (glTF 2.0 §3.5.3); what is sheared becomes two nodes by M = (U S) Vᵀ.
  void addSheared(const Instance& instance, int mesh, tinygltf::Node& node) {
    auto [u, s, v] = singularValues(instance.world_from_mesh.linear());
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
      return std::vector<double>{q.x(), q.y(), q.z(), q.w()};
    };
    const auto& t = instance.world_from_mesh.translation();
    node.translation = {t.x(), t.y(), t.z()};
    node.rotation = rotation(u);
    node.scale = {s.x(), s.y(), s.z()};
    tinygltf::Node inner;
    inner.name = node.name;
    inner.rotation = rotation(v.transpose());
    if (const auto extras = reader_ == For::others ? partExtras(environment_.products[instance.product])
                                                   : Json{{"standpoint", {{"product", instance.product}}}};
        !extras.empty())
      inner.extras = gltfValue(extras);  // of others, the node above is the product's
    inner.mesh = mesh;
    node.children = {added(model_.nodes, std::move(inner))};
  }

  static bool isRotationAndScale(const Eigen::Matrix3d& linear) {
    const Eigen::Matrix3d dots = linear.transpose() * linear;
    if (std::abs(linear.determinant()) < 1e-9) return false;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < i; ++k)
        if (std::abs(dots(i, k)) > 1e-6 * std::sqrt(dots(i, i) * dots(k, k))) return false;
    return true;
  }

  // And zeros to the next multiple of 4.
  template <class T>
  static void append(const std::vector<T>& values, std::vector<unsigned char>& out) {
    const auto* first = reinterpret_cast<const unsigned char*>(values.data());
    out.insert(out.end(), first, first + values.size() * sizeof(T));
    out.resize((out.size() + 3) / 4 * 4);
  }

  static void appendMesh(const Mesh& mesh, std::vector<unsigned char>& out) {
    static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Triangle) == 12 && sizeof(Eigen::Vector2f) == 8);
    if (mesh.positions.empty()) return;
    append(mesh.positions, out);
    append(mesh.texture_coordinates, out);
    std::vector<std::array<std::uint16_t, 4>> linear;
    linear.reserve(mesh.colours.size());
    for (const auto& c : mesh.colours)
      linear.push_back({linear16FromSrgb8(c[0]), linear16FromSrgb8(c[1]), linear16FromSrgb8(c[2]),
                        static_cast<std::uint16_t>(c[3] * 257)});
    append(linear, out);
    append(mesh.triangles, out);
  }

  const Environment& environment_;
  For reader_;
  tinygltf::Model model_;
  std::vector<int> gltf_mesh_of_;         // of the environment's meshes
  std::map<const Mesh*, int> gltf_mesh_;  // with those of companions
  std::map<std::uint32_t, int> node_of_product_;
  std::vector<std::shared_ptr<const Mesh>> stored_;  // in the order of the views
  std::vector<int> texture_of_image_;                // −1 for an image that glTF does not know
  std::map<std::uint32_t, int> plain_of_;            // surface with an image → material without it
  std::size_t size_ = 0;                             // of the buffer; every part is a multiple of 4
};

Result<void> writable(const Environment& environment, const std::filesystem::path& file) {
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, file.string());
  if (!std::all_of(environment.surfaces.begin(), environment.surfaces.end(), isFinite))
    return failure(ErrorKind::internal, "a surface's colour is not finite", file.string());
  return {};
}

}  // namespace

Result<void> writeEnvironmentGlb(const Environment& environment, const Georeference& georeference, PartFile& file,
                                 Progress& progress) {
  progress.stage("Writing glTF");
  TRY(writable(environment, file.file()));
  return GltfWriter(environment, georeference, GltfWriter::For::project).write(file, progress);
}

Result<void> exportEnvironmentGltf(const Environment& environment, const Georeference& georeference,
                                   const std::filesystem::path& file, Progress& progress,
                                   const GltfCompanions& companions) {
  progress.stage("Writing glTF");
  TRY(writable(environment, file));
  GltfWriter writer(environment, georeference, GltfWriter::For::others, companions);
  if (file.extension() == ".gltf") return writer.writeText(file, progress);
  TRY_ASSIGN(auto part, PartFile::create(file));
  TRY(writer.write(part, progress));
  return part.commit();
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <istream>
#include <map>
#include <set>
#include <sstream>

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include "importers/obj_lines.h"
#include "importers/obj_polygon.h"

namespace standpoint {

namespace {

// Beyond this a float step is above 4 µm, so a product gets a whole-metre origin of its own.
constexpr double kFarFromOrigin_m = 64;

struct Face {
  std::size_t begin = 0;       // first of its corners
  std::uint32_t corners = 0;
  std::uint32_t product = 0;
  std::uint32_t surface = 0;
  std::uint32_t line = 0;
};

// A kind of loss that may come a million times: said once, with the first line and the number.
struct Tally {
  const char* what;
  std::size_t first_line = 0, count = 0;
};

std::string_view firstWord(std::string_view statement) { return statement.substr(0, statement.find_first_of(" \t")); }

std::string_view afterFirstWord(std::string_view statement) {
  const auto space = statement.find_first_of(" \t");
  if (space == std::string_view::npos) return {};
  const auto start = statement.find_first_not_of(" \t", space);
  return start == std::string_view::npos ? std::string_view{} : statement.substr(start);
}

std::vector<std::string> words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, Progress& progress) : path_(path), progress_(progress) {}

  Result<void> read() {
    std::error_code code;
    const auto size = std::filesystem::file_size(path_, code);
    if (code) return failure(ErrorKind::file_system, "cannot read: " + code.message(), path_.string());
    std::string text(size, '\0');
    std::ifstream stream(path_, std::ios::binary);
    if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
      return failure(ErrorKind::file_system, "cannot read", path_.string());
    if (text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE"))
      return failure(ErrorKind::unusable, "is UTF-16; save it as UTF-8", path_.filename().string() + " byte 0");
    std::string_view content = text;
    if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
    parse(content);
    if (largest_index_ > vertices.size())
      fault(largest_index_line_, "refers to vertex " + std::to_string(largest_index_) + ", there are " + std::to_string(vertices.size()));
    if (auto ok = progress_.check(); !ok) return ok;
    if (error_) return failure(*error_);
    finish();
    return {};
  }

  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<Face> faces;
  std::vector<Product> products;
  std::vector<Surface> surfaces;
  Report report;

 private:
  void parse(std::string_view content) {
    ObjLines lines(content, [this](std::string_view statement) { return keep(statement); });
    lines_ = &lines;
    std::istream stream(&lines);
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* self, double x, double y, double z, double) { static_cast<ObjReader*>(self)->vertex({x, y, z}); };
    callback.index_cb = [](void* self, tinyobj::index_t* corner, int count) {
      static_cast<ObjReader*>(self)->face(corner, static_cast<std::size_t>(count));
    };
    std::string warnings, errors;
    tinyobj::LoadObjWithCallback(stream, callback, this, nullptr, &warnings, &errors);
    lines_ = nullptr;
  }

  void fault(std::size_t line, std::string message) {
    if (error_) return;
    error_ = Error{ErrorKind::unusable, std::move(message), path_.filename().string() + " line " + std::to_string(line)};
    if (lines_ != nullptr) lines_->stop();
  }

  // The library reads vertices and faces; the other statements are few and need the line.
  bool keep(std::string_view statement) {
    if ((++statements_ & 0xFFFFU) == 0) {
      progress_.advance(0.8 * lines_->share());
      if (progress_.cancelled()) lines_->stop();
    }
    const auto key = firstWord(statement);
    const auto rest = afterFirstWord(statement);
    if (key == "v") return checkVertex(rest);
    if (key == "f" || key == "fo") return checkFace(rest);
    if (key == "o") object_ = rest, group_.clear(), changed_ = true;
    else if (key == "g") group_ = rest == "default" ? std::string_view{} : rest, changed_ = true;
    else if (key == "usemtl") useMaterial(rest);
    else if (key == "mtllib") loadMaterials(rest);
    else countWhatIsLost(key);
    return false;
  }

  void countWhatIsLost(std::string_view key) {
    constexpr std::array<std::string_view, 6> kFreeForm = {"curv", "curv2", "surf", "trim", "hole", "bzp"};
    if (key == "p") add(points_);
    if (key == "l") add(polylines_);
    if (std::find(kFreeForm.begin(), kFreeForm.end(), key) != kFreeForm.end() || key == "bsp") add(free_form_);
  }

  void add(Tally& tally) const {
    if (tally.count++ == 0) tally.first_line = lines_->line();
  }

  bool checkVertex(std::string_view rest) {
    std::size_t tokens = 0;
    bool inside = false;
    for (const char c : rest) {
      const bool space = c == ' ' || c == '\t';
      if (!space && !inside) ++tokens;
      inside = !space;
      if (space || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E') continue;
      fault(lines_->line(), "'" + std::string(rest.substr(0, 60)) + "' is not three numbers");
      return false;
    }
    if (tokens < 3) fault(lines_->line(), "a vertex needs three numbers");
    if (tokens > 5) add(vertex_colours_);
    return tokens >= 3;
  }

  // The library's numbers wrap round at 2^32; nobody has a vertex of ten digits.
  bool checkFace(std::string_view rest) {
    std::size_t digits = 0;
    for (const char c : rest) {
      digits = c >= '0' && c <= '9' ? digits + 1 : 0;
      if (digits > 9) fault(lines_->line(), "an index of more than nine digits");
    }
    return !error_;
  }

  void vertex(const Eigen::Vector3d& p) {
    if (!p.allFinite()) return fault(lines_->line(), "a coordinate is not a finite number");
    vertices.push_back(p);
  }

  void face(const tinyobj::index_t* corner, std::size_t count) {
    const std::size_t begin = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t raw = corner[i].vertex_index;
      const std::int64_t index = raw > 0 ? raw - 1 : static_cast<std::int64_t>(vertices.size()) + raw;
      if (raw == 0) return fault(lines_->line(), "corner " + std::to_string(i + 1) + " of the face has no vertex number, or 0; they begin at 1");
      if (index < 0) return fault(lines_->line(), "refers to vertex " + std::to_string(raw) + ", only " + std::to_string(vertices.size()) + " precede it");
      if (static_cast<std::size_t>(index) + 1 > largest_index_) {
        largest_index_ = static_cast<std::size_t>(index) + 1;
        largest_index_line_ = lines_->line();
      }
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (count < 3) {
      corners.resize(begin);
      return add(short_faces_);
    }
    faces.push_back({begin, static_cast<std::uint32_t>(count), product(), surface(), static_cast<std::uint32_t>(lines_->line())});
  }

  // A product is an object, a group, or a group within an object; a name that comes back continues its product.
  std::uint32_t product() {
    if (!changed_ && !products.empty()) return current_product_;
    changed_ = false;
    const auto [known, is_new] = product_of_.try_emplace({object_, group_}, static_cast<std::uint32_t>(products.size()));
    current_product_ = known->second;
    if (!is_new) return current_product_;
    Product p;
    p.id = object_.empty() ? "g " + group_ : "o " + object_ + (group_.empty() ? "" : " g " + group_);
    p.name = !object_.empty() && !group_.empty() && object_ != group_ ? object_ + " " + group_ : (object_.empty() ? group_ : object_);
    if (p.name.empty()) p.name = path_.stem().string(), p.id = "o";
    products.push_back(std::move(p));
    return current_product_;
  }

  std::uint32_t surface() {
    if (current_surface_ < 0) useMaterial({});
    return static_cast<std::uint32_t>(current_surface_);
  }

  void useMaterial(std::string_view name) {
    const auto [known, is_new] = surface_of_.try_emplace(std::string(name), static_cast<std::uint32_t>(surfaces.size()));
    current_surface_ = known->second;
    if (!is_new) return;
    surfaces.push_back({std::string(name), {}, name.empty() ? "no usemtl" : "usemtl " + std::string(name), {}, {}});
    first_use_.push_back(lines_->line());
  }

  // A name may hold spaces, and a statement may hold several names: the whole comes first.
  void loadMaterials(std::string_view names) {
    const std::string whole(names);
    if (loadMaterialFile(whole)) return;
    for (const auto& name : words(names))
      if (name == whole || !loadMaterialFile(name))
        report.warn("line " + std::to_string(lines_->line()), "material file '" + name + "' is missing; its materials keep their names only");
  }

  bool loadMaterialFile(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const auto file = path_.parent_path() / name;
    std::error_code code;
    if (name.empty() || !std::filesystem::is_regular_file(file, code)) return false;
    std::ifstream stream(file, std::ios::binary);
    std::map<std::string, int> index;
    std::vector<tinyobj::material_t> loaded;
    std::string warnings, errors;
    tinyobj::LoadMtl(&index, &loaded, &stream, &warnings, &errors);
    for (auto& m : loaded) materials_.try_emplace(m.name, std::move(m));
    return true;
  }

  void finish() {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      auto& s = surfaces[i];
      const auto found = materials_.find(s.name);
      if (found != materials_.end()) describe(found->second, s);
      else if (!s.name.empty())
        report.warn("line " + std::to_string(first_use_[i]), "material '" + s.name + "' is not defined; only its name is known");
    }
    for (const Tally* tally : {&points_, &polylines_, &free_form_, &short_faces_, &vertex_colours_})
      if (tally->count > 0) report.lose("line " + std::to_string(tally->first_line), std::to_string(tally->count) + " " + tally->what);
  }

  void describe(const tinyobj::material_t& m, Surface& s) {
    const auto unit = [](double v) { return std::isfinite(v) ? static_cast<float>(std::clamp(v, 0.0, 1.0)) : 1.0F; };
    s.colour = {unit(m.diffuse[0]), unit(m.diffuse[1]), unit(m.diffuse[2]), unit(m.dissolve)};
    s.source = "newmtl " + m.name;
    if (m.metallic > 0) s.metallic = unit(m.metallic);
    if (m.roughness > 0) s.roughness = unit(m.roughness);
    if (!m.diffuse_texname.empty())
      report.lose(s.source, "has a colour texture, which is not read; its diffuse colour stands for it");
  }

  std::filesystem::path path_;
  Progress& progress_;
  ObjLines* lines_ = nullptr;
  std::optional<Error> error_;
  std::size_t statements_ = 0, largest_index_ = 0, largest_index_line_ = 0;
  std::string object_, group_;
  bool changed_ = true;
  std::map<std::pair<std::string, std::string>, std::uint32_t> product_of_;
  std::uint32_t current_product_ = 0;
  std::map<std::string, std::uint32_t> surface_of_;
  std::int64_t current_surface_ = -1;
  std::vector<std::size_t> first_use_;
  std::map<std::string, tinyobj::material_t> materials_;
  Tally points_{"point statement(s) are not a surface"}, polylines_{"line statement(s) are not a surface"},
      free_form_{"free-form curve or surface statement(s) are not read"},
      short_faces_{"face(s) have fewer than three corners"}, vertex_colours_{"vertices have a colour, which is not read"};
};

// Puts the faces of each product into a mesh of its own.
class ObjModel {
 public:
  ObjModel(ObjReader& obj, const ImportOptions& options) : obj_(obj), options_(options) {}

  Result<ImportedModel> build(Progress& progress) {
    toMetresZUp();
    Bounds box;
    for (const auto index : obj_.corners) box.extend(obj_.vertices[index]);
    model_.georeference.shift_m = chooseShift(options_, box);
    std::stable_sort(obj_.faces.begin(), obj_.faces.end(), [](const Face& a, const Face& b) { return a.product < b.product; });
    mesh_index_.assign(obj_.vertices.size(), kUnused);
    for (std::size_t from = 0, to = 0; from < obj_.faces.size(); from = to) {
      while (to < obj_.faces.size() && obj_.faces[to].product == obj_.faces[from].product) ++to;
      addProduct(std::span(obj_.faces).subspan(from, to - from));
      if (auto ok = progress.check(); !ok) return failure(ok.error());
      progress.advance(0.8 + 0.2 * static_cast<double>(to) / static_cast<double>(obj_.faces.size()));
    }
    model_.environment.surfaces = std::move(obj_.surfaces);
    model_.environment.products = std::move(obj_.products);
    if (unclean_ > 0)
      obj_.report.warn("line " + std::to_string(first_unclean_), std::to_string(unclean_) +
                       " polygon(s) cross themselves or have no area; a fan of triangles stands for each");
    if (obj_.faces.empty()) obj_.report.warn("", "no faces: there is nothing to scan");
    model_.report = std::move(obj_.report);
    return std::move(model_);
  }

 private:
  static constexpr std::uint32_t kUnused = 0xFFFFFFFFU;

  void toMetresZUp() {
    const double scale = options_.metres_per_unit > 0 ? options_.metres_per_unit : 1;
    for (auto& p : obj_.vertices) {
      if (options_.up != UpAxis::z) p = {p.x(), -p.z(), p.y()};
      p *= scale;
    }
  }

  void addProduct(std::span<const Face> faces) {
    Bounds box;
    for (const auto& f : faces)
      for (const auto index : cornersOf(f)) box.extend(obj_.vertices[index]);
    const Eigen::Vector3d shift = model_.georeference.shift_m;
    const double reach = std::max((box.min - shift).cwiseAbs().maxCoeff(), (box.max - shift).cwiseAbs().maxCoeff());
    const Eigen::Vector3d origin = reach < kFarFromOrigin_m ? shift : Eigen::Vector3d((0.5 * (box.min + box.max)).array().round());
    Mesh mesh;
    for (const auto& f : faces) addFace(f, origin, mesh);
    auto& product = obj_.products[faces.front().product];
    for (const auto s : std::set<std::uint32_t>(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end()))
      product.materials.push_back(obj_.surfaces[s].name);
    for (const auto index : touched_) mesh_index_[index] = kUnused;
    touched_.clear();
    sortBySurface(mesh);
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(model_.environment.meshes.size());
    instance.product = faces.front().product;
    instance.world_from_mesh.translation() = origin - shift;
    model_.environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    model_.environment.instances.push_back(instance);
  }

  std::span<const std::uint32_t> cornersOf(const Face& f) const { return std::span(obj_.corners).subspan(f.begin, f.corners); }

  void addFace(const Face& f, const Eigen::Vector3d& origin, Mesh& mesh) {
    polygon_.clear();
    for (const auto index : cornersOf(f)) {
      polygon_.push_back(obj_.vertices[index]);
      if (mesh_index_[index] != kUnused) continue;
      mesh_index_[index] = static_cast<std::uint32_t>(mesh.positions.size());
      touched_.push_back(index);
      mesh.positions.push_back((obj_.vertices[index] - origin).cast<float>());
    }
    const auto cut = triangulatePolygon(polygon_);
    if (!cut.clean && unclean_++ == 0) first_unclean_ = f.line;
    const auto corner = cornersOf(f);
    for (const auto& t : cut.triangles) {
      mesh.triangles.push_back({mesh_index_[corner[t[0]]], mesh_index_[corner[t[1]]], mesh_index_[corner[t[2]]]});
      mesh.surface_of_triangle.push_back(f.surface);
    }
  }

  ObjReader& obj_;
  const ImportOptions& options_;
  ImportedModel model_;
  std::vector<std::uint32_t> mesh_index_, touched_;   // vertex of the file → of the product's mesh
  std::vector<Eigen::Vector3d> polygon_;
  std::size_t unclean_ = 0, first_unclean_ = 0;
};

Result<ImportedModel> readObj(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading OBJ");
  try {
    ObjReader reader(path, progress);
    if (auto ok = reader.read(); !ok) return failure(ok.error());
    auto model = ObjModel(reader, options).build(progress);
    if (model)
      if (auto wrong = validate(model->environment); !wrong.empty())
        return failure(ErrorKind::unusable, wrong, path.filename().string());
    return model;
  } catch (const std::exception& e) {   // tinyobjloader allocates without asking
    return failure(ErrorKind::unusable, e.what(), path.filename().string());
  }
}

constexpr const char* kExtensions[] = {".obj"};

}  // namespace

const Importer kObjImporter = {"obj", "Wavefront OBJ with MTL", kExtensions, &readObj};

}  // namespace standpoint

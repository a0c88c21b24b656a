// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/obj_materials.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "importers/files/file_bytes.h"
#include "importers/files/model_folder.h"
#include "importers/obj/mtl.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxLibraryBytes = 64U << 20U;

// Split at spaces, but not at "\ ".
std::vector<std::string> fileNames(const std::string& text) {
  std::vector<std::string> result(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped = text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ';
    if (escaped)
      result.back() += text[++i];
    else if (text[i] != ' ')
      result.back() += text[i];
    else if (!result.back().empty())
      result.emplace_back();
  }
  if (result.back().empty()) result.pop_back();
  return result;
}

class Materials {
 public:
  Materials(const fs::path& obj, FaceSoup& soup, Report& report)
      : obj_(obj), folder_(obj), soup_(soup), report_(report) {}

  // A name may hold spaces, and a statement may hold several names: the whole comes first.
  void load(const ObjGroups::Library& library) {
    const std::string place = "line " + std::to_string(library.line);
    const auto names = fileNames(library.names);
    if (names.empty()) return report_.warn(place, "mtllib does not name a file");
    if (names.size() > 1)
      if (const auto whole = folder_.find(library.names, folder_.root()); whole)
        return loadFile(library.names, *whole, place);
    for (const auto& name : names) {
      if (!asked_.insert(name).second) continue;
      if (const auto found = folder_.find(name, folder_.root()); found)
        loadFile(name, *found, place);
      else if (!loadNamesake(name, found.error().message, place))
        report_.warn(place, "material file '" + name + "' " + found.error().message +
                                "; only the names of its materials are known");
    }
  }

  void apply(const std::vector<std::size_t>& first_use) {
    for (std::size_t i = 0; i < soup_.surfaces.size(); ++i) {
      auto& s = soup_.surfaces[i];
      const auto found = known_.find(s.name);
      if (found != known_.end())
        describe(*found->second, static_cast<std::uint32_t>(i));
      else if (!s.name.empty())
        report_.warn("line " + std::to_string(first_use[i]),
                     "material '" + s.name + "' is not defined; only its name is known");
    }
    for (const auto& [key, tally] : unread_maps_)
      report_.note(tally.second, key + " is not supported; materials that have one: " + std::to_string(tally.first));
    soup_.images = std::move(images_).images();
  }

 private:
  struct Material {
    MtlMaterial mtl;
    fs::path folder;
  };

  void loadFile(const std::string& name, const ModelFolder::Found& found, const std::string& place) {
    if (!read_.insert(found.file).second) return;
    const auto bytes = FileBytes::open(found.file);
    const auto text = bytes ? bytes->all(kMaxLibraryBytes) : Result<std::string>(failure(bytes.error()));
    if (!text) return report_.warn(place, "material file '" + name + "': " + text.error().message);
    if (!found.as_named)
      report_.note(place, "material file '" + name + "' is taken from " + found.file.filename().string());
    for (auto& m : parseMtl(*text, found.file.filename().string(), report_)) {
      const auto key = m.surface.name;
      known_.try_emplace(key, std::make_unique<Material>(Material{std::move(m), found.file.parent_path()}));
    }
  }

  // An OBJ is often renamed together with its MTL, and then names the old one.
  bool loadNamesake(const std::string& name, const std::string& why, const std::string& place) {
    const auto found = folder_.find(obj_.stem().string() + ".mtl", folder_.root());
    if (!found || read_.contains(found->file)) return false;
    report_.warn(place,
                 "material file '" + name + "' " + why + "; " + found->file.filename().string() + " is used instead");
    loadFile(name, {found->file, true}, place);
    return true;
  }

  void describe(const Material& material, std::uint32_t index) {
    auto& s = soup_.surfaces[index];
    const auto& m = material.mtl;
    s = m.surface;
    if (!m.texture.empty()) {
      s.image = image(m.texture, material.folder, s.source);
      if (s.image >= 0 && (m.texture_scale != Eigen::Vector2f(1, 1) || m.texture_offset != Eigen::Vector2f(0, 0)))
        moveTexture(index, m.texture_scale, m.texture_offset);
    }
    if (!m.cutout.empty() && m.cutout != m.texture)
      report_.lose(s.source, "has a map_d '" + m.cutout + "', which is not supported: cutouts are not applied");
    for (const auto& [key, file] : m.other_maps)
      if (auto& tally = unread_maps_[key]; tally.first++ == 0) tally.second = s.source;
  }

  std::int32_t image(const std::string& name, const fs::path& base, const std::string& place) {
    const auto found = folder_.find(name, base);
    const auto index = found ? images_.add(found->file) : Result<std::int32_t>(failure(found.error()));
    if (!index) {
      report_.lose(place,
                   "colour texture '" + name + "' " + index.error().message + "; using the diffuse colour instead");
      return -1;
    }
    if (!found->as_named)
      report_.note(place, "colour texture '" + name + "' is taken from " + found->file.filename().string());
    return *index;
  }

  void moveTexture(std::uint32_t surface, const Eigen::Vector2f& scale, const Eigen::Vector2f& offset) {
    std::unordered_map<std::uint32_t, std::uint32_t> moved;  // looked up only, never walked
    for (const auto& run : soup_.runs) {
      if (run.surface != surface || soup_.texture_corners.empty()) continue;
      for (auto c = soup_.beginOf(run.begin); c < soup_.beginOf(run.end); ++c) {
        auto& corner = soup_.texture_corners[c];
        if (corner == kNoTextureCorner) continue;
        const auto [known, is_new] =
            moved.try_emplace(corner, static_cast<std::uint32_t>(soup_.texture_coordinates.size()));
        if (is_new) {
          const Eigen::Vector2f uv = soup_.texture_coordinates[corner];
          const Eigen::Vector2f from_bottom(scale.x() * uv.x() + offset.x(), scale.y() * (1 - uv.y()) + offset.y());
          const Eigen::Vector2f from_top(from_bottom.x(), 1 - from_bottom.y());
          soup_.texture_coordinates.push_back(from_top.allFinite() ? from_top : uv);
        }
        corner = known->second;
      }
    }
  }

  const fs::path& obj_;
  ModelFolder folder_;
  FaceSoup& soup_;
  Report& report_;
  ImageFiles images_;
  std::set<std::string> asked_;
  std::set<fs::path> read_;
  std::map<std::string, std::unique_ptr<Material>> known_;
  std::map<std::string, std::pair<std::size_t, std::string>> unread_maps_;
};

}  // namespace

void applyMaterials(const fs::path& obj, const ObjGroups& groups, FaceSoup& soup, Report& report) {
  Materials materials(obj, soup, report);
  for (const auto& library : groups.libraries) materials.load(library);
  materials.apply(groups.first_use);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace standpoint {

namespace {

enum : std::size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

const char* modeName(std::size_t mode) {
  constexpr const char* kNames[] = {"points", "lines", "a line loop", "a line strip"};
  return mode < 4 ? kNames[mode] : "an unknown mode";
}

// glTF 2.0 §3.7.2.1: strip triangle i is (i, i + 1 + i mod 2, i + 2 − i mod 2), fan triangle (i + 1, i + 2, 0).
std::vector<Triangle> trianglesOf(std::size_t mode, const std::vector<std::uint32_t>& order) {
  std::vector<Triangle> out;
  const std::size_t n = order.size();
  if (mode == kTriangles)
    for (std::size_t i = 0; i + 3 <= n; i += 3) out.push_back({order[i], order[i + 1], order[i + 2]});
  if (mode == kStrip)
    for (std::size_t i = 0; i + 3 <= n; ++i) out.push_back({order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
  if (mode == kFan)
    for (std::size_t i = 0; i + 3 <= n; ++i) out.push_back({order[i + 1], order[i + 2], order[0]});
  return out;
}

class MeshReader {
 public:
  MeshReader(GltfFile& file, std::uint32_t no_material, Report& report)
      : file_(file), no_material_(no_material), report_(report) {}

  void primitive(const nlohmann::json& json, const std::string& place) {
    const auto mode = file_.natural(json, "mode", kTriangles, place);
    const auto material = file_.index(json, "material", place);
    const auto position = file_.index(memberOf(json, "attributes"), "POSITION", place + "/attributes");
    if (material && *material >= file_.count("materials")) file_.fail(place + "/material", "does not exist");
    if (mode > kFan) file_.fail(place + "/mode", "is " + std::to_string(mode) + ", known are 0 to 6");
    if (file_.failed()) return;
    if (!position) {
      // The specification lets a client skip such a primitive; a surface without a place cannot be scanned.
      file_.fail(place + "/attributes", "has no POSITION: there is nothing to scan");
      return;
    }
    if (mode < kTriangles) return report_.lose(place, std::string("holds ") + modeName(mode) + ", which are not a surface");
    const auto surface = material ? static_cast<std::uint32_t>(*material) : no_material_;
    const auto& draco = memberOf(memberOf(json, "extensions"), "KHR_draco_mesh_compression");
    if (draco.is_object()) {
      compressed(draco, surface, place + "/extensions/KHR_draco_mesh_compression");
    } else {
      plain(json, *position, mode, surface, place);
    }
    if (memberOf(json, "targets").is_array() && !memberOf(json, "targets").empty()) has_targets_ = true;
  }

  Mesh take() {
    sortBySurface(mesh_);
    return std::move(mesh_);
  }
  bool hasTargets() const { return has_targets_; }

 private:
  void plain(const nlohmann::json& json, std::size_t position, std::size_t mode, std::uint32_t surface, const std::string& place) {
    const std::size_t base = baseOf(position, place + "/attributes/POSITION");
    if (file_.failed()) return;
    const std::size_t size = size_of_[position];
    std::vector<std::uint32_t> order;
    if (const auto indices = file_.index(json, "indices", place)) {
      order = file_.indices(*indices, place + "/indices");
    } else if (file_.spend(size * 16, place)) {
      order.resize(size);
      for (std::size_t i = 0; i < size; ++i) order[i] = static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < order.size(); ++i)
      if (order[i] >= size)
        return file_.fail(place + "/indices", "index " + std::to_string(i) + " is " + std::to_string(order[i]) +
                                                  ", there are " + std::to_string(size) + " vertices");
    if (file_.failed()) return;
    if (mode == kTriangles && order.size() % 3 != 0)
      report_.warn(place, std::to_string(order.size()) + " indices are not a multiple of 3; the rest is left out");
    append(trianglesOf(mode, order), base, surface);
  }

  void compressed(const nlohmann::json& extension, std::uint32_t surface, const std::string& place) {
    const auto decoded = decodeDraco(file_, extension, place);
    if (file_.failed()) return;
    const std::size_t base = mesh_.positions.size();
    mesh_.positions.insert(mesh_.positions.end(), decoded.positions.begin(), decoded.positions.end());
    append(decoded.triangles, base, surface);
  }

  std::size_t baseOf(std::size_t accessor, const std::string& place) {
    if (const auto known = base_of_.find(accessor); known != base_of_.end()) return known->second;
    const auto positions = file_.vectors3(accessor, place);
    const std::size_t base = mesh_.positions.size();
    mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
    base_of_[accessor] = base;
    size_of_[accessor] = positions.size();
    return base;
  }

  void append(const std::vector<Triangle>& triangles, std::size_t base, std::uint32_t surface) {
    const auto offset = static_cast<std::uint32_t>(base);
    for (const auto& t : triangles) mesh_.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    mesh_.surface_of_triangle.resize(mesh_.triangles.size(), surface);
  }

  GltfFile& file_;
  std::uint32_t no_material_;
  Report& report_;
  Mesh mesh_;
  std::map<std::size_t, std::size_t> base_of_, size_of_;
  bool has_targets_ = false;
};

bool anyNonZero(const nlohmann::json& weights) {
  return weights.is_array() && std::any_of(weights.begin(), weights.end(), [](const auto& w) {
           return w.is_number() && w.template get<double>() != 0;
         });
}

float channel(const std::vector<double>& values, std::size_t i) { return values.empty() ? 1.0F : static_cast<float>(values[i]); }

std::optional<float> factor(const nlohmann::json& object, const char* key) {
  const auto& value = memberOf(object, key);
  return value.is_number() ? value.get<float>() : 1.0F;
}

// What our own writer put into `extras`, so that a surface survives bit for bit.
void restoreSurface(GltfFile& file, const nlohmann::json& extras, const std::string& place, Surface& surface) {
  if (!extras.is_object()) return;
  const auto srgb = file.numbers(extras, "srgb", 4, place);
  if (!srgb.empty())
    surface.colour = {static_cast<float>(srgb[0]), static_cast<float>(srgb[1]), static_cast<float>(srgb[2]),
                      static_cast<float>(srgb[3])};
  const auto optional = [&](const char* key) {
    const auto& value = memberOf(extras, key);
    return value.is_number() ? std::optional<float>(value.get<float>()) : std::nullopt;
  };
  surface.source = file.text(extras, "source");
  surface.metallic = optional("metallic");
  surface.roughness = optional("roughness");
}

}  // namespace

float srgbFromLinear(float linear) {
  const double x = std::clamp<double>(linear, 0, 1);
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

float linearFromSrgb(float srgb) {
  const double x = std::clamp<double>(srgb, 0, 1);
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

std::vector<Surface> readGltfSurfaces(GltfFile& file, Report& report) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; !file.failed() && i < file.count("materials"); ++i) {
    const std::string place = "/materials/" + std::to_string(i);
    const auto& json = file.element("materials", i, place);
    const auto& pbr = memberOf(json, "pbrMetallicRoughness");
    Surface surface;
    surface.name = file.text(json, "name");
    surface.source = place;
    auto base = file.numbers(pbr, "baseColorFactor", 4, place + "/pbrMetallicRoughness");
    const auto& gloss = memberOf(memberOf(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    if (gloss.is_object()) base = file.numbers(gloss, "diffuseFactor", 4, place + "/extensions/KHR_materials_pbrSpecularGlossiness");
    if (file.failed()) break;
    const auto& mode = memberOf(json, "alphaMode");
    surface.colour = {srgbFromLinear(channel(base, 0)), srgbFromLinear(channel(base, 1)), srgbFromLinear(channel(base, 2)),
                      mode.is_string() && mode != "OPAQUE" ? channel(base, 3) : 1.0F};
    if (pbr.is_object()) {
      surface.metallic = factor(pbr, "metallicFactor");
      surface.roughness = factor(pbr, "roughnessFactor");
    }
    if (memberOf(pbr, "baseColorTexture").is_object() || memberOf(gloss, "diffuseTexture").is_object())
      report.lose(place, "has a base colour texture, which is not read; its colour factor stands for it");
    restoreSurface(file, memberOf(memberOf(json, "extras"), "standpoint"), place + "/extras/standpoint", surface);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

Mesh readGltfMesh(GltfFile& file, std::size_t index, std::uint32_t no_material, Report& report) {
  const std::string place = "/meshes/" + std::to_string(index);
  const auto& json = file.element("meshes", index, place);
  const auto& primitives = memberOf(json, "primitives");
  if (!primitives.is_array()) file.fail(place + "/primitives", "is not an array");
  MeshReader reader(file, no_material, report);
  for (std::size_t i = 0; !file.failed() && i < primitives.size(); ++i)
    reader.primitive(primitives[i], place + "/primitives/" + std::to_string(i));
  if (reader.hasTargets() && anyNonZero(memberOf(json, "weights")))
    report.lose(place + "/weights", "morph targets are not applied");
  return reader.take();
}

}  // namespace standpoint

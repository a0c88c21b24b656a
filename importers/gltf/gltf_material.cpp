// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "importers/gltf/gltf_physical_material.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

// Material extensions of which a surface keeps the factors; of any other the name is reported.
constexpr std::array<std::string_view, 9> kKept = {kGltfPhysicalMaterial,
                                                   "KHR_materials_transmission",
                                                   "KHR_materials_ior",
                                                   "KHR_materials_volume",
                                                   "KHR_materials_clearcoat",
                                                   "KHR_materials_unlit",
                                                   "KHR_materials_pbrSpecularGlossiness",
                                                   "KHR_materials_specular",
                                                   "KHR_materials_emissive_strength"};

float bounded(double value) { return static_cast<float>(std::clamp(value, -1e30, 1e30)); }

float floatOr(const Json& object, const char* key, double fallback) {
  const auto& value = memberOf(object, key);
  return bounded(value.is_number() ? value.get<double>() : fallback);
}

std::optional<float> floatIn(const Json& object, const char* key) {
  return memberOf(object, key).is_number() ? std::optional(floatOr(object, key, 0)) : std::nullopt;
}

// What surfaces do not keep, counted by kind in alphabetical order.
class NotKept {
 public:
  void add(const std::string& what, const std::string& place) {
    auto& entry = kinds_[what];
    if (entry.count++ == 0) entry.first = place;
  }
  void report(Report& report) const {
    for (const auto& [what, entry] : kinds_)
      report.note(entry.first, entry.count == 1 ? what + " is not supported"
                                                : what + " is not supported, here and in " +
                                                      std::to_string(entry.count - 1) + " more materials");
  }

 private:
  struct Entry {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::string, Entry> kinds_;
};

class MaterialReader {
 public:
  MaterialReader(GltfFile& file, Report& report) : file_(file), report_(report), images_(file, report) {}

  GltfMaterials read() {
    readOurImages();
    const auto& materials = file_.model().materials;
    for (std::size_t i = 0; !file_.failed() && i < materials.size(); ++i) {
      place_ = "/materials/" + std::to_string(i);
      material(materials[i]);
    }
    if (!ours_) result_.images = images_.take();
    not_kept_.report(report_);
    return std::move(result_);
  }

 private:
  void material(const tinygltf::Material& gltf) {
    const auto extras = gltfExtras(gltf);
    const auto extensions = gltfExtensions(gltf);
    const auto& stored = memberOf(extras, "standpoint");
    const auto plain_of = file_.index(stored, "plain_of", place_ + "/extras/standpoint");
    if (plain_of && *plain_of < result_.surfaces.size() && ours_) return add(static_cast<std::uint32_t>(*plain_of), {});

    Surface surface;
    surface.name = gltf.name;
    surface.source = place_;
    GltfTextureUse use;
    use.vertex_alpha = gltf.alphaMode == "BLEND";
    const auto& gloss = memberOf(extensions, "KHR_materials_pbrSpecularGlossiness");
    if (gloss.is_object())
      glossyBase(gltf, gloss, surface, use);
    else
      base(gltf, surface, use);
    optics(extensions, surface);
    restore(gltf, stored, surface);
    listWhatIsNotKept(gltf, extensions);
    result_.surfaces.push_back(std::move(surface));
    add(static_cast<std::uint32_t>(result_.surfaces.size() - 1), use);
  }

  void add(std::uint32_t surface, const GltfTextureUse& use) {
    result_.surface_of_material.push_back(surface);
    result_.texture_of_material.push_back(use);
  }

  void base(const tinygltf::Material& gltf, Surface& surface, GltfTextureUse& use) {
    const auto& pbr = gltf.pbrMetallicRoughness;
    if (!gltf.values.empty()) {  // else the file does not say
      surface.metallic = bounded(pbr.metallicFactor);
      surface.roughness = bounded(pbr.roughnessFactor);
    }
    colour(gltf, pbr.baseColorFactor, surface);
    if (pbr.baseColorTexture.index < 0) return;
    use.set = static_cast<std::size_t>(pbr.baseColorTexture.texCoord);
    image(static_cast<std::size_t>(pbr.baseColorTexture.index), gltfExtensions(pbr.baseColorTexture),
          place_ + "/pbrMetallicRoughness/baseColorTexture", surface, use);
  }

  void glossyBase(const tinygltf::Material& gltf, const Json& gloss, Surface& surface, GltfTextureUse& use) {
    const std::string where = place_ + "/extensions/KHR_materials_pbrSpecularGlossiness";
    auto diffuse = file_.numbers(gloss, "diffuseFactor", 4, where);
    if (diffuse.empty()) diffuse.assign(4, 1.0);
    surface.roughness = 1 - floatOr(gloss, "glossinessFactor", 1);
    colour(gltf, diffuse, surface);
    const auto& texture = memberOf(gloss, "diffuseTexture");
    if (!texture.is_object()) return;
    const auto index = file_.index(texture, "index", where + "/diffuseTexture");
    if (file_.failed()) return;
    if (!index) return file_.fail(where + "/diffuseTexture", "has no texture index");
    use.set = file_.natural(texture, "texCoord", 0, where + "/diffuseTexture");
    image(*index, memberOf(texture, "extensions"), where + "/diffuseTexture", surface, use);
  }

  void colour(const tinygltf::Material& gltf, const std::vector<double>& factor, Surface& surface) {
    const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(factor[i], 0.0, 1.0)); };
    surface.colour = {srgbFromLinear(channel(0)), srgbFromLinear(channel(1)), srgbFromLinear(channel(2)),
                      alpha(gltf, channel(3))};
  }

  // glTF 2.0 §3.9.4: an opaque material's alpha is ignored, a masked one is there or not.
  float alpha(const tinygltf::Material& gltf, float factor) {
    if (gltf.alphaMode == "BLEND") return factor;
    if (gltf.alphaMode != "MASK") return 1;
    if (gltf.pbrMetallicRoughness.baseColorTexture.index >= 0)
      report_.warn(place_ + "/alphaMode", "alpha-mask cutouts are not applied: beams hit the whole face");
    return factor >= bounded(gltf.alphaCutoff) ? 1.0F : 0.0F;
  }

  void image(std::size_t texture, const Json& extensions, const std::string& where, Surface& surface,
             GltfTextureUse& use) {
    const auto& transform = memberOf(extensions, "KHR_texture_transform");
    if (transform.is_object()) use = transformed(transform, where + "/extensions/KHR_texture_transform", use);
    if (ours_) return;  // its image is in what we stored
    surface.image = images_.ofTexture(texture, place_);
    if (surface.image >= 0) wrapping(texture);
  }

  // The specification's example tells which way a positive angle turns: the lower left quarter, turned by 90°, is
  // offset (0, 1), rotation π/2, scale ½.
  GltfTextureUse transformed(const Json& json, const std::string& where, GltfTextureUse use) {
    use.set = file_.natural(json, "texCoord", use.set, where);
    const auto offset = file_.numbers(json, "offset", 2, where), scale = file_.numbers(json, "scale", 2, where);
    const auto& angle = memberOf(json, "rotation");
    const double a = angle.is_number() ? angle.get<double>() : 0;
    Eigen::Matrix2d turn;
    turn << std::cos(a), std::sin(a), -std::sin(a), std::cos(a);
    if (!scale.empty()) turn = turn * Eigen::Vector2d(scale[0], scale[1]).asDiagonal();
    use.image_from_set.linear() = turn;
    if (!offset.empty()) use.image_from_set.translation() = Eigen::Vector2d(offset[0], offset[1]);
    return use;
  }

  void wrapping(std::size_t texture) {
    const auto& model = file_.model();
    const auto sampler = gltfIndex(model.textures[texture].sampler);
    if (!sampler) return;
    const auto& gltf =
        file_.element(model.samplers, "samplers", *sampler, "/textures/" + std::to_string(texture) + "/sampler");
    if (gltf.wrapS != TINYGLTF_TEXTURE_WRAP_REPEAT || gltf.wrapT != TINYGLTF_TEXTURE_WRAP_REPEAT)
      not_kept_.add("the texture wrap mode (/samplers/" + std::to_string(*sampler) + ")", place_);
  }

  void optics(const Json& extensions, Surface& surface) {
    const auto& transmission = memberOf(extensions, "KHR_materials_transmission");
    if (transmission.is_object()) surface.transmission = floatOr(transmission, "transmissionFactor", 0);
    const auto& ior = memberOf(extensions, "KHR_materials_ior");
    if (ior.is_object()) surface.index_of_refraction = floatOr(ior, "ior", 1.5);
    const auto& volume = memberOf(extensions, "KHR_materials_volume");
    if (volume.is_object() && floatOr(volume, "thicknessFactor", 0) > 0)
      surface.thickness_m = floatOr(volume, "thicknessFactor", 0);
    const auto& coat = memberOf(extensions, "KHR_materials_clearcoat");
    if (coat.is_object()) surface.clearcoat = floatOr(coat, "clearcoatFactor", 0);
    const auto& specular = memberOf(extensions, "KHR_materials_specular");
    if (specular.is_object()) surface.specular = floatOr(specular, "specularFactor", 1);
    surface.unlit = memberOf(extensions, "KHR_materials_unlit").is_object();
    surface.physical_material = file_.text(memberOf(extensions, kGltfPhysicalMaterial), "id");
  }

  void listWhatIsNotKept(const tinygltf::Material& gltf, const Json& extensions) {
    const std::pair<const char*, int> others[] = {
        {"normalTexture", gltf.normalTexture.index},
        {"occlusionTexture", gltf.occlusionTexture.index},
        {"emissiveTexture", gltf.emissiveTexture.index},
        {"metallicRoughnessTexture", gltf.pbrMetallicRoughness.metallicRoughnessTexture.index}};
    for (const auto& [name, index] : others)
      if (index >= 0) not_kept_.add(name, place_);
    const auto& light = gltf.emissiveFactor;
    if (std::any_of(light.begin(), light.end(), [](double c) { return c > 0; }))
      not_kept_.add("its emitted light", place_);
    if (!extensions.is_object()) return;
    for (const auto& [name, extension] : extensions.items()) {
      if (std::find(kKept.begin(), kKept.end(), name) == kKept.end())
        not_kept_.add(name, place_);
      else
        textures(extension, name + " ");
    }
  }

  void textures(const Json& object, const std::string& prefix) {
    if (!object.is_object()) return;
    for (const auto& [key, value] : object.items())
      if (key.ends_with("Texture") && key != "diffuseTexture" && value.is_object()) not_kept_.add(prefix + key, place_);
  }

  // Every image of a file of ours, also those that no surface shows or that are neither PNG nor JPEG.
  void readOurImages() {
    const auto extras = gltfExtras(file_.model().asset);
    const auto& list = memberOf(memberOf(extras, "standpoint"), "images");
    ours_ = list.is_array();
    for (std::size_t i = 0; ours_ && i < list.size() && !file_.failed(); ++i) {
      const std::string where = "/asset/extras/standpoint/images/" + std::to_string(i);
      Image image{file_.text(list[i], "name"), file_.text(list[i], "media_type"), {}};
      if (const auto buffer_view = file_.index(list[i], "bufferView", where)) {
        const auto bytes = std::as_bytes(file_.view(*buffer_view, where));
        if (file_.spend(bytes.size(), where)) image.bytes.assign(bytes.begin(), bytes.end());
      }
      result_.images.push_back(std::make_shared<const Image>(std::move(image)));
    }
  }

  // What our writer put into `extras`, so that a surface survives bit for bit; not if another program has changed the
  // colour since.
  void restore(const tinygltf::Material& gltf, const Json& stored, Surface& surface) {
    const auto srgb = file_.numbers(stored, "srgb", 4, place_ + "/extras/standpoint");
    if (srgb.empty()) return;
    const Colour colour{static_cast<float>(srgb[0]), static_cast<float>(srgb[1]), static_cast<float>(srgb[2]),
                        static_cast<float>(srgb[3])};
    const auto& now = gltf.pbrMetallicRoughness.baseColorFactor;
    const auto same = [&](std::size_t i, float channel) { return std::abs(now[i] - linearFromSrgb(channel)) < 1e-4; };
    if (!same(0, colour.r) || !same(1, colour.g) || !same(2, colour.b)) return;
    surface.colour = colour;
    surface.source = file_.text(stored, "source");
    for (const auto& figure : kGltfSurfaceFigures) surface.*figure.value = floatIn(stored, figure.key);
    surface.unlit = memberOf(stored, "unlit") == true;
    if (surface.physical_material.empty()) surface.physical_material = file_.text(stored, "physical_material");
    if (const auto image = file_.index(stored, "image", place_ + "/extras/standpoint"); image && ours_) {
      if (*image >= result_.images.size()) return file_.fail(place_ + "/extras/standpoint/image", "does not exist");
      surface.image = static_cast<std::int32_t>(*image);
    }
  }

  GltfFile& file_;
  Report& report_;
  GltfImages images_;
  NotKept not_kept_;
  GltfMaterials result_;
  std::string place_;
  bool ours_ = false;
};

}  // namespace

GltfMaterials readGltfMaterials(GltfFile& file, Report& report) { return MaterialReader(file, report).read(); }

}  // namespace standpoint

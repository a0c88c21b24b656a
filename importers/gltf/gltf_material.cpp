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

float floatOr(const Json& object, const char* key, double fallback) {
  const auto& value = memberOf(object, key);
  return static_cast<float>(std::clamp(value.is_number() ? value.get<double>() : fallback, -1e30, 1e30));
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
      report.note(entry.first,
                  what + " is not kept" +
                      (entry.count > 1 ? ", here and of " + std::to_string(entry.count - 1) + " more materials" : ""));
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
    for (std::size_t i = 0; !file_.failed() && i < file_.count("materials"); ++i) {
      place_ = "/materials/" + std::to_string(i);
      material(file_.element("materials", i, place_));
    }
    if (!ours_) result_.images = images_.take();
    not_kept_.report(report_);
    return std::move(result_);
  }

 private:
  void material(const Json& json) {
    const auto& stored = memberOf(memberOf(json, "extras"), "standpoint");
    const auto plain_of = file_.index(stored, "plain_of", place_ + "/extras/standpoint");
    if (plain_of && *plain_of < result_.surfaces.size() && ours_) return add(static_cast<std::uint32_t>(*plain_of), {});

    Surface surface;
    surface.name = file_.text(json, "name");
    surface.source = place_;
    GltfTextureUse use;
    base(json, surface, use);
    optics(memberOf(json, "extensions"), surface);
    restore(json, stored, surface);
    listWhatIsNotKept(json);
    result_.surfaces.push_back(std::move(surface));
    add(static_cast<std::uint32_t>(result_.surfaces.size() - 1), use);
  }

  void add(std::uint32_t surface, const GltfTextureUse& use) {
    result_.surface_of_material.push_back(surface);
    result_.texture_of_material.push_back(use);
  }

  void base(const Json& json, Surface& surface, GltfTextureUse& use) {
    const auto& pbr = memberOf(json, "pbrMetallicRoughness");
    const auto& gloss = memberOf(memberOf(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    const bool glossy = gloss.is_object();
    const std::string where =
        place_ + (glossy ? "/extensions/KHR_materials_pbrSpecularGlossiness" : "/pbrMetallicRoughness");
    auto colour =
        glossy ? file_.numbers(gloss, "diffuseFactor", 4, where) : file_.numbers(pbr, "baseColorFactor", 4, where);
    if (colour.empty()) colour.assign(4, 1.0);
    if (glossy) {
      surface.roughness = 1 - floatOr(gloss, "glossinessFactor", 1);
    } else if (pbr.is_object()) {
      surface.metallic = floatOr(pbr, "metallicFactor", 1);
      surface.roughness = floatOr(pbr, "roughnessFactor", 1);
    }
    const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(colour[i], 0.0, 1.0)); };
    use.vertex_alpha = file_.text(json, "alphaMode") == "BLEND";
    surface.colour = {srgbFromLinear(channel(0)), srgbFromLinear(channel(1)), srgbFromLinear(channel(2)),
                      alpha(json, channel(3))};
    const auto& texture = glossy ? memberOf(gloss, "diffuseTexture") : memberOf(pbr, "baseColorTexture");
    if (texture.is_object()) image(texture, where + (glossy ? "/diffuseTexture" : "/baseColorTexture"), surface, use);
  }

  // glTF 2.0 §3.9.4: an opaque material's alpha is ignored, a masked one is there or not.
  float alpha(const Json& json, float factor) {
    const std::string mode = file_.text(json, "alphaMode");
    if (mode == "BLEND") return factor;
    if (mode != "MASK") return 1;
    const bool textured = memberOf(memberOf(json, "pbrMetallicRoughness"), "baseColorTexture").is_object();
    if (textured)
      report_.warn(place_ + "/alphaMode", "the holes that its image masks are not cut: a beam meets the whole face");
    return factor >= floatOr(json, "alphaCutoff", 0.5) ? 1.0F : 0.0F;
  }

  void image(const Json& texture, const std::string& where, Surface& surface, GltfTextureUse& use) {
    const auto index = file_.index(texture, "index", where);
    if (file_.failed()) return;
    if (!index) return file_.fail(where, "has no index of a texture");
    use.set = file_.natural(texture, "texCoord", 0, where);
    const auto& transform = memberOf(memberOf(texture, "extensions"), "KHR_texture_transform");
    if (transform.is_object()) use = transformed(transform, where + "/extensions/KHR_texture_transform", use);
    if (ours_) return;  // its image is in what we stored
    surface.image = images_.ofTexture(*index, place_);
    if (surface.image >= 0) wrapping(*index);
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
    const std::string place = "/textures/" + std::to_string(texture);
    const auto sampler = file_.index(file_.element("textures", texture, place), "sampler", place);
    if (!sampler) return;
    constexpr std::size_t kRepeat = 10497;
    const std::string where = "/samplers/" + std::to_string(*sampler);
    const auto& json = file_.element("samplers", *sampler, place + "/sampler");
    if (file_.natural(json, "wrapS", kRepeat, where) != kRepeat ||
        file_.natural(json, "wrapT", kRepeat, where) != kRepeat)
      not_kept_.add("that its image does not repeat beyond its edges (" + where + ")", place_);
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

  void listWhatIsNotKept(const Json& json) {
    textures(json, "");
    textures(memberOf(json, "pbrMetallicRoughness"), "");
    const auto& emissive = memberOf(json, "emissiveFactor");
    if (emissive.is_array() && emissive != Json{0, 0, 0} &&
        std::any_of(emissive.begin(), emissive.end(),
                    [](const Json& c) { return c.is_number() && c.get<double>() > 0; }))
      not_kept_.add("the light that it emits", place_);
    const auto& extensions = memberOf(json, "extensions");
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
      if (key.ends_with("Texture") && key != "baseColorTexture" && key != "diffuseTexture" && value.is_object())
        not_kept_.add(prefix + key, place_);
  }

  // Every image of a file of ours, also those that no surface shows or that are neither PNG nor JPEG.
  void readOurImages() {
    const auto& list = memberOf(memberOf(memberOf(memberOf(file_.json(), "asset"), "extras"), "standpoint"), "images");
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
  void restore(const Json& json, const Json& stored, Surface& surface) {
    const auto srgb = file_.numbers(stored, "srgb", 4, place_ + "/extras/standpoint");
    if (srgb.empty()) return;
    const Colour colour{static_cast<float>(srgb[0]), static_cast<float>(srgb[1]), static_cast<float>(srgb[2]),
                        static_cast<float>(srgb[3])};
    auto now = file_.numbers(memberOf(json, "pbrMetallicRoughness"), "baseColorFactor", 4, place_);
    if (now.empty()) now.assign(4, 1.0);
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

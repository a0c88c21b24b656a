// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "materials/json_file.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

using Spectrum = std::vector<std::pair<double, double>>;

constexpr double kRounding = 1e-9;
constexpr double kHalfPi = 1.5707963267948966;

// Every scalar figure: a key of the file, the field, and the range in which it can mean something.
struct Figure {
  const char* key;
  double PhysicalMaterial::*field;
  double minimum, maximum;
};
constexpr Figure kFigures[] = {
    {"roughness_rad", &PhysicalMaterial::roughness_rad, 0, kHalfPi},
    {"gloss_slope", &PhysicalMaterial::gloss_slope, 0, 1},
    {"index_of_refraction", &PhysicalMaterial::index_of_refraction, 1, 1000},  // metals: effective
    {"thickness_m", &PhysicalMaterial::thickness_m, 1e-5, 1},
};

double normalReflectance(double index) {
  const double amplitude = index > 0 ? (index - 1) / (index + 1) : 0;
  return amplitude * amplitude;
}

Result<Spectrum> readSpectrum(const nlohmann::json& value, const JsonPlace& at) {
  if (!value.is_array() || value.empty()) return at.unusable("must be a list of [wavelength_nm, share]");
  Spectrum result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto here = at / i;
    if (!value[i].is_array() || value[i].size() != 2) return here.unusable("must be [wavelength_nm, share]");
    const auto wavelength = readNumber(value[i][0], here / std::size_t{0}, 200, 20000);
    if (!wavelength) return failure(wavelength.error());
    const auto share = readNumber(value[i][1], here / std::size_t{1}, 0, 1);
    if (!share) return failure(share.error());
    if (!result.empty() && *wavelength <= result.back().first)
      return (here / std::size_t{0}).unusable("wavelengths must rise");
    result.emplace_back(*wavelength, *share);
  }
  return result;
}

Result<void> readSources(const nlohmann::json& entry, const JsonPlace& at, PhysicalMaterial& material) {
  const auto sources = entry.find("source");
  const auto here = at / "source";
  if (sources == entry.end()) return here.unusable("is missing: every figure names where it comes from");
  if (!sources->is_object()) return here.unusable("must be an object with one text for each figure");
  for (const auto& item : sources->items())
    if (item.key() == "id" || item.key() == "label" || item.key() == "source" || !entry.contains(item.key()))
      return (here / item.key()).unusable("is the source of a figure that the entry does not have");
  for (const char* key :
       {"reflectance", "roughness_rad", "gloss_slope", "index_of_refraction", "thickness_m", "transmittance"}) {
    if (!entry.contains(key)) continue;
    auto text = readText(*sources, here, key);
    if (!text) return failure(text.error());
    material.source.push_back(std::string(key) + ": " + *text);
  }
  return {};
}

// What no surface can do: send back and let through more than it gets.
Result<void> checkEnergy(const PhysicalMaterial& material, const JsonPlace& at) {
  const double specular = normalReflectance(material.index_of_refraction);
  for (std::size_t i = 0; i < material.reflectance.size(); ++i) {
    const auto [wavelength, diffuse] = material.reflectance[i];
    if (diffuse + specular > 1 + kRounding)
      return (at / "reflectance" / i).unusable("diffuse and specular part together exceed 1");
  }
  for (std::size_t i = 0; i < material.transmittance.size(); ++i) {
    const auto [wavelength, through] = material.transmittance[i];
    // Both faces of a pane reflect r(1 + T) without absorption and less with it, so no real pane is refused.
    const double back = specular * (1 + through) + atWavelength(material.reflectance, wavelength);
    if (through + back > 1 + kRounding)
      return (at / "transmittance" / i).unusable("transmitted and reflected part together exceed 1");
  }
  return {};
}

Result<void> checkParts(const PhysicalMaterial& material, const JsonPlace& at) {
  if (material.gloss_slope > 0 && material.index_of_refraction == 0)
    return (at / "gloss_slope").unusable("needs index_of_refraction");
  const bool pane = material.thickness_m > 0 || !material.transmittance.empty();
  if (!pane) return {};
  if (material.thickness_m == 0) return (at / "transmittance").unusable("needs thickness_m");
  if (material.transmittance.empty()) return (at / "thickness_m").unusable("needs transmittance");
  if (material.index_of_refraction == 0) return (at / "thickness_m").unusable("needs index_of_refraction");
  return {};
}

Result<std::string> readId(const nlohmann::json& entry, const JsonPlace& at) {
  auto id = readText(entry, at, "id");
  if (id && id->find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    return (at / "id").unusable("may hold a-z, 0-9 and _ only");
  return id;
}

Result<PhysicalMaterial> readEntry(const nlohmann::json& entry, const JsonPlace& at) {
  PhysicalMaterial material;
  if (auto checked = checkKeys(entry, at,
                               {"id", "label", "reflectance", "roughness_rad", "gloss_slope", "index_of_refraction",
                                "thickness_m", "transmittance", "source"});
      !checked)
    return failure(checked.error());
  const auto id = readId(entry, at);
  if (!id) return failure(id.error());
  const auto label = readText(entry, at, "label");
  if (!label) return failure(label.error());
  material.id = *id;
  material.label = *label;
  if (!entry.contains("reflectance")) return (at / "reflectance").unusable("is missing");
  for (const auto& [key, field] : {std::pair{"reflectance", &PhysicalMaterial::reflectance},
                                   std::pair{"transmittance", &PhysicalMaterial::transmittance}}) {
    if (!entry.contains(key)) continue;
    auto spectrum = readSpectrum(entry[key], at / key);
    if (!spectrum) return failure(spectrum.error());
    material.*field = std::move(*spectrum);
  }
  for (const auto& figure : kFigures) {
    if (!entry.contains(figure.key)) continue;
    const auto number = readNumber(entry[figure.key], at / figure.key, figure.minimum, figure.maximum);
    if (!number) return failure(number.error());
    material.*figure.field = *number;
  }
  for (const auto check : {checkParts, checkEnergy})
    if (const auto checked = check(material, at); !checked) return failure(checked.error());
  if (const auto checked = readSources(entry, at, material); !checked) return failure(checked.error());
  return material;
}

Result<std::vector<std::filesystem::path>> jsonFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code code;
  for (auto entry = std::filesystem::directory_iterator(folder, code);
       !code && entry != std::filesystem::directory_iterator(); entry.increment(code))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  if (code) return failure(ErrorKind::file_system, "cannot be read: " + code.message(), folder.string());
  if (files.empty()) return failure(ErrorKind::unusable, "holds no material library (*.json)", folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<std::vector<PhysicalMaterial>> readMaterialLibrary(const std::filesystem::path& folder) {
  const auto files = jsonFiles(folder);
  if (!files) return failure(files.error());
  std::map<std::string, std::pair<PhysicalMaterial, JsonPlace>> by_id;
  for (const auto& file : *files) {
    const auto entries = readJsonArray(file);
    if (!entries) return failure(entries.error());
    for (std::size_t i = 0; i < entries->size(); ++i) {
      const auto at = JsonPlace{file.filename().string(), {}} / i;
      auto material = readEntry((*entries)[i], at);
      if (!material) return failure(material.error());
      const auto id = material->id;
      const auto [place, is_new] = by_id.try_emplace(id, std::move(*material), at);
      if (!is_new)
        return (at / "id").unusable("'" + id + "' is already in " + place->second.second.file + ' ' +
                                    place->second.second.pointer);
    }
  }
  std::vector<PhysicalMaterial> library;
  for (auto& [id, entry] : by_id) library.push_back(std::move(entry.first));
  return library;
}

}  // namespace standpoint

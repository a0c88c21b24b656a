// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/library_entry.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace standpoint {

namespace {

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
    {"index_of_refraction", &PhysicalMaterial::index_of_refraction, 1, 1000},
    {"thickness_m", &PhysicalMaterial::thickness_m, 1e-5, 1},
    {"gap_m", &PhysicalMaterial::gap_m, 1e-3, 0.1},
    {"variation", &PhysicalMaterial::variation, 0, 3},
    {"texture_scale_m", &PhysicalMaterial::texture_scale_m, 1e-4, 100},
    {"retro_gain", &PhysicalMaterial::retro_gain, 1, 1e5},
};

// What a source may be given for, and has to be where the entry has it.
constexpr const char* kSourced[] = {
    "wet_of",        "reflectance",     "roughness_rad", "gloss_slope", "index_of_refraction",
    "complex_index", "thickness_m",     "transmittance", "panes",       "gap_m",
    "variation",     "texture_scale_m", "retro_gain"};

Result<Spectrum> readSpectrum(const nlohmann::json& value, const JsonPlace& at) {
  if (!value.is_array() || value.empty()) return at.unusable("must be a list of [wavelength_nm, fraction]");
  Spectrum result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto here = at / i;
    if (!value[i].is_array() || value[i].size() != 2) return here.unusable("must be [wavelength_nm, fraction]");
    TRY_ASSIGN(const auto wavelength, readNumber(value[i][0], here / std::size_t{0}, 200, 20000));
    TRY_ASSIGN(const auto fraction, readNumber(value[i][1], here / std::size_t{1}, 0, 1));
    if (!result.empty() && wavelength <= result.back().first)
      return (here / std::size_t{0}).unusable("wavelengths must increase");
    result.emplace_back(wavelength, fraction);
  }
  return result;
}

Result<std::vector<ComplexIndex>> readComplexIndex(const nlohmann::json& value, const JsonPlace& at) {
  if (!value.is_array() || value.empty()) return at.unusable("must be a list of [wavelength_nm, n, k]");
  std::vector<ComplexIndex> result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto here = at / i;
    if (!value[i].is_array() || value[i].size() != 3) return here.unusable("must be [wavelength_nm, n, k]");
    ComplexIndex row;
    for (const auto& [column, field, minimum, maximum] :
         {std::tuple{std::size_t{0}, &ComplexIndex::wavelength_nm, 200.0, 20000.0},
          {std::size_t{1}, &ComplexIndex::n, 0.001, 1000.0},
          {std::size_t{2}, &ComplexIndex::k, 0.0, 1000.0}}) {
      TRY_ASSIGN(const auto number, readNumber(value[i][column], here / column, minimum, maximum));
      row.*field = number;
    }
    if (!result.empty() && row.wavelength_nm <= result.back().wavelength_nm)
      return (here / std::size_t{0}).unusable("wavelengths must increase");
    result.push_back(row);
  }
  return result;
}

// Writes the sources out for their references: "[usgs]" becomes the source's text, and its licence goes with it.
Result<Citation> readCitation(const std::string& figure, const std::string& text, const JsonPlace& at,
                              const SourceTable& sources) {
  Citation citation{figure, {}, {}};
  bool refers = false;
  for (std::size_t from = 0; from < text.size();) {
    const auto open = std::min(text.find('[', from), text.size());
    const auto close = text.find(']', open);
    citation.text += text.substr(from, open - from);
    if (open == text.size() || close == std::string::npos) {
      citation.text += text.substr(open);
      break;
    }
    const auto id = text.substr(open + 1, close - open - 1);
    const auto source = sources.find(id);
    if (source == sources.end())
      return at.unusable("refers to the source [" + id + "], which is not listed under \"sources\"");
    citation.text += source->second.text;
    if (citation.licence.find(source->second.licence) == std::string::npos)
      citation.licence += (citation.licence.empty() ? "" : "; ") + source->second.licence;
    refers = true;
    from = close + 1;
  }
  if (!refers && !text.starts_with("unsourced"))
    return at.unusable("has no source: add the [id] of an entry in \"sources\", or start with 'unsourced'");
  return citation;
}

Result<void> readCitations(const nlohmann::json& entry, const JsonPlace& at, const SourceTable& sources,
                           PhysicalMaterial& material) {
  static const nlohmann::json kNone = nlohmann::json::object();
  const auto here = at / "source";
  const auto found = entry.find("source");
  if (found == entry.end() && !isGap(material)) return here.unusable("is missing: every value requires a source");
  const auto& texts = found == entry.end() ? kNone : *found;
  if (!texts.is_object()) return here.unusable("must be an object with one text per value");
  for (const auto& item : texts.items())
    if (std::find(std::begin(kSourced), std::end(kSourced), item.key()) == std::end(kSourced) ||
        !entry.contains(item.key()))
      return (here / item.key()).unusable("is the source of a value that the entry does not have");
  for (const char* key : kSourced) {
    if (!entry.contains(key)) continue;
    TRY_ASSIGN(auto text, readText(texts, here, key));
    TRY_ASSIGN(auto citation, readCitation(key, text, here / key, sources));
    material.sources.push_back(std::move(citation));
  }
  return {};
}

// What no surface can do: send back and let through more than it gets.
Result<void> checkEnergy(const PhysicalMaterial& material, const JsonPlace& at) {
  for (std::size_t i = 0; i < material.reflectance.size(); ++i) {
    const auto [wavelength, diffuse] = material.reflectance[i];
    if (diffuse + specularAtNormal(material, wavelength) > 1 + kRounding)
      return (at / "reflectance" / i).unusable("diffuse and specular part together exceed 1");
  }
  for (std::size_t i = 0; i < material.complex_index.size(); ++i) {
    const double wavelength = material.complex_index[i].wavelength_nm;
    if (atWavelength(material.reflectance, wavelength) + specularAtNormal(material, wavelength) > 1 + kRounding)
      return (at / "complex_index" / i).unusable("diffuse and specular part together exceed 1");
  }
  for (std::size_t i = 0; i < material.transmittance.size(); ++i) {
    const auto [wavelength, through] = material.transmittance[i];
    // Both faces of a pane reflect r(1 + T) without absorption and less with it, so no real pane is refused.
    const double back =
        specularAtNormal(material, wavelength) * (1 + through) + atWavelength(material.reflectance, wavelength);
    if (through + back > 1 + kRounding)
      return (at / "transmittance" / i).unusable("transmitted and reflected part together exceed 1");
  }
  return {};
}

Result<void> checkParts(const PhysicalMaterial& material, const JsonPlace& at) {
  const bool metal = !material.complex_index.empty();
  if (metal && material.index_of_refraction > 0)
    return (at / "complex_index").unusable("replaces index_of_refraction: specify only one");
  if (metal && material.thickness_m > 0)
    return (at / "complex_index").unusable("applies to opaque bodies; panes use index_of_refraction");
  if (material.gloss_slope > 0 && material.index_of_refraction == 0 && !metal)
    return (at / "gloss_slope").unusable("requires index_of_refraction or complex_index");
  if (material.panes > 1 && material.gap_m == 0) return (at / "panes").unusable("requires gap_m");
  if (material.gap_m > 0 && material.panes == 1) return (at / "gap_m").unusable("requires panes");
  const bool pane = material.thickness_m > 0 || transmits(material);
  if (!pane && material.panes > 1) return (at / "panes").unusable("requires thickness_m");
  if (!pane) return {};
  if (material.thickness_m == 0) return (at / "transmittance").unusable("requires thickness_m");
  if (!transmits(material)) return (at / "thickness_m").unusable("requires transmittance");
  if (material.index_of_refraction == 0) return (at / "thickness_m").unusable("requires index_of_refraction");
  return {};
}

Result<void> readGaps(const nlohmann::json& entry, const JsonPlace& at, PhysicalMaterial& material) {
  const auto found = entry.find("gaps");
  if (found == entry.end()) return {};
  if (!found->is_array() || found->empty()) return (at / "gaps").unusable("must be a list of texts");
  for (std::size_t i = 0; i < found->size(); ++i) {
    TRY_ASSIGN(auto text, textOf((*found)[i], at / "gaps" / i));
    material.gaps.push_back(std::move(text));
  }
  return {};
}

Result<void> readSpectra(const nlohmann::json& entry, const JsonPlace& at, PhysicalMaterial& material) {
  for (const auto& [key, field] : {std::pair{"reflectance", &PhysicalMaterial::reflectance},
                                   std::pair{"transmittance", &PhysicalMaterial::transmittance}}) {
    if (!entry.contains(key)) continue;
    TRY_ASSIGN(auto spectrum, readSpectrum(entry[key], at / key));
    material.*field = std::move(spectrum);
  }
  if (!entry.contains("complex_index")) return {};
  TRY_ASSIGN(auto index, readComplexIndex(entry["complex_index"], at / "complex_index"));
  material.complex_index = std::move(index);
  return {};
}

Result<void> readNumbers(const nlohmann::json& entry, const JsonPlace& at, PhysicalMaterial& material) {
  for (const auto& figure : kFigures) {
    if (!entry.contains(figure.key)) continue;
    TRY_ASSIGN(const auto number, readNumber(entry[figure.key], at / figure.key, figure.minimum, figure.maximum));
    material.*figure.field = number;
  }
  if (!entry.contains("panes")) return {};
  TRY_ASSIGN(const auto panes, readNumber(entry["panes"], at / "panes", 2, 4));
  if (!entry["panes"].is_number_integer()) return (at / "panes").unusable("must be a whole number");
  material.panes = static_cast<int>(panes);
  return {};
}

// What the figures rest on: measured ones, a dry material's, or none at all.
Result<void> readBasis(const nlohmann::json& entry, const JsonPlace& at, PhysicalMaterial& material) {
  if (entry.contains("wet_of")) {
    TRY_ASSIGN(auto dry, readText(entry, at, "wet_of"));
    if (!isGap(material)) return (at / "wet_of").unusable("defines the reflectance: leave out other optical values");
    material.wet_of = std::move(dry);
    return {};
  }
  if (isGap(material) && material.gaps.empty())
    return (at / "reflectance").unusable("is missing; if there is no measurement, list it under \"gaps\"");
  return {};
}

// Reflectance of a wetted diffuse surface: light enters through the film's face (0.02 is sent back) and leaves it
// again, of which 0.47 is thrown back each time (physics.md §4.8).
Spectrum wetted(const Spectrum& dry) {
  constexpr double kFace = 0.02, kInside = 0.47;
  Spectrum wet = dry;
  for (auto& [wavelength, fraction] : wet) fraction = (1 - kFace) * (1 - kInside) * fraction / (1 - kInside * fraction);
  return wet;
}

}  // namespace

Result<void> wet(PhysicalMaterial& material, const PhysicalMaterial* dry, const JsonPlace& at) {
  if (dry == nullptr) return (at / "wet_of").unusable("'" + material.wet_of + "' is not in the library");
  if (isGap(*dry) || !dry->wet_of.empty() || transmits(*dry))
    return (at / "wet_of").unusable("'" + material.wet_of + "' is not a dry opaque material with data");
  material.reflectance = wetted(dry->reflectance);
  return checkEnergy(material, at);
}

Result<PhysicalMaterial> readMaterial(const nlohmann::json& entry, const JsonPlace& at, const SourceTable& sources) {
  PhysicalMaterial material;
  TRY(checkKeys(entry, at,
                {"id", "label", "gaps", "wet_of", "reflectance", "roughness_rad", "gloss_slope", "index_of_refraction",
                 "complex_index", "thickness_m", "transmittance", "panes", "gap_m", "variation", "texture_scale_m",
                 "retro_gain", "source"}));
  TRY_ASSIGN(const auto id, readId(entry, at));
  TRY_ASSIGN(const auto label, readText(entry, at, "label"));
  material.id = id;
  material.label = label;
  for (const auto read : {readGaps, readSpectra, readNumbers, readBasis}) TRY(read(entry, at, material));
  for (const auto check : {checkParts, checkEnergy}) TRY(check(material, at));
  TRY(readCitations(entry, at, sources, material));
  return material;
}

}  // namespace standpoint

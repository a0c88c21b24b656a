// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/library_entry.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <nlohmann/json.hpp>

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
    {"surface_variation", &PhysicalMaterial::surface_variation, 0, 3},
    {"texture_scale_m", &PhysicalMaterial::texture_scale_m, 1e-4, 100},
    {"retro_gain", &PhysicalMaterial::retro_gain, 1, 1e5},
    {"water_film_m", &PhysicalMaterial::water_film_m, 1e-6, 0.01},
};

// What a source may be given for, and has to be where the entry has it.
constexpr const char* kSourced[] = {
    "wet_of",        "reflectance", "roughness_rad",     "gloss_slope",     "index_of_refraction",
    "complex_index", "group_index", "thickness_m",       "transmittance",   "panes",
    "gap_m",         "variation",   "surface_variation", "texture_scale_m", "retro_gain",
    "water_film_m"};

// Rows of numbers within these ranges, each wavelength above the one before; `shape` is one row in words.
using Row = std::vector<double>;
std::vector<Row> readRows(JsonFields& f, const char* key, const std::string& shape,
                          const std::vector<std::pair<double, double>>& ranges) {
  std::vector<Row> rows;
  const auto* value = f.raw(key);
  if (value == nullptr) return rows;
  if (!value->is_array() || value->empty()) return f.needs(key, *value, "a list of " + shape), rows;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const auto& entry = (*value)[i];
    const auto here = f.pointer(key) + "/" + std::to_string(i);
    if (!entry.is_array() || entry.size() != ranges.size()) return f.fault().needs(here, entry, shape), rows;
    Row row;
    for (std::size_t k = 0; k < ranges.size(); ++k)
      row.push_back(numberAt(f.fault(), entry[k], here + "/" + std::to_string(k), ranges[k].first, ranges[k].second));
    if (!rows.empty() && row[0] <= rows.back()[0]) f.fault().say(here + "/0", "wavelengths must increase");
    rows.push_back(std::move(row));
  }
  return rows;
}

Spectrum readSpectrum(JsonFields& f, const char* key) {
  Spectrum spectrum;
  for (const auto& row : readRows(f, key, "[wavelength_nm, fraction]", {{200, 20000}, {0, 1}}))
    spectrum.emplace_back(row[0], row[1]);
  return spectrum;
}

std::vector<ComplexIndex> readComplexIndex(JsonFields& f) {
  std::vector<ComplexIndex> index;
  for (const auto& row :
       readRows(f, "complex_index", "[wavelength_nm, n, k]", {{200, 20000}, {0.001, 1000}, {0, 1000}}))
    index.push_back({row[0], row[1], row[2]});
  return index;
}

// Writes the sources out for their references: "[usgs]" becomes the source's text, and its licence goes with it.
Citation readCitation(JsonFields& texts, const char* figure, const SourceTable& sources) {
  const auto text = texts.text(figure);
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
    from = close + 1;
    refers = true;
    const auto source = sources.find(id);
    if (source == sources.end()) {
      texts.wrong(figure, "refers to the source [" + id + "], which is not listed under \"sources\"");
      continue;
    }
    citation.text += source->second.text;
    if (citation.licence.find(source->second.licence) == std::string::npos)
      citation.licence += (citation.licence.empty() ? "" : "; ") + source->second.licence;
  }
  if (!refers && !text.starts_with("unsourced"))
    texts.wrong(figure, "has no source: add the [id] of an entry in \"sources\", or start with 'unsourced'");
  return citation;
}

void readCitations(JsonFields& f, const SourceTable& sources, PhysicalMaterial& material) {
  const auto* found = f.raw("source");
  if (found == nullptr && isGap(material)) return;
  if (found == nullptr) return f.wrong("source", "is missing: every value requires a source");
  JsonFields texts(f.fault(), *found, f.pointer("source"));
  for (const auto& key : texts.keys())
    if (std::find(std::begin(kSourced), std::end(kSourced), key) == std::end(kSourced) || !f.has(key))
      texts.wrong(key, "is the source of a value that the entry does not have");
  for (const char* key : kSourced)
    if (f.has(key)) material.sources.push_back(readCitation(texts, key, sources));
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
  if (material.water_film_m > 0 && material.wet_of.empty()) return (at / "water_film_m").unusable("requires wet_of");
  if (!material.group_index.empty() && !transmits(material))
    return (at / "group_index").unusable("requires transmittance");
  const bool pane = material.thickness_m > 0 || transmits(material);
  if (!pane && material.panes > 1) return (at / "panes").unusable("requires thickness_m");
  if (!pane) return {};
  if (material.thickness_m == 0) return (at / "transmittance").unusable("requires thickness_m");
  if (!transmits(material)) return (at / "thickness_m").unusable("requires transmittance");
  if (material.index_of_refraction == 0) return (at / "thickness_m").unusable("requires index_of_refraction");
  return {};
}

void readGaps(JsonFields& f, PhysicalMaterial& material) {
  const auto* gaps = f.raw("gaps");
  if (gaps == nullptr) return;
  if (!gaps->is_array() || gaps->empty()) return f.needs("gaps", *gaps, "a list of texts");
  for (std::size_t i = 0; i < gaps->size(); ++i)
    material.gaps.push_back(textAt(f.fault(), (*gaps)[i], f.pointer("gaps") + "/" + std::to_string(i)));
}

void readFigures(JsonFields& f, PhysicalMaterial& material) {
  material.reflectance = readSpectrum(f, "reflectance");
  if (f.has("measured_as")) {
    material.hemispherical = f.wordOf("measured_as", {"hemispherical", "bidirectional"}) == "hemispherical";
    if (!f.has("reflectance")) f.wrong("measured_as", "requires reflectance");
  }
  material.transmittance = readSpectrum(f, "transmittance");
  material.complex_index = readComplexIndex(f);
  for (const auto& row : readRows(f, "group_index", "[wavelength_nm, n_g]", {{200, 20000}, {1, 10}}))
    material.group_index.emplace_back(row[0], row[1]);
  for (const auto& figure : kFigures) {
    double& value = material.*figure.field;
    value = f.numberOr(figure.key, value, figure.minimum, figure.maximum);
  }
  const double panes = f.numberOr("panes", material.panes, 2, 4);
  material.panes = static_cast<int>(panes);
  if (material.panes != panes) f.wrong("panes", "must be a whole number");
}

// What the figures rest on: measured ones, a dry material's, or none at all.
void readBasis(JsonFields& f, PhysicalMaterial& material) {
  material.wet_of = f.textOr("wet_of", "");
  if (!material.wet_of.empty()) {
    if (!isGap(material)) f.wrong("wet_of", "defines the reflectance: leave out other optical values");
  } else if (isGap(material) && material.gaps.empty()) {
    f.wrong("reflectance", "is missing; if there is no measurement, list it under \"gaps\"");
  }
}

// Reflectance of a wetted diffuse surface: light enters through the film's face (0.02 is sent back) and leaves it
// again, of which 0.47 is thrown back each time (physics.md §4.8). The film absorbs e^(-2.4 α d) there and back, α of
// water by Segelstein 1981.
Spectrum wetted(const Spectrum& dry, double film_m) {
  constexpr double kFace = 0.02, kInside = 0.47, kWay = 2.4;
  static const Spectrum kLnAbsorption_per_m = {{532, std::log(0.04)}, {660, std::log(0.37)},  {830, std::log(3.1)},
                                               {905, std::log(7.1)},  {1064, std::log(15.0)}, {1550, std::log(1086.0)}};
  Spectrum wet = dry;
  for (auto& [wavelength, fraction] : wet) {
    const double film = std::exp(-kWay * film_m * std::exp(atWavelength(kLnAbsorption_per_m, wavelength)));
    fraction = (1 - kFace) * (1 - kInside) * fraction / (1 - kInside * fraction) * film;
    fraction = std::round(1e9 * fraction) / 1e9;  // the last bits of exp differ between processors
  }
  return wet;
}

}  // namespace

Result<void> wet(PhysicalMaterial& material, const PhysicalMaterial* dry, const JsonPlace& at) {
  if (dry == nullptr) return (at / "wet_of").unusable("'" + material.wet_of + "' is not in the library");
  if (isGap(*dry) || !dry->wet_of.empty() || transmits(*dry))
    return (at / "wet_of").unusable("'" + material.wet_of + "' is not a dry opaque material with data");
  material.reflectance = wetted(dry->reflectance, material.water_film_m);
  material.hemispherical = dry->hemispherical;
  return checkEnergy(material, at);
}

std::string readId(JsonFields& fields) {
  auto id = fields.text("id");
  if (id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
    fields.wrong("id", "must contain only a-z, 0-9 and _");
  return id;
}

Result<PhysicalMaterial> readMaterial(JsonFields& fields, const SourceTable& sources) {
  PhysicalMaterial material;
  material.id = readId(fields);
  material.label = fields.text("label");
  readGaps(fields, material);
  readFigures(fields, material);
  fields.skip("source");
  fields.skip("wet_of");
  fields.close();
  readBasis(fields, material);
  TRY(fields.fault().result());
  for (const auto check : {checkParts, checkEnergy}) TRY(check(material, {fields.fault().file(), fields.pointer()}));
  readCitations(fields, sources, material);
  TRY(fields.fault().result());
  return material;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/material_edit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using nlohmann::json;

// A tenth of a per cent is what people write; what the tables have beyond it is lost with the copy.
std::array<double, 7> percentOf(const Spectrum& spectrum) {
  std::array<double, 7> result{};
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = std::round(1000 * atWavelength(spectrum, MaterialEdit::kWavelengths_nm[i])) / 10;
  return result;
}

json spectrumOf(const std::array<double, 7>& percent) {
  json spectrum = json::array();
  for (std::size_t i = 0; i < percent.size(); ++i)
    spectrum.push_back({MaterialEdit::kWavelengths_nm[i], percent[i] / 100});
  return spectrum;
}

json rowsOf(const std::vector<ComplexIndex>& index) {
  json rows = json::array();
  for (const auto& row : index) rows.push_back({row.wavelength_nm, row.n, row.k});
  return rows;
}

// The reader's own ranges, said before the file is written.
std::string flawOfIndex(const std::vector<ComplexIndex>& index) {
  if (index.empty()) return "A metal requires n and k for at least one wavelength";
  for (std::size_t i = 0; i < index.size(); ++i) {
    const auto& [wavelength, n, k] = index[i];
    if (!(wavelength >= 200 && wavelength <= 20000))
      return trf("Row {}: wavelength must be from 200 to 20 000 nm", i + 1);
    if (i > 0 && !(wavelength > index[i - 1].wavelength_nm))
      return trf("Row {}: wavelengths must increase from row to row", i + 1);
    if (!(n >= 0.001 && n <= 1000)) return trf("Row {}: n must be from 0.001 to 1000", i + 1);
    if (!(k >= 0 && k <= 1000)) return trf("Row {}: k must be from 0 to 1000", i + 1);
  }
  return {};
}

}  // namespace

MaterialEdit editOf(const PhysicalMaterial& m) {
  MaterialEdit edit;
  edit.from = m.id;
  edit.id = m.id + "_own";
  edit.label = m.label + ", own";
  edit.reflectance_percent = percentOf(m.reflectance);
  edit.hemispherical = m.hemispherical;
  edit.roughness_deg = m.roughness_rad / kRadPerDeg;
  edit.gloss_slope = m.gloss_slope;
  edit.index_of_refraction = m.index_of_refraction;
  edit.metal = !m.complex_index.empty();
  edit.complex_index = m.complex_index;
  edit.pane = transmits(m);
  edit.transmittance_percent = percentOf(m.transmittance);
  edit.thickness_mm = m.thickness_m * 1000;
  edit.panes = m.panes;
  edit.gap_mm = m.gap_m * 1000;
  return edit;
}

json libraryFileOf(const MaterialEdit& edit) {
  json entry = {{"id", edit.id}, {"label", edit.label}, {"reflectance", spectrumOf(edit.reflectance_percent)}};
  if (edit.roughness_deg > 0) entry["roughness_rad"] = edit.roughness_deg * kRadPerDeg;
  if (edit.metal)
    entry["complex_index"] = rowsOf(edit.complex_index);
  else if (edit.index_of_refraction > 0)
    entry["index_of_refraction"] = edit.index_of_refraction;
  if (edit.gloss_slope > 0) entry["gloss_slope"] = edit.gloss_slope;
  if (edit.pane && !edit.metal) {
    entry["transmittance"] = spectrumOf(edit.transmittance_percent);
    entry["thickness_m"] = edit.thickness_mm / 1000;
    if (edit.panes > 1) {
      entry["panes"] = edit.panes;
      entry["gap_m"] = edit.gap_mm / 1000;
    }
  }
  json sources = json::object();
  for (const auto& [key, value] : entry.items())
    if (key != "id" && key != "label")
      sources[key] = edit.source.empty() ? "unsourced: by the user, from a copy of " + edit.from : "by the user: [own]";
  entry["source"] = std::move(sources);
  if (edit.hemispherical) entry["measured_as"] = "hemispherical";
  json file = {{"materials", {std::move(entry)}}};
  if (!edit.source.empty()) file["sources"] = {{{"id", "own"}, {"text", edit.source}, {"licence", "the user's own"}}};
  return file;
}

void addIndexRow(MaterialEdit& edit, std::size_t below) {
  auto& index = edit.complex_index;
  if (index.empty()) {
    index.push_back({905, 2, 5});
    return;
  }
  ComplexIndex row = index[below];
  if (below + 1 < index.size()) {
    const auto& next = index[below + 1];
    row = {(row.wavelength_nm + next.wavelength_nm) / 2, (row.n + next.n) / 2, (row.k + next.k) / 2};
  } else {
    row.wavelength_nm = std::min(row.wavelength_nm + 100, 20000.0);
  }
  index.insert(index.begin() + static_cast<std::ptrdiff_t>(below) + 1, row);
}

void takeIndexRow(MaterialEdit& edit, std::size_t row) {
  edit.complex_index.erase(edit.complex_index.begin() + static_cast<std::ptrdiff_t>(row));
}

std::string flawOf(const MaterialEdit& edit) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  if (edit.id.empty() || !std::all_of(edit.id.begin(), edit.id.end(), allowed))
    return "Use only a-z, 0-9 and _ in the ID";
  if (edit.label.find_first_not_of(' ') == std::string::npos) return "Enter a name";
  if (edit.metal) return flawOfIndex(edit.complex_index);
  if (edit.gloss_slope > 0 && !(edit.index_of_refraction > 1)) return "Gloss requires an index of refraction above 1";
  if (edit.pane && !(edit.index_of_refraction > 1)) return "A pane requires an index of refraction above 1";
  if (edit.pane && !(edit.thickness_mm > 0)) return "Enter the thickness of the pane";
  if (edit.pane && edit.panes > 1 && !(edit.gap_mm >= 1)) return "Enter a gap between panes of at least 1 mm";
  return {};
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/physical_material.h"

namespace standpoint {

// A user's own material as fields; percent and degrees as people write them.
struct MaterialEdit {
  static constexpr std::array<double, 7> kWavelengths_nm = {532, 660, 785, 830, 905, 1064, 1550};
  std::string from;  // id of the material that it was copied from
  std::string id, label;
  std::array<double, 7> reflectance_percent = {};
  bool hemispherical = false;  // the reflectance was measured so
  double roughness_deg = 0;
  double gloss_slope = 0, index_of_refraction = 0;
  bool metal = false;  // n and k at wavelengths instead of one index
  std::vector<ComplexIndex> complex_index;
  bool pane = false;
  std::array<double, 7> transmittance_percent = {};
  double thickness_mm = 0;
  int panes = 1;
  double gap_mm = 0;
  std::string source;  // what the user says of the figures; empty: unsourced
};

MaterialEdit editOf(const PhysicalMaterial& material);
// A library file of this one material, as `materials --library` reads it.
nlohmann::json libraryFileOf(const MaterialEdit& edit);
// A row of n and k below that one (or the first), halfway to the next; behind the last at a wavelength beyond it.
void addIndexRow(MaterialEdit& edit, std::size_t below);
void takeIndexRow(MaterialEdit& edit, std::size_t row);

// Why it cannot be kept; empty when it can. What the reader of libraries refuses beyond that comes as the verb's error.
std::string flawOf(const MaterialEdit& edit);

}  // namespace standpoint

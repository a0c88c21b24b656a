// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace standpoint {

// The physics of a surface for a monostatic laser (physics.md §2): reflectance is the Lambert-equivalent diffuse
// reflectance at normal incidence, 0..1, over wavelength in nm (ascending; linear between, constant outside).
struct PhysicalMaterial {
  std::string id;        // "brick_red_bare"
  std::string label;     // "Brick, red, bare"
  std::vector<std::pair<double, double>> reflectance;   // (wavelength_nm, 0..1), diffuse part
  double roughness_rad = 0;         // Oren–Nayar σ of the facets' slope; 0 = Lambert
  double gloss_slope = 0;           // Beckmann slope m of the specular lobe; 0 = no lobe
  double index_of_refraction = 0;   // n of the coat or body; 0 = no specular part
  double thickness_m = 0;           // of a pane; 0 = opaque
  std::vector<std::pair<double, double>> transmittance; // (wavelength_nm, 0..1) of the whole pane at normal incidence
  std::vector<std::string> source;  // one or more citations for the figures
};

// Linear between the tabulated wavelengths, constant outside; 0 for an empty table.
double atWavelength(const std::vector<std::pair<double, double>>& table, double wavelength_nm);

// Which physical material a product's surface has. Sorted by (product, surface); one entry for each pair that occurs.
struct AssignedSurface {
  std::uint32_t product = 0;   // index into Environment::products
  std::uint32_t surface = 0;   // index into Environment::surfaces
  std::int32_t material = -1;  // index into MaterialAssignment::materials; -1 = nothing fits
  std::string reason;          // the rule or the user's selector that decided, "" when nothing fits
};

struct MaterialAssignment {
  std::vector<PhysicalMaterial> materials;   // those in use, by id
  std::vector<AssignedSurface> surfaces;
};

// -1 when the pair is not assigned.
std::int32_t materialOf(const MaterialAssignment& assignment, std::uint32_t product, std::uint32_t surface);

}  // namespace standpoint

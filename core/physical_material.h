// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// Share over wavelength in nm, ascending; linear between, constant outside.
using Spectrum = std::vector<std::pair<double, double>>;

// n + ik of an opaque body: a metal.
struct ComplexIndex {
  double wavelength_nm = 0;
  double n = 0;
  double k = 0;
  bool operator==(const ComplexIndex&) const = default;
};

// Where one figure of a material comes from.
struct Citation {
  std::string figure;  // the figure's key: "reflectance"
  std::string text;    // "measured: ECOSTRESS …, sample 0424UUUCNC"; begins with "unsourced" where nobody measured it
  std::string licence;  // of the source; empty where the figure is unsourced
  bool operator==(const Citation&) const = default;
};

// The physics of a surface for a monostatic laser (physics.md §2): reflectance is the diffuse reflectance at (nearly)
// normal incidence, over a white Lambert surface. A material without reflectance is a named gap: people ask for it,
// nobody measured it.
struct PhysicalMaterial {
  std::string id;              // "brick_red_bare"
  std::string label;           // "Brick, red, bare"
  Spectrum reflectance;        // diffuse part
  bool hemispherical = false;  // that is what goes into the whole hemisphere, lit at 10°; else back along the normal
  double roughness_rad = 0;    // Oren–Nayar σ of the facets' slope; 0 = Lambert
  double gloss_slope = 0;      // Beckmann slope m of the specular lobe; 0 = no lobe
  double index_of_refraction = 0;           // n of the coat or body; 0 = no specular part, or a metal
  std::vector<ComplexIndex> complex_index;  // of a metal, wavelengths ascending
  Spectrum group_index;                     // of a pane: c over the speed of a pulse in it; empty = n stands in
  double thickness_m = 0;                   // of one pane; 0 = opaque
  Spectrum transmittance;                   // of one pane at normal incidence
  int panes = 1;                            // equal panes, one behind the other …
  double gap_m = 0;                         // … so far apart
  double variation = 0;                     // coefficient of variation of the reflectance within the class; 0 = a gap
  double texture_scale_m = 0;               // correlation length on one surface; 0 = a gap
  double surface_variation = 0;             // coefficient of variation from one surface to another; 0 = by `variation`
  double retro_gain = 0;                    // of a retroreflector over a white Lambert surface seen head-on; 0 = none
  std::string wet_of;                       // the dry material whose figures were wetted …
  double water_film_m = 0;        // … with so much water on it; what it absorbs is taken off the reflectance
  std::vector<std::string> gaps;  // what is known to be missing, in words
  std::vector<Citation> sources;  // one for each figure
  bool operator==(const PhysicalMaterial&) const = default;
};

// 0 for an empty table.
double atWavelength(const Spectrum& table, double wavelength_nm);

// F0: what the specular lobe sends back at normal incidence, 0..1.
double specularAtNormal(const PhysicalMaterial& material, double wavelength_nm);

// Of the coat or body; n and k of a metal are linear between its wavelengths. n is 0 where there is no specular part.
ComplexIndex indexAt(const PhysicalMaterial& material, double wavelength_nm);

// Of the whole build-up from the first face to the last.
double buildUpThickness(const PhysicalMaterial& material);

inline bool transmits(const PhysicalMaterial& material) { return !material.transmittance.empty(); }
inline bool isGap(const PhysicalMaterial& material) { return material.reflectance.empty(); }

// Which physical material a product's surface has. Sorted by (product, surface); one entry for each pair that occurs.
struct AssignedSurface {
  std::uint32_t product = 0;   // index into Environment::products
  std::uint32_t surface = 0;   // index into Environment::surfaces
  std::int32_t material = -1;  // index into MaterialAssignment::materials; -1 = nothing fits
  std::string reason;          // the rule or the user's selector that decided, "" when nothing fits
  double confidence = 0;       // 0..1, of the rule; 1 where the user said so
};

// Faces of a surface that the user gave another material: those that look within kFaceCone of a direction, or of them
// only what hangs together with the one at a point (AssignedTriangles finds it).
struct AssignedFaces {
  std::uint32_t product = 0;
  std::uint32_t surface = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit, local frame
  std::int32_t material = -1;
  std::string reason;
  std::optional<Eigen::Vector3d> point;  // local frame
};
constexpr double kFaceCone = 0.984807753012208;  // cos 10°

struct MaterialAssignment {
  std::vector<PhysicalMaterial> materials;  // those in use, by id
  std::vector<AssignedSurface> surfaces;
  std::vector<AssignedFaces> faces;  // sorted by (product, surface); of several that fit, the last one holds
};

// -1 when the pair is not assigned. Of the surface as a whole: single faces are asked of AssignedTriangles.
std::int32_t materialOf(const MaterialAssignment& assignment, std::uint32_t product, std::uint32_t surface);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// Received power throughout: x, in units of a white Lambert target at 1 m seen head-on (physics.md §2.1).

// A material at the instrument's wavelength.
struct Optics {
  float diffuse = 0;     // what comes back head-on, over a white Lambert surface
  float roughness = 0;   // B/A of Oren and Nayar 1994, monostatic: ρ (cos θ + B/A sin² θ)
  float glint = 0;       // F0 / 4m²: height of the Beckmann lobe; 0 = no lobe
  float lobe_slope = 0;  // m
  float steepness = 0;   // 1 / m²
  bool transparent = false;
  double index = 1;                // n of a pane
  double group_index = 1;          // by which light is late in it
  double inner_transmittance = 1;  // of one way through its body at normal incidence
  double thickness_m = 0;          // of one pane
  int panes = 1;
  bool smooth = false;                // shows mirror images
  bool glossy = false;                // shows them dimly: its lobe is sharp, but wider than the beam
  double mirror_n = 1, mirror_k = 0;  // n + ik of an opaque smooth surface
  float retro_gain = 0;               // over a white surface, within kRetroEntrance; 0 = none
  float variation = 0;                // coefficient of variation of the reflectance on one surface …
  float texture_scale_m = 0;          // … over this length
  float surface_spread = 0;           // σ of its logarithm from one surface to another
};

// The reflectance that was measured comes back head-on, however rough: A only scales the albedo of the facets, which
// nobody measured (§2.3). A hemispherical figure, lit at 10°, is 1 + 0.0374 B/A times that.
Optics opticsOf(const PhysicalMaterial& material, double wavelength_nm);

// A surface to which nothing is assigned: Lambert, with the luminance of its colour (Rec. 709 weights on linear sRGB)
// between 5 and 95 %. A colour says nothing of 1550 nm; it keeps unlike surfaces apart, no more.
Optics opticsOf(const Colour& colour);

// ρ_eq(θ) = π f_r cos θ; the lobe is a separate, rare term.
inline float diffuseEquivalent(const Optics& optics, float cosine) {
  return optics.diffuse * (cosine + optics.roughness * (1 - cosine * cosine));
}
float glossEquivalent(const Optics& optics, float cosine);
// A retroreflector keeps its gain within 30° of entrance (physics.md §4.9, where 20 to 30° is the range); beyond it is
// a diffuse surface.
constexpr float kRetroEntrance = 0.8660254F;  // cosine
inline float retroEquivalent(const Optics& optics, float cosine) {
  return cosine > kRetroEntrance ? optics.retro_gain : 0;
}
inline float lambertEquivalent(const Optics& optics, float cosine) {
  const float diffuse = diffuseEquivalent(optics, cosine) + retroEquivalent(optics, cosine);
  return optics.glint > 0 ? diffuse + glossEquivalent(optics, cosine) : diffuse;
}

// What a face of n + ik reflects of unpolarised light, by Fresnel's law (Born and Wolf, Principles of Optics, §14.2).
double fresnel(double n, double k, double cosine);
// What a smooth surface mirrors of unpolarised light: a pane by its slabs, an opaque body by its face.
double mirrorReflectance(const Optics& optics, double cosine);

// η_opt(R) of a measured curve below its bound: 2 to the power of c0 + c1 R + c2 R² + c3 R³ + 2 log2 R.
std::array<float, 4> nearRangePolynomial(const NearRangeCurve& curve);
float nearRangeFactor(const NearRangeCurve& curve, float range_m);

// η_opt(R) of the instrument.
inline float nearRangeFactor(const Instrument& instrument, float range_m) {
  if (instrument.near_range_curve.below_m > 0) return nearRangeFactor(instrument.near_range_curve, range_m);
  const float ratio = static_cast<float>(instrument.near_range_m) / range_m;
  float power = 1;
  for (int k = 0; k < instrument.near_range_power; ++k) power *= ratio;
  return 1 / (1 + power);
}

// What of a mirror image is left where the mirror's lobe is wider than the beam: it lights Ω = 8π m² and not one
// direction, and of what comes back the receiver sees the spot that its beam lit, A: A (R1 + R2)² / (R1² R2² Ω), at
// most 1.
double roughMirrorFraction(double lobe_slope, double beam_radius_m, double to_mirror_m, double from_mirror_m);

// x_min = ρ_ref / R_max² · air of the data sheet (§2.7): its range holds in clear air.
double detectionThreshold(const ScanSettings& settings, double clear_air_extinction_per_m);

// A slab in air, both polarisations averaged, all inner reflections added (§4.6).
struct SlabPower {
  double reflected = 0, transmitted = 1;
};
SlabPower slab(double index, double inner_transmittance_at_normal, double cosine);
// So many equal slabs behind one another, all reflections between them added: incoherent, the gaps are wide.
SlabPower stack(SlabPower one, int panes);
// The one-way inner transmittance that makes the whole slab transmit `transmittance` at normal incidence.
double innerTransmittance(double index, double transmittance);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/radiometry.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/portable_math.h"

namespace standpoint {

namespace {

// The beam's own divergence and the receiver's opening blur a sharper lobe than this.
constexpr double kSharpestSlope = 0.005;
// Float glass, physics.md §1.4: at most 0.01.
constexpr double kPaneSlope = 0.01;
// A rougher surface spreads a mirror image over more than the beam is wide.
constexpr double kSmoothestSlope = 0.0105;
// Beyond, a mirror image is a hundredth of the mirror's own diffuse return before it is a hand's width away.
constexpr double kRoughestMirror = 0.0505;

// (1/π) ∫ max(0, cos φ) sin α tan β cos θ dω over the hemisphere, lit at 10°: what of B a hemispherical figure holds.
constexpr double kHemisphere = 0.0374;

// A class varies from building to building; on one surface by half of that (physics.md §2.9, an engineering figure).
constexpr double kOnOneSurface = 0.5;  // … and what that leaves of the variance is between surfaces
// Of weathering, 0.3 to 1 m there: for materials of which nobody measured it, which are all so far.
constexpr double kUsualScale_m = 0.5;

double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

}  // namespace

Optics opticsOf(const PhysicalMaterial& material, double wavelength_nm) {
  Optics optics;
  const double variance = material.roughness_rad * material.roughness_rad;
  const double rough = 0.45 * variance / (variance + 0.09) / (1 - 0.5 * variance / (variance + 0.33));
  const double measured = atWavelength(material.reflectance, wavelength_nm);
  const double head_on = material.hemispherical ? measured / (1 + kHemisphere * rough) : measured;
  optics.diffuse = static_cast<float>(std::clamp(head_on, 0.0, 1.0));
  optics.roughness = static_cast<float>(rough);
  optics.transparent = material.thickness_m > 0 && !material.transmittance.empty() && material.index_of_refraction > 1;
  const double slope = material.gloss_slope > 0 ? material.gloss_slope : optics.transparent ? kPaneSlope : 0;
  if (const double specular = specularAtNormal(material, wavelength_nm); slope > 0 && specular > 0) {
    optics.smooth = slope <= kSmoothestSlope;
    optics.glossy = !optics.smooth && slope <= kRoughestMirror;
    const auto index = indexAt(material, wavelength_nm);
    optics.mirror_n = index.n, optics.mirror_k = index.k;
    optics.lobe_slope = static_cast<float>(std::max(slope, kSharpestSlope));
    optics.steepness = 1 / (optics.lobe_slope * optics.lobe_slope);
    optics.glint = static_cast<float>(specular) / (4 * optics.lobe_slope * optics.lobe_slope);
  }
  if (optics.transparent) {
    optics.index = material.index_of_refraction;
    optics.group_index =
        material.group_index.empty() ? optics.index : atWavelength(material.group_index, wavelength_nm);
    optics.thickness_m = material.thickness_m;
    optics.panes = material.panes;
    optics.inner_transmittance = innerTransmittance(optics.index, atWavelength(material.transmittance, wavelength_nm));
  }
  optics.retro_gain = static_cast<float>(material.retro_gain);
  optics.variation = static_cast<float>(kOnOneSurface * material.variation);
  optics.texture_scale_m = static_cast<float>(material.texture_scale_m > 0 ? material.texture_scale_m : kUsualScale_m);
  const double apart = material.surface_variation > 0
                           ? material.surface_variation
                           : std::sqrt(1 - kOnOneSurface * kOnOneSurface) * material.variation;
  optics.surface_spread = static_cast<float>(std::sqrt(portable::log(1 + apart * apart)));
  return optics;
}

Optics opticsOf(const Colour& colour) {
  Optics optics;
  const double luminance = 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
  optics.diffuse = static_cast<float>(std::clamp(luminance, 0.05, 0.95));
  return optics;
}

double fresnel(double n, double k, double cosine) {
  const double cosine2 = cosine * cosine, sine2 = 1 - cosine2;
  const double even = n * n - k * k - sine2;
  const double both = std::sqrt(even * even + 4 * n * n * k * k);  // a² + b² of (a + ib)² = (n + ik)² - sin²θ
  const double real = std::sqrt(std::max(0.0, (both + even) / 2));
  const double across = (both - 2 * real * cosine + cosine2) / (both + 2 * real * cosine + cosine2);
  const double along = across * (cosine2 * both - 2 * real * cosine * sine2 + sine2 * sine2) /
                       (cosine2 * both + 2 * real * cosine * sine2 + sine2 * sine2);
  return (across + along) / 2;
}

double mirrorReflectance(const Optics& optics, double cosine) {
  if (optics.transparent) return stack(slab(optics.index, optics.inner_transmittance, cosine), optics.panes).reflected;
  return fresnel(optics.mirror_n, optics.mirror_k, cosine);
}

double roughMirrorFraction(double lobe_slope, double beam_radius_m, double to_mirror_m, double from_mirror_m) {
  const double way = (to_mirror_m + from_mirror_m) * beam_radius_m / (to_mirror_m * from_mirror_m * lobe_slope);
  return std::min(1.0, way * way / 8);
}

float glossEquivalent(const Optics& optics, float cosine) {
  const float square = cosine * cosine;
  const float exponent = (1 - square) / square * optics.steepness;  // tan²θ / m²
  if (!(exponent < 40)) return 0;
  return optics.glint * portable::exp2(-1.4426950408889634F * exponent) / (square * square * cosine);
}

std::array<float, 4> nearRangePolynomial(const NearRangeCurve& curve) {
  constexpr double kLog2PerDb = 0.33219280948873623;
  std::array<float, 4> log2{};
  for (std::size_t k = 0; k < curve.amplitude_db.size(); ++k)
    log2[k] = static_cast<float>(kLog2PerDb * (curve.amplitude_db[k] - (k == 0 ? curve.far_db : 0)));
  return log2;
}

float nearRangeFactor(const NearRangeCurve& curve, float range_m) {
  if (range_m >= static_cast<float>(curve.below_m)) return 1;
  const auto c = nearRangePolynomial(curve);
  const float power = c[0] + range_m * (c[1] + range_m * (c[2] + range_m * c[3])) + 2 * portable::log2(range_m);
  return std::min(1.0F, portable::exp2(std::max(power, -100.0F)));
}

double detectionThreshold(const ScanSettings& settings, double clear_air_extinction_per_m) {
  return settings.reference_reflectivity / (settings.max_range_m * settings.max_range_m) *
         portable::exp(-2 * clear_air_extinction_per_m * settings.max_range_m);
}

SlabPower slab(double index, double inner_transmittance_at_normal, double cosine) {
  const double cosine_inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  const double t =
      (inner_transmittance_at_normal > 0 ? portable::pow(inner_transmittance_at_normal, 1 / cosine_inside) : 0);
  SlabPower sum{0, 0};
  const double across = (cosine - index * cosine_inside) / (cosine + index * cosine_inside);
  const double along = (index * cosine - cosine_inside) / (index * cosine + cosine_inside);
  for (const double amplitude : {across, along}) {
    const double r = amplitude * amplitude;
    const double transmitted = (1 - r) * (1 - r) * t / (1 - r * r * t * t);
    sum.transmitted += transmitted / 2;
    sum.reflected += (r + r * transmitted * t) / 2;
  }
  return sum;
}

SlabPower stack(SlabPower one, int panes) {
  SlabPower all = one;
  for (int pane = 1; pane < panes; ++pane) {
    const double between = 1 - all.reflected * one.reflected;  // what runs to and fro between them
    all = {all.reflected + all.transmitted * all.transmitted * one.reflected / between,
           all.transmitted * one.transmitted / between};
  }
  return all;
}

double innerTransmittance(double index, double transmittance) {
  const double root = (index - 1) / (index + 1);
  const double r = root * root;
  // transmittance · (1 - r² t²) = (1 - r)² t, a quadratic in t whose positive root is at most 1 for a possible pane.
  const double a = transmittance * r * r;
  const double b = (1 - r) * (1 - r);
  return std::clamp(2 * transmittance / (b + std::sqrt(b * b + 4 * a * transmittance)), 0.0, 1.0);
}

}  // namespace standpoint

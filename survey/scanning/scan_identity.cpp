// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/scan_identity.h"

#include <cstring>
#include <span>

#include <fmt/format.h>

#include "core/random.h"

namespace standpoint {

namespace {

constexpr const char* kFieldFault = "mishap";  // its name in identities since the first file: it stays, so that they do

std::uint64_t mix(std::uint64_t hash, const std::string& text) { return stableHash(text.c_str(), hash); }

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 29U);
}

template <class T>
std::uint64_t mixAll(std::uint64_t hash, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  hash = mix(hash, static_cast<std::uint64_t>(bytes.size()));
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash = mix(hash, word);
  }
  return hash;
}

std::uint64_t mix(std::uint64_t hash, const Pose& pose) {
  hash = mixAll(hash, std::span<const double>(pose.rotation.coeffs().data(), 4));
  return mixAll(hash, std::span<const double>(pose.translation.data(), 3));
}

std::uint64_t mix(std::uint64_t hash, const Spectrum& spectrum) {
  for (const auto& [wavelength, fraction] : spectrum) hash = mix(hash, fmt::format("{} {}", wavelength, fraction));
  return mix(hash, static_cast<std::uint64_t>(spectrum.size()));
}

std::uint64_t mix(std::uint64_t hash, const PhysicalMaterial& m) {
  hash = mix(mix(mix(mix(hash, m.id), m.reflectance), m.transmittance), m.group_index);
  for (const auto& c : m.complex_index) hash = mix(hash, fmt::format("{} {} {}", c.wavelength_nm, c.n, c.k));
  // Of materials that have it: those without keep the identity that they had before there was one.
  if (m.surface_variation > 0) hash = mix(hash, fmt::format("surfaces {}", m.surface_variation));
  return mix(hash, fmt::format("{} {} {} {} {} {} {} {} {} {}", m.hemispherical, m.roughness_rad, m.gloss_slope,
                               m.index_of_refraction, m.thickness_m, m.panes, m.gap_m, m.variation, m.texture_scale_m,
                               m.retro_gain));
}

}  // namespace

std::uint64_t fingerprintOf(const ScanWorld& world) {
  const auto& e = *world.environment;
  std::uint64_t hash = stableHash("standpoint world");
  for (const auto& mesh : e.meshes) {
    for (const auto& p : mesh->positions) hash = mixAll(hash, std::span<const float>(p.data(), 3));
    for (const auto& t : mesh->triangles) hash = mixAll(hash, std::span<const std::uint32_t>(t.data(), 3));
    hash = mixAll(hash, std::span<const std::uint32_t>(mesh->surface_of_triangle));
  }
  for (const auto& i : e.instances) {
    hash = mix(mix(hash, i.mesh), i.product);
    hash = mixAll(hash, std::span<const double>(i.world_from_mesh.matrix().data(), 16));
  }
  for (const auto& p : e.products)
    hash = mix(mix(hash, p.id + p.global_id + p.ifc_class + p.name), static_cast<std::uint64_t>(p.inScene()));
  for (const auto& s : e.surfaces)
    hash = mix(hash, fmt::format("{} {} {} {}", s.colour.r, s.colour.g, s.colour.b, s.colour.a));
  for (const auto& body : world.bodies) {  // of worlds that have some
    hash = mixAll(hash, std::span<const std::uint32_t>(body.instances));
    for (int k = 0; k < 100; ++k) hash = mix(hash, body.local_from_rest->pose(0.61 * k));
  }
  for (const auto& m : world.assignment.materials) hash = mix(hash, m);
  for (const auto& s : world.assignment.surfaces)
    hash = mix(hash, fmt::format("{} {} {}", s.product, s.surface, s.material));
  for (const auto& f : world.assignment.faces) {
    hash = mix(hash, fmt::format("{} {} {}", f.product, f.surface, f.material));
    hash = mixAll(hash, std::span<const double>(f.direction.data(), 3));
    if (f.point) hash = mixAll(hash, std::span<const double>(f.point->data(), 3));
  }
  return hash;
}

std::string guidOf(std::uint64_t world_fingerprint, const Station& station, const Pose& believed,
                   const ScanRequest& request) {
  const auto& o = request.options;
  std::uint64_t a = stableHash("standpoint scan");
  a = mix(a, request.instrument.id);
  for (const auto& [key, value] : request.settings.values) a = mix(mix(a, key), value);
  a = mix(a, fmt::format("{} {} {} {} {} {}", o.seed, o.effects.bits(), station.name, o.channels.time,
                         o.channels.returns, o.channels.truth));
  const auto& w = o.weather;
  a = mix(a, fmt::format("{} {} {} {} {}", w.visibility_km, w.rain_mm_h, w.snow_mm_h, w.fog_mor_m, w.dust_mor_m));
  if (o.sun) a = mix(a, fmt::format("sun {} {} {}", o.sun->azimuth_rad, o.sun->elevation_rad, o.sun->irradiance_W_m2));
  if (o.interference > 0) a = mix(a, fmt::format("interference {}", o.interference));
  if (o.quality != ScanQuality::standard) a = mix(a, o.quality == ScanQuality::preview ? "preview" : "reference");
  if (request.panorama) a = mix(a, "panorama");
  if (!request.as.empty()) a = mix(a, request.as);  // a run that goes on takes no station that was written otherwise
  if (request.panorama_columns > 0) a = mix(a, std::uint64_t{request.panorama_columns});
  if (const auto& m = request.field_fault; m.any())
    a = mix(a, fmt::format("{} {} {} {} {} {}", kFieldFault, m.until_fraction, m.noise_factor,
                           m.tripod_moved_at_fraction.value_or(-1), m.passer_by_at_fraction.value_or(-1),
                           m.operator_at_fraction.value_or(-1)));
  if (const auto& m = request.field_fault;
      m.operator_at_fraction &&
      (m.operator_m != FieldFault::kOperator_m || m.operator_from_fraction > 0 || m.operator_until_fraction < 1))
    a = mix(a, fmt::format("operator {} {} {}", m.operator_m, m.operator_from_fraction, m.operator_until_fraction));
  for (const auto& note : request.notes) a = mix(a, note);
  std::uint64_t b = mix(mix(a, world_fingerprint), station.true_pose);
  b = mix(b, believed);
  return fmt::format("{{{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}}}", a >> 32U, (a >> 16U) & 0xFFFFU, a & 0xFFFU,
                     0x8000U | ((b >> 48U) & 0x3FFFU), b & 0xFFFFFFFFFFFFU);
}

std::string guidText(std::uint64_t a, std::uint64_t b) {
  return fmt::format("{{{:08x}-{:04x}-8{:03x}-8{:03x}-{:012x}}}", a >> 32U, (a >> 16U) & 0xFFFFU, (a >> 4U) & 0xFFFU,
                     a & 0xFFFU, b & 0xFFFFFFFFFFFFU);
}

}  // namespace standpoint

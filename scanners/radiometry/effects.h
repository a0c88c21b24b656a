// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.h"

namespace standpoint {

// What makes a scan differ from the geometry, each to be switched off alone. Without any of them a pulse returns the
// first surface on its axis, exactly, whatever it is made of.
enum class Effect : std::uint32_t {
  range_noise = 1U << 0U,    // white, by received power
  angle_noise = 1U << 1U,    // jitter of the two angles
  bias = 1U << 2U,           // systematic errors of range and angles, drawn once for a scan
  striping = 1U << 3U,       // noise that neighbours share: along a column, from column to column, the mirror's wobble
  detection = 1U << 4U,      // what sends back too little is lost
  chance = 1U << 5U,         // near that threshold a return is lost or found by chance
  near_range = 1U << 6U,     // the receiver does not see all that comes from close by
  atmosphere = 1U << 7U,     // extinction of the air
  weather = 1U << 8U,        // returns from drops, flakes, fog and dust
  footprint = 1U << 9U,      // the beam has a width: mixed points at edges
  panes = 1U << 10U,         // glass lets light pass
  mirrors = 1U << 11U,       // what is smooth shows mirror images
  variation = 1U << 12U,     // a material is not the same everywhere, nor on two surfaces
  saturation = 1U << 13U,    // too much light bends the range
  quantisation = 1U << 14U,  // the intensity is stored in steps
  levelling = 1U << 15U,     // the compensator's error: the file's pose is not the true one
  amplitude_noise = 1U << 16U,  // speckle, the pulse's energy and the receiver's own noise in the intensity
  filters = 1U << 17U,          // the instrument's own: points that they flag or drop
  ambiguity = 1U << 18U,        // a phase-shift instrument folds what is too far back to the front
  halo = 1U << 19U,             // the beam's wings meet retroreflectors beside it
  sun = 1U << 20U,              // daylight in the receiver
  interference = 1U << 21U,     // returns of another instrument's light
  rough_mirrors = 1U << 22U,    // mirror images in what is not quite smooth: wet ground, varnish
  textures = 1U << 23U,         // images on surfaces scale the reflectance of their materials
  range_offset = 1U << 24U,     // a range is longer for little light than for much
  incidence_noise = 1U << 25U,  // speckle moves the centre of a footprint on a slanted surface
  multipath = 1U << 26U,        // light from a corner's one surface to the other and back to a phase-shift receiver
};

class Effects {
 public:
  constexpr Effects() = default;  // all
  static constexpr Effects none() { return Effects(0); }
  constexpr bool has(Effect effect) const { return (bits_ & static_cast<std::uint32_t>(effect)) != 0; }
  constexpr Effects with(Effect effect) const { return Effects(bits_ | static_cast<std::uint32_t>(effect)); }
  constexpr Effects without(Effect effect) const { return Effects(bits_ & ~static_cast<std::uint32_t>(effect)); }
  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool operator==(const Effects&) const = default;

 private:
  explicit constexpr Effects(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = (1U << 27U) - 1;
};

struct EffectName {
  Effect effect;
  std::string_view name;         // "range-noise"
  std::string_view description;  // what is left out without it
};
const std::array<EffectName, 27>& effectNames();

std::string effectList();  // the names, separated by commas
// Everything but the listed ones: "striping,footprint". An unknown name is an error that lists the known ones.
Result<Effects> effectsWithout(std::string_view names);
// The effects that are left out, separated by commas: what effectsWithout reads.
std::string leftOut(Effects effects);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "scanners/instruments/instrument.h"
#include "scanners/radiometry/atmosphere.h"

namespace standpoint {

// What a pulse meets in the air. `x` as everywhere (radiometry.h), near-range factor and extinction included.
enum class ScattererKind : std::uint8_t { drop, flake, fog };
struct Scatterer {
  ScattererKind kind = ScattererKind::drop;
  double range_m = 0;
  double x = 0;
};

// False returns of a weather (physics.md §2.6). Drops and flakes are a Poisson process along the beam: only those are
// drawn that reach `least_x` where they are, so that a pulse costs one block of random numbers and seldom more. Fog and
// dust are too many to draw: what they send into each gate, as long as two ranges must be apart to be told apart, is
// the pulse's shape over the backscatter of the air, and the photons that are counted of it are a Poisson number. So a
// pulse may see what its neighbour does not, in whichever gate it counts most. The air is even: no drifting patches.
// Nothing nearer than the instrument's shortest range is reported. Immutable; keeps a reference to the instrument.
class Scatterers {
 public:
  // Photons that an instrument counts of a return at its threshold, in one pass: a signal-to-noise ratio of 7. No
  // source states it for any instrument; an engineering figure.
  static constexpr double kPhotonsAtThreshold = 50;

  // `passes`: pulses that are averaged at each place. `near_range`: the receiver does not see all that comes from close
  // by.
  Scatterers(const Instrument& instrument, const Weather& weather, double min_x, double max_range_m,
             const RandomKey& key, int passes = 1, bool near_range = true);

  // The strongest before `max_range_m` with at least `least_x` (not below that of the whole).
  std::optional<Scatterer> strongest(std::uint32_t column, std::uint32_t row, double max_range_m, double min_x) const;

  // The expected number of drops and flakes that reach the least x before this range.
  double expected(double max_range_m) const;

 private:
  // Cumulated expected number of what can be seen, at the nodes.
  struct Population {
    ScattererKind kind = ScattererKind::drop;
    DropSizes sizes;
    double backscatter = 0;  // F: share of what meets a drop's disc that comes back, as of a Lambert disc
    std::vector<double> number;
  };
  struct Gate {
    double from_m = 0;
    double x = 0;  // mean
  };

  double beamDiameter(double range_m) const;
  double white(double range_m) const;  // x of a white target that fills the beam
  // m; infinity: none is large enough. `white_x` is white() there.
  double leastDiameter(const Population& population, double range_m, double white_x) const;
  void count(Population& population) const;
  std::size_t nodeBefore(double range_m) const;
  double numberBefore(const Population& population, double range_m) const;
  double rangeOf(const Population& population, double number) const;
  void openGates(const Weather& weather, double max_range_m);
  double softPower(double range_m, double pulse_length_m, double backscatter_per_m) const;
  void drops(const Population& population, std::uint32_t column, std::uint32_t row, double max_range_m,
             Scatterer& best) const;
  void fog(std::uint32_t column, std::uint32_t row, double max_range_m, Scatterer& best) const;

  const Instrument& instrument_;
  RandomKey key_;
  double min_x_, extinction_per_m_;
  double photons_per_x_;
  bool near_range_;
  std::vector<double> nodes_m_;  // of equal ratio, from the shortest range on
  std::vector<Population> populations_;
  double gate_m_ = 0;
  std::vector<Gate> gates_;  // from which a count may reach the least x, in the order of their range
};

}  // namespace standpoint

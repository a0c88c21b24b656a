// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "scanners/engine/embree_scene.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

constexpr std::uint32_t kEight = 8;  // boxes or edges side by side

// In single precision. An empty box is met by nothing.
struct alignas(64) EightBoxes {
  float low[3][kEight], high[3][kEight];
  EightBoxes();
};

// In single precision. A missing edge has no length and lies far off.
struct alignas(64) EightEdges {
  float from[3][kEight], to[3][kEight];
  EightEdges();
};

// Up to sixteen beams in one frame, and what holds them as far as they go: a pyramid of four sides and an end, and all
// that is close to it. Beams that follow each other lie side by side, which a pyramid holds more closely than a cone.
class BeamPacket {
 public:
  explicit BeamPacket(const Instrument& instrument) : instrument_(instrument) {}

  // A beam of its own for each of the lanes; `farthest_coordinate_m`: of the edges that it is asked about.
  void set(std::uint32_t lanes, const BeamLanes& beams, double farthest_coordinate_m);
  // Of the lanes the first one and those that point to about the same side.
  std::uint32_t together(std::uint32_t lanes) const;
  // From here on it is asked about these lanes alone, as far as `reach_m`.
  void narrow(std::uint32_t lanes, double reach_m);

  Beam beam(std::uint32_t lane) const { return beams_.at(lane); }
  double reach_m() const { return reach_m_; }
  // Those of eight that may have a part in a beam, as bits.
  std::uint32_t meets(const EightBoxes& boxes) const;
  std::uint32_t meets(const EightEdges& edges) const;
  // The lanes whose beams an edge may be in, as bits; where it passes close by their origin, too.
  std::uint32_t near(const EightEdges& edges, std::uint32_t edge) const;

  struct alignas(64) Lanes {
    float origin[3][kPacket] = {}, direction[3][kPacket] = {}, across[3][kPacket] = {}, upward[3][kPacket] = {};
    float centre[3] = {};  // that origins are from
    float exit_m = 0, divergence_rad = 0;
  };
  struct Pyramid {
    static constexpr int kPlanes = 5;
    float normal[kPlanes][3] = {};        // of its planes, inward
    float least[kPlanes] = {};            // along them, of what it holds
    float apex[3] = {}, axes[3][3] = {};  // unit: across, upward and ahead
    float low[2] = {}, high[2] = {};      // across and upward, at unit distance ahead
    float aside_m = 0;                    // beside it
  };

 private:
  const Instrument& instrument_;
  BeamLanes beams_;
  std::uint32_t narrowed_ = 0;
  double reach_m_ = 0, rounding_m_ = 0;
  Lanes lanes_;
  Pyramid pyramid_;
};

}  // namespace standpoint

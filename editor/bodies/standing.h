// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/survey.h"
#include "editor/bodies/instrument_body.h"

namespace standpoint {

// An instrument on its tripod.
struct StandingInstrument {
  const InstrumentBody* body = nullptr;                          // of instrumentBodies()
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();            // where the beam leaves, local frame
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // of the scanner's frame, as it leans
  double height_m = 0;                                           // of the centre above the floor
  bool operator==(const StandingInstrument& other) const;
};
StandingInstrument standing(const Station& station, std::string_view instrument);

// A part of the vertical plane that the beam sweeps, as far as it reaches.
struct SweepFan {
  double azimuth_rad = 0;           // of its half plane in the scanner's frame, clockwise from X
  double from_rad = 0, to_rad = 0;  // elevations
  std::vector<float> ranges_m;      // at equal steps of elevation, at least two
  bool operator==(const SweepFan&) const = default;
};

using LampColour = std::array<std::uint8_t, 3>;

// What moves on an instrument while it works.
struct WorkingMotion {
  double head_rad = 0;               // turned clockwise, seen from above
  bool mirror_turns = false;         // too fast to be seen
  std::optional<LampColour> lamp;    // none: it is dark
  int ring_from = 0, ring_lit = 24;  // of the 24 segments of a ring
  std::vector<SweepFan> fans;
  bool operator==(const WorkingMotion&) const = default;
};
constexpr int kRingSegments = 24;

// The instrument of the desk: what stands with it at one of the stations, or is carried and stands nowhere.
struct HeldInstrument {
  std::string instrument;  // its id; empty: there is none
  std::string station;     // empty: nowhere
  WorkingMotion motion;
  bool moves = false;    // another picture is due at once
  bool carried = false;  // somebody has it in the hands: nothing stands at `station`
};

// From being taken down at one place until it stands at another, so far away: our own estimate, of somebody who walks
// with it, sets up, and levels on a tribrach.
double carryingTime_s(const InstrumentBody& body, double distance_m);

// All that stand in a scene, but for the desk's: that one works.
struct InstrumentsInScene {
  std::vector<StandingInstrument> still;
  bool operator==(const InstrumentsInScene&) const = default;
};
struct WorkingInstrument {
  StandingInstrument stands;
  WorkingMotion motion;
  bool operator==(const WorkingInstrument&) const = default;
};

constexpr double kInsideInstrument_m = 0.3;  // of its centre: whoever is nearer looks out of it

// Which stations have an instrument on them in a picture taken from `eye`: those nearest to it, but none that it is
// inside of. A station shows what the desk has on it, else what its newest scan was made with, else what would scan
// there: `planned`.
constexpr std::size_t kMostInstruments = 40;
struct StandingScene {
  std::shared_ptr<const InstrumentsInScene> still;  // the same pointer as long as nothing of it changes
  std::optional<WorkingInstrument> working;
};
class StandingKeeper {
 public:
  // `kept`: whether what has its centre there is in the picture.
  StandingScene of(const Job& job, const HeldInstrument& held, std::string_view planned, const Eigen::Vector3d& eye,
                   const std::function<bool(const Station&)>& kept);

 private:
  std::shared_ptr<const InstrumentsInScene> still_;
};

}  // namespace standpoint

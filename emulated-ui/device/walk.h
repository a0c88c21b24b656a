// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scanners/instruments/pace_limits.h"

namespace standpoint {

class Device;
struct FactRow;

// A way on foot: x and y in metres of the model's file, and seconds since it began. Between two places it is straight
// and even; who turns stands meanwhile.
using WalkedWay = std::vector<std::array<double, 3>>;

// A known point that the scanner was held over.
struct WalkFix {
  std::string point;
  double x_m = 0, y_m = 0, after_s = 0;
};

// What a carried scanner has seen so far, from above: the picture of its app while it is carried.
struct SeenMap {
  static constexpr std::uint8_t kFloor = 1, kCeiling = 2, kWall = 4;
  double x_m = 0, y_m = 0;  // of its corner, the model's file
  double cell_m = 0.25;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> cells;  // what was seen in each, row by row

  double floor_m2() const;
  double ceiling_m2() const;
  double bothShare() const;  // of what is floor or ceiling: where both were seen
};

struct WalkLeg {
  double x_m = 0, y_m = 0, speed_mps = 0;
};

// Somebody on foot with a scanner: where they are, where they go, and what the scanner has noted of it.
struct WalkState {
  std::optional<std::array<double, 2>> at;  // nothing: nobody has said where
  std::array<double, 2> ahead_of = {1, 0};  // unit: where they look
  std::vector<WalkLeg> legs;                // before them
  double speed_mps = 0, turn_radps = 0;     // just now
  bool put_down = false;                    // the scanner is on something flat, until they walk
  double rested_s = 0;                      // they stand, for so long
  bool rest_told = false;                   // the event of it came
  bool doors_open = false;                  // they were opened before
  bool scene = false;                       // what can be seen from there is known
  // Of the walk that is recorded, or was recorded last and is not processed.
  bool recording = false;
  double recorded_s = 0;
  WalkedWay way;
  std::vector<std::array<double, 2>> pauses;  // from and to, since it began
  std::vector<WalkFix> fixes;
  double hurried_s = 0;  // faster than the app wants it
  std::shared_ptr<const SeenMap> seen;
};

// What the office made of a walk, held against how it was.
struct WalkResult {
  WalkedWay way;
  double seconds = 0, length_m = 0;
  std::uint64_t closures = 0, held = 0;  // places that were recognised; points and stations that hold it
  // Each quarter of a second: x and y of the true place in the model's file, and the solved place less that, m.
  std::vector<std::array<double, 5>> errors;
  std::shared_ptr<const SeenMap> seen;  // as the app showed it last; null once the project was closed
};

// How fast somebody turns who walks at 1 m/s [P].
inline constexpr double kTurn_rad_per_m = 1.05;

// Too fast for the app, just now.
bool isHurried(const WalkState& walk, const PaceLimits& most);
// They go on for that long; what is recorded grows.
void walkOn(WalkState& walk, const PaceLimits& most, double seconds);
// In metres, without what is stood.
double lengthOf(const WalkedWay& way);

// What transitions of a carried scanner do.
void beginWalk(Device& device);  // from here on it is recorded
void pauseWalk(Device& device);  // points are not kept; it still knows where it is
void resumeWalk(Device& device);
void endWalk(Device& device);
void fixWalk(Device& device);   // at the known point in reach
void dropWalk(Device& device);  // what is not processed is gone
void orderScene(Device& device);
void orderWalk(Device& device);  // the office begins to process it
void storeWalk(Device& device);

const std::vector<FactRow>& walkFacts();

// The known point within reach of who carries the scanner; empty: none.
std::string pointInReach(const Device& device);
// From there to the nearest other one that was measured, in metres; nothing where there are not both.
std::optional<double> nearestFix_m(const Device& device);

}  // namespace standpoint

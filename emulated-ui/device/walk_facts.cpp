// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "emulated-ui/device/device.h"

namespace standpoint {

namespace {

constexpr double kTransfer_bytes_per_s = 60e6;  // [P] by cable
constexpr double kProcessing = 1;               // [P] of the walk's own time
constexpr double kNoFix_m = 1e6;

const WalkState& walk(const Device& d) { return d.state().walk; }
const WalkResult* result(const Device& d) {
  const auto* setup = d.shownSetup();
  return setup != nullptr && setup->walk ? &*setup->walk : nullptr;
}

double paused_s(const WalkState& w) {
  double seconds = 0;
  for (const auto& [from, to] : w.pauses) seconds += to - from;
  return seconds;
}

double bytes(const Device& d) {
  const auto& moving = d.type().instrument.moving;
  if (!moving) return 0;
  return std::max(0.0, walk(d).recorded_s - paused_s(walk(d))) * moving->points_per_s *
         d.type().definition.body.bytes_per_point;
}

// Where it began to where they are.
double gap_m(const WalkState& w) {
  if (w.way.empty() || !w.at) return 0;
  return std::hypot(w.at->front() - w.way.front()[0], w.at->back() - w.way.front()[1]);
}

double length_m(const WalkState& w) {
  const double since = w.recording && !w.way.empty() && w.at
                           ? std::hypot(w.at->front() - w.way.back()[0], w.at->back() - w.way.back()[1])
                           : 0;
  return lengthOf(w.way) + since;
}

bool isHurried(const Device& d) { return isHurried(walk(d), paceLimits(d.type().instrument)); }

std::string light(const Device& d) {
  const auto lamp = findPhase(d.type().definition, d.state().phase)->lamp;
  return walk(d).recording && isHurried(d) ? "red flashing" : lamp;
}

const FactDomain kEither{{"yes", "no"}};
FactDomain atMost(double most) { return {{}, true, 0, most}; }

}  // namespace

const std::vector<FactRow>& walkFacts() {
  static const std::vector<FactRow> rows = {
      {.name = "carried.placed",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(walk(d).at.has_value()); },
       .about = "somebody holds the scanner at a known place"},
      {.name = "carried.walking",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(!walk(d).legs.empty()); },
       .about = "who carries the scanner is on the way"},
      {.name = "carried.put_down",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(walk(d).put_down); },
       .about = "the scanner is on something flat"},
      {.name = "carried.rested",
       .unit = FactUnit::seconds,
       .domain = atMost(1e9),
       .value = [](const Device& d) { return numberFact(walk(d).rested_s); },
       .about = "how long who carries the scanner has been standing still"},
      {.name = "carried.hurried",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(isHurried(d)); },
       .about = "walking or turning too fast just now"},
      {.name = "carried.hurried_for",
       .unit = FactUnit::seconds,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(walk(d).hurried_s); },
       .about = "how long the walk was too fast"},
      {.name = "carried.light", .value = [](const Device& d) { return wordFact(light(d)); }, .about = "of the ring"},
      {.name = "carried.speed",
       .domain = atMost(100),
       .value = [](const Device& d) { return numberFact(std::round(walk(d).speed_mps * 100) / 100); },
       .about = "walking speed just now, in m/s"},
      {.name = "carried.turn",
       .unit = FactUnit::degrees,
       .domain = atMost(1e4),
       .value = [](const Device& d) { return numberFact(walk(d).turn_radps / kRadPerDeg); },
       .about = "turn rate just now, in degrees each second"},
      {.name = "carried.scene",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(walk(d).scene); },
       .about = "the scanner has found its surroundings"},
      {.name = "carried.unprocessed",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(!walk(d).recording && walk(d).way.size() > 1); },
       .about = "a recorded walk waits to be processed"},
      {.name = "carried.time",
       .unit = FactUnit::seconds,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(walk(d).recorded_s); },
       .about = "since recording began, with pauses"},
      {.name = "carried.length",
       .unit = FactUnit::metres,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(length_m(walk(d))); },
       .about = "recorded path"},
      {.name = "carried.gap",
       .unit = FactUnit::metres,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(gap_m(walk(d))); },
       .about = "from here to where the recorded path began"},
      {.name = "carried.floor",
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(walk(d).seen ? std::round(walk(d).seen->floor_m2()) : 0); },
       .about = "floor seen in the live map, in m²"},
      {.name = "carried.ceiling",
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(walk(d).seen ? std::round(walk(d).seen->ceiling_m2()) : 0); },
       .about = "ceiling seen in the live map, in m²"},
      {.name = "carried.both",
       .unit = FactUnit::fraction,
       .domain = atMost(1),
       .value = [](const Device& d) { return numberFact(walk(d).seen ? walk(d).seen->bothShare() : 0); },
       .about = "share of the live map's floors and ceilings where both were seen"},
      {.name = "carried.fixes",
       .domain = atMost(1e4),
       .value = [](const Device& d) { return numberFact(static_cast<double>(walk(d).fixes.size())); },
       .about = "known points measured on the path"},
      {.name = "carried.at_point",
       .domain = kEither,
       .value = [](const Device& d) { return yesNo(!pointInReach(d).empty()); },
       .about = "a known point is within reach"},
      {.name = "carried.nearest_fix",
       .unit = FactUnit::metres,
       .domain = atMost(kNoFix_m),
       .value = [](const Device& d) { return numberFact(nearestFix_m(d).value_or(kNoFix_m)); },
       .about = "from the known point within reach to the nearest other one measured; 1000000: there is none"},
      {.name = "carried.doors",
       .domain = {{"open", "closed"}},
       .value = [](const Device& d) { return wordFact(walk(d).doors_open ? "open" : "closed"); },
       .about = "whether doors were opened before the walk"},
      {.name = "carried.bytes",
       .unit = FactUnit::bytes,
       .domain = atMost(1e16),
       .value = [](const Device& d) { return numberFact(bytes(d)); },
       .about = "of the recorded walk"},
      {.name = "carried.transfer",
       .unit = FactUnit::seconds,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(5 + bytes(d) / kTransfer_bytes_per_s); },
       .about = "time to copy the walk to the office"},
      {.name = "carried.processing",
       .unit = FactUnit::seconds,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(20 + kProcessing * walk(d).recorded_s); },
       .about = "time to process it there"},
      {.name = "result.closures",
       .domain = atMost(1e6),
       .value =
           [](const Device& d) {
             return numberFact(result(d) == nullptr ? 0 : static_cast<double>(result(d)->closures));
           },
       .about = "places recognised in the processed walk"},
      {.name = "result.held",
       .domain = atMost(1e6),
       .value =
           [](const Device& d) { return numberFact(result(d) == nullptr ? 0 : static_cast<double>(result(d)->held)); },
       .about = "known points and static scans that hold the processed walk"},
      {.name = "result.length",
       .unit = FactUnit::metres,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(result(d) == nullptr ? 0 : result(d)->length_m); },
       .about = "of the processed walk"},
      {.name = "result.seconds",
       .unit = FactUnit::seconds,
       .domain = atMost(1e6),
       .value = [](const Device& d) { return numberFact(result(d) == nullptr ? 0 : result(d)->seconds); },
       .about = "of the processed walk"},
  };
  return rows;
}

}  // namespace standpoint

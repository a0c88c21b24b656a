// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/numbers.h"
#include "survey/scanning/field_fault.h"

namespace standpoint {

namespace {

using Event = EngineEvent;

constexpr double kUsualWalk_mps = 0.8, kSlowest_mps = 0.1, kFastest_mps = 3;
constexpr double kLevelled_deg = 0.01;  // what a careful hand reaches with the foot screws

Result<void> insertCard(Device& d, const std::string&) {
  auto& a = d.change().around;
  if (a.card_present) return failure(ErrorKind::usage, d.word("card_is_in"));
  a.card_present = true;
  d.fire(Event::card_inserted);
  return {};
}

Result<void> removeCard(Device& d, const std::string&) {
  if (d.type().definition.body.card_inside) return failure(ErrorKind::usage, d.word("card_is_inside"));
  auto& a = d.change().around;
  if (!a.card_present) return failure(ErrorKind::usage, d.word("card_absent"));
  a.card_present = false;
  d.fire(Event::card_removed);
  return {};
}

Result<void> lockCard(Device& d, const std::string&) {
  d.change().around.card_locked = true;
  return {};
}
Result<void> unlockCard(Device& d, const std::string&) {
  d.change().around.card_locked = false;
  return {};
}

// Another card, empty; what was on the first one is in the bag, and not lost.
Result<void> changeCard(Device& d, const std::string&) {
  auto& a = d.change().around;
  if (d.type().definition.body.card_inside) return failure(ErrorKind::usage, d.word("card_is_inside"));
  a.card_present = true;
  a.card_locked = false;
  a.card_used_bytes = 0;
  a.card_bytes = d.type().definition.body.card_bytes;
  d.fire(Event::card_inserted);
  return {};
}

Result<void> carryCard(Device& d, const std::string&) {
  if (d.type().definition.body.card_inside) return failure(ErrorKind::usage, d.word("card_is_inside"));
  if (d.state().around.card_present) return failure(ErrorKind::usage, d.word("take_card_out"));
  TransferOrder order{{}, "card"};
  for (const auto& p : d.state().projects)
    for (const auto& setup : p.setups) order.files.push_back(setup.file);
  if (order.files.empty()) return failure(ErrorKind::usage, d.word("nothing_to_transfer"));
  d.give(std::move(order));
  return {};
}

Result<void> changeBattery(Device& d, const std::string&) {
  if (d.on() && !d.state().around.mains) {
    d.fire(Event::battery_empty);  // it goes out while the battery is out
  }
  d.change().around.battery = 1;
  return {};
}

Result<void> plugIn(Device& d, const std::string&) {
  d.change().around.mains = true;
  d.change().around.battery = std::max(d.state().around.battery, 0.01);
  return {};
}
Result<void> unplug(Device& d, const std::string&) {
  d.change().around.mains = false;
  return {};
}

bool laserTurns(const Device& d) {
  const auto* phase = findPhase(d.type().definition, d.state().phase);
  return phase != nullptr && phase->laser;
}

// The foot screws: whoever turns them under a scan moves the instrument.
Result<void> turnScrews(Device& d, double x_deg, double y_deg) {
  auto& a = d.change().around;
  a.tilt_x_deg = x_deg;
  a.tilt_y_deg = y_deg;
  if (laserTurns(d)) d.fire(Event::tripod_moved);
  return {};
}

Result<void> level(Device& d, const std::string&) { return turnScrews(d, kLevelled_deg, -kLevelled_deg); }

// "x,y" in degrees.
Result<void> tiltTo(Device& d, const std::string& value) {
  const auto comma = value.find(',');
  const double x = std::strtod(value.c_str(), nullptr);
  const double y = comma == std::string::npos ? 0 : std::strtod(value.c_str() + comma + 1, nullptr);
  if (value.empty() || !(std::abs(x) <= 60 && std::abs(y) <= 60))
    return failure(ErrorKind::usage, "must be two tilts in degrees: x,y");
  return turnScrews(d, x, y);
}

Result<void> wipeOptics(Device& d, const std::string&) {
  d.change().around.dust = false;
  return {};
}

// The tripod is picked up and set down: while the laser turns that spoils the scan.
Result<void> standAt(Device& d, const std::string& station) {
  auto& a = d.change().around;
  if (a.station == station) return {};
  if (laserTurns(d)) {
    d.fire(Event::tripod_moved);
    return failure(ErrorKind::usage, d.word("moved_while_scanning"));
  }
  a.station = station;
  d.change().sighted.clear();
  d.change().orientation.reset();
  if (auto& accepted = d.change().accepted) accepted->carried_away = true;
  d.change().entries.erase("pointer");
  d.fire(Event::set_down);
  return {};
}

// Back to where the wireless link reaches.
Result<void> goNear(Device& d, const std::string&) {
  d.change().around.wlan = true;
  return {};
}

// Whoever stood before a target is asked to go away.
Result<void> clearView(Device& d, const std::string&) {
  d.change().around.targets_visible = true;
  return {};
}

// "2.5,90": metres from the scanner and degrees, clockwise from the zero of its circle; nothing: beside it.
Result<OperatorPlace> operatorPlace(const std::string& value) {
  OperatorPlace place;
  if (value.empty()) return place;
  const auto comma = std::min(value.find(','), value.size());
  const auto away = numberIn(std::string_view(value).substr(0, comma));
  place.azimuth_deg = comma < value.size() ? numberIn(std::string_view(value).substr(comma + 1)) : std::nullopt;
  const bool whole = away && *away >= FieldFault::kNearest_m && *away <= FieldFault::kFarthest_m &&
                     (comma == value.size() || (place.azimuth_deg && std::abs(*place.azimuth_deg) <= 360));
  if (!whole)
    return failure(ErrorKind::usage,
                   fmt::format("must be a distance of {:g} to {:g} m, with a direction in degrees behind it: 2.5,90",
                               FieldFault::kNearest_m, FieldFault::kFarthest_m));
  place.away_m = *away;
  return place;
}

// Beside the scanner, or behind it: also while it scans.
Result<void> standInView(Device& d, const std::string& value) {
  TRY_ASSIGN(const auto place, operatorPlace(value));
  d.change().around.operator_in_view = true;
  d.change().around.operator_place = place;
  if (laserTurns(d)) operatorComes(d);
  return {};
}
Result<void> stepBehind(Device& d, const std::string&) {
  d.change().around.operator_in_view = false;
  if (laserTurns(d)) operatorGoes(d);
  return {};
}

bool isCarried(const Device& d) { return d.type().instrument.moving.has_value(); }

// "4.5,3" or "4.5,3,0.8": a place, and how fast they go there. The first place is where they come from.
Result<void> walkTo(Device& d, const std::string& value) {
  if (!isCarried(d)) return failure(ErrorKind::usage, d.word("not_carried"));
  const auto numbers = numbersIn(value);
  const bool whole = numbers && (numbers->size() == 2 || numbers->size() == 3);
  const double speed_mps = whole && numbers->size() == 3 ? numbers->at(2) : kUsualWalk_mps;
  if (!whole || !(speed_mps >= kSlowest_mps && speed_mps <= kFastest_mps))
    return failure(ErrorKind::usage,
                   fmt::format("must be a place, and a speed of {:g} to {:g} m/s behind it: 4.5,3,0.8", kSlowest_mps,
                               kFastest_mps));
  auto& walk = d.change().walk;
  if (!walk.at) {
    walk.at = {numbers->at(0), numbers->at(1)};
  } else {
    walk.legs.push_back({numbers->at(0), numbers->at(1), speed_mps});
    walk.put_down = false;
  }
  if (d.in(PhaseId{"initialising"})) d.fire(Event::tripod_moved);
  return {};
}

Result<void> standStill(Device& d, const std::string&) {
  if (!isCarried(d)) return failure(ErrorKind::usage, d.word("not_carried"));
  d.change().walk.legs.clear();
  return {};
}

// On the floor, a table or its stand: stiller than any hand.
Result<void> putDown(Device& d, const std::string&) {
  if (auto stands = standStill(d, {}); !stands) return stands;
  d.change().walk.put_down = true;
  return {};
}

Result<void> openDoors(Device& d, const std::string&) {
  if (!isCarried(d)) return failure(ErrorKind::usage, d.word("not_carried"));
  auto& walk = d.change().walk;
  if (walk.recording) return failure(ErrorKind::usage, d.word("doors_too_late"));
  walk.doors_open = true;
  return {};
}

Result<void> closeCover(Device& d, const std::string&) {
  d.change().around.cover_open = false;
  return {};
}

Result<void> moveTripod(Device& d, const std::string&) {
  d.fire(Event::tripod_moved);
  return {};
}

double roomFor(const Device& d) { return d.expectedBytes() / 2; }

}  // namespace

const std::vector<HandRow>& handRows() {
  static const std::vector<HandRow> rows = {
      {"insert_card", "memory", "", insertCard},
      {"remove_card", "memory", "", removeCard},
      {"lock_card", "memory", "", lockCard},
      {"unlock_card", "memory", "", unlockCard},
      {"change_card", "memory", "", changeCard},
      {"carry_card", "memory", "", carryCard},
      {"change_battery", "power", "", changeBattery},
      {"plug_in", "power", "", plugIn},
      {"unplug", "power", "", unplug},
      {"stand_at", "tripod", "station", standAt},
      {"tilt", "tripod", "x,y in degrees", tiltTo},
      {"level", "tripod", "", level},
      {"tripod_moved", "tripod", "", moveTripod},
      {"walk_to", "walk", "x,y in metres, and the speed in m/s behind a comma; or nothing", walkTo},
      {"stand_still", "walk", "", standStill},
      {"put_down", "walk", "", putDown},
      {"open_doors", "walk", "", openDoors},
      {"wipe_optics", "around", "", wipeOptics},
      {"close_cover", "around", "", closeCover},
      {"clear_view", "around", "", clearView},
      {"go_near", "around", "", goNear},
      {"step_behind", "around", "", stepBehind},
      {"stand_in_view", "around", "distance in metres, and the direction in degrees behind a comma; or nothing",
       standInView},
  };
  return rows;
}

const std::vector<TroubleRow>& troubleRows() {
  static const std::vector<TroubleRow> rows = {
      {"battery_low",
       [](Device& d) {
         d.change().around.battery = d.type().definition.body.battery_warning * 0.9;
         d.fire(Event::battery_low);
       }},
      {"battery_critical",
       [](Device& d) {
         d.change().around.battery = d.type().definition.body.battery_critical * 0.9;
         d.fire(Event::battery_critical);
       }},
      {"card_full", [](Device& d) { d.change().around.card_used_bytes = d.state().around.card_bytes - roomFor(d); }},
      {"card_missing",
       [](Device& d) {
         if (d.type().definition.body.card_inside) return;
         d.change().around.card_present = false;
         d.fire(Event::card_removed);
       }},
      {"card_locked", [](Device& d) { d.change().around.card_locked = true; }},
      {"dust", [](Device& d) { d.change().around.dust = true; }},
      {"tripod_moved", [](Device& d) { d.fire(Event::tripod_moved); }},
      {"blocked", [](Device& d) { d.fire(Event::blocked); }},
      {"too_hot",
       [](Device& d) {
         d.change().around.temperature_c = d.type().definition.body.hottest_c + 5;
         d.fire(Event::temperature);
       }},
      {"too_cold",
       [](Device& d) {
         d.change().around.temperature_c = d.type().definition.body.coldest_c - 5;
         d.fire(Event::temperature);
       }},
      {"overheated",
       [](Device& d) {
         d.change().around.temperature_c = d.type().definition.body.hottest_c + 15;
         d.fire(Event::temperature);
       }},
      {"not_warm", [](Device& d) { d.change().around.acclimatised_s = 0; }},
      {"tilted",  // out of what is compensated in full; once more, out of what the instrument bears at all
       [](Device& d) {
         const auto& body = d.type().definition.body;
         const bool leans = d.tilt() > body.tilt_full_deg;
         d.change().around.tilt_x_deg = std::max(body.tilt_full_deg * 1.3, leans ? body.tilt_limit_deg * 1.05 : 0.0);
         d.fire(Event::tilted);
       }},
      {"tracking_lost",
       [](Device& d) {
         d.change().around.tracking = false;
         d.fire(Event::tracking_lost);
       }},
      {"wlan_lost",
       [](Device& d) {
         d.change().around.wlan = false;
         d.fire(Event::wlan_lost);
       }},
      {"target_hidden", [](Device& d) { d.change().around.targets_visible = false; }},
      {"symmetrical_room", [](Device& d) { d.change().values["false_start"] = "180"; }},  // degrees
      {"registration_fails", [](Device& d) { d.change().around.registration_fails = true; }},
      {"passer_by",
       [](Device& d) {
         if (laserTurns(d) && d.state().running) return somebodyWalksBy(d);
         d.change().around.passer_by = true;
       }},
      {"cover_open", [](Device& d) { d.change().around.cover_open = true; }},
      {"too_near", [](Device& d) { d.change().around.nearest_m = 0.3; }},
  };
  return rows;
}

}  // namespace standpoint

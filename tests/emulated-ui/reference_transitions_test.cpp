// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include "tests/emulated-ui/working.h"

namespace standpoint {
namespace {

using Change = std::function<void(Device&)>;
using Look = std::function<testing::AssertionResult(Device&)>;

// A row of the tables of transitions in the instrument facts, section 2: in a phase comes an event, and a phase, a
// dialogue and an effect follow. Under `unless` its guard does not hold, and it leads elsewhere.
struct ReferenceRow {
  const char* id;  // section, and the row of its table
  const char* device;
  const char* instrument;
  const char* from;
  const char* event;
  Change given;
  const char* to;
  const char* dialog = "";
  Look effect = nullptr;
  Change unless = nullptr;
};

void nothing(Device&) {}

Change around(void (*change)(Surroundings&)) {
  return [change](Device& d) { change(d.change().around); };
}
Change with(const char* key, const char* value) {
  return [key, value](Device& d) {
    const auto adapted = adaptedSettings(d.type().instrument, d.state().settings, key, value);
    ASSERT_TRUE(adapted && d.setSettings(*adapted)) << key << "=" << value;
  };
}
Change having(const char* value, const char* is) {
  return [value, is](Device& d) { d.change().values[value] = is; };
}
Change entered(const char* entry, const char* is) {
  return [entry, is](Device& d) { d.change().entries[entry] = is; };
}
Change all(const std::vector<Change>& changes) {
  return [changes](Device& d) {
    for (const auto& change : changes) change(d);
  };
}
void cardOut(Surroundings& a) { a.card_present = false; }
void cardFull(Surroundings& a) { a.card_used_bytes = a.card_bytes; }
void cardLocked(Surroundings& a) { a.card_locked = true; }
void empty(Surroundings& a) { a.battery = 0.01; }
void wayLost(Surroundings& a) { a.tracking = false; }
template <int Degrees>
void leaning(Surroundings& a) {
  a.tilt_x_deg = Degrees;
}
void noProject(Device& d) { d.change().project = -1; }

StoredSetup third(const Device& d) {
  StoredSetup setup;
  setup.project = "House";
  setup.number = 3;
  setup.name = "Setup 3";
  setup.station = "S1";
  setup.file = "Setup 3.e57";
  setup.settings = d.state().settings;
  setup.points = 1000000;
  setup.bytes = 1e7;
  return setup;
}
void runs(Device& d) {
  d.change().running = ScanOrder{};
  d.change().running->number = 3;
  d.change().running->name = "Setup 3";
  d.change().laser_s = 10;
}
void measured(Device& d) {
  runs(d);
  d.change().data = third(d);
}
// So many known targets, picked from a station that looks along X.
Change sighting(int n) {
  return [n](Device& d) {
    auto& s = d.change();
    const Eigen::Vector3d station(1, 2, 1.7);
    s.control.targets = {{"T1", {6, 2, 1}}, {"T2", {1, 8, 2}}, {"T3", {-4, 1, 1.5}}, {"T4", {2, -5, 3}}};
    for (int i = 0; i < n; ++i) {
      const auto& known = s.control.targets[static_cast<std::size_t>(i)];
      s.sighted.push_back({known.name, known.place_m - station, 5, 0.001, 90, true});
    }
  };
}
Change linkedWith(double error_m, double overlap, bool joined = true) {
  return [=](Device& d) {
    d.change().linking = d.newestSetup()->file;
    d.linkDone({joined, error_m, overlap, 0, 0});
  };
}

Look fact(const char* name, const char* value) {
  return [=](Device& d) -> testing::AssertionResult {
    const auto found = d.fact(name);
    if (found && found->text == value) return testing::AssertionSuccess();
    return testing::AssertionFailure() << name << " is " << (found ? found->text : "nothing") << ", not " << value;
  };
}
Look lamp(const char* is) {
  return [=](Device& d) -> testing::AssertionResult {
    const auto& lit = findPhase(d.type().definition, d.state().phase)->lamp;
    if (lit == is) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "the lamp is " << lit;
  };
}
Look says(const char* what, bool holds(Device&)) {
  return [=](Device& d) -> testing::AssertionResult {
    return holds(d) ? testing::AssertionSuccess() : testing::AssertionFailure() << what;
  };
}
Look on(const char* screen) { return fact("screen", screen); }
// What follows from there.
Look then(const char* event, const char* phase, const Look& effect = nullptr) {
  return [=](Device& d) -> testing::AssertionResult {
    (void)d.takeOrder();
    if (!d.fire(event)) return testing::AssertionFailure() << event << " means nothing";
    if (d.state().phase != phase) return testing::AssertionFailure() << event << " led to " << d.state().phase;
    return effect ? effect(d) : testing::AssertionSuccess();
  };
}
Look both(const Look& a, const Look& b) {
  return [=](Device& d) {
    auto first = a(d);
    return first ? b(d) : first;
  };
}

bool isListed(Device& d) { return d.project()->setups.size() == 3 && d.state().shown == 2; }
bool isDropped(Device& d) { return !d.state().running && d.project()->setups.size() == 2; }
bool isUnlevelled(Device& d) { return d.state().running && !d.state().running->compensator; }
bool isReserved(Device& d) { return d.state().running && d.state().running->number == 3; }
bool isCut(Device& d) { return d.state().running && d.state().running->until_fraction < 1; }
bool wasPushed(Device& d) { return d.state().moved && d.state().running->tripod_moved_at_fraction; }
bool isLinking(Device& d) {
  const auto order = d.takeOrder();
  return order && std::holds_alternative<LinkOrder>(*order);
}
bool linksNothing(Device& d) { return !d.takeOrder(); }
bool spinsUpForEightToTenSeconds(Device& d) {
  const auto seconds = findPhase(d.type().definition, "spin_up")->lasts_s.value_or(0);
  return seconds >= 8 && seconds <= 10;
}
bool shootsForAMinute(Device& d) { return d.expected().imaging_seconds == 60; }

Look partial(const char* g1) { return both(fact("error", g1), fact("data.state", "Partial")); }

constexpr const char* kFocus = "faro-focus";
constexpr const char* kRtc = "leica-rtc360";
constexpr const char* kBlk = "leica-blk360";
constexpr const char* kFirstBlk = "leica-blk360-g1";
constexpr const char* kSecondBlk = "leica-blk360-g2";
constexpr const char* kP = "leica-p-series";
constexpr const char* kX7 = "trimble-x7";
constexpr const char* kVz = "riegl-vz-i";

// An event of the name of a widget is pressed on its screen: "new_project/create".
const std::vector<ReferenceRow>& referenceRows() {
  static const std::vector<ReferenceRow> rows = {
      {"2.1/1", kFocus, "", "off", "power_key", nothing, "booting", "", lamp("blue flashing"), around(empty)},
      {"2.1/2", kFocus, "", "booting", "elapsed", nothing, "idle", "", both(lamp("blue"), on("home"))},
      {"2.1/3", kFocus, "", "idle", "start", nothing, "spin_up", "", lamp("red flashing"), around(empty)},
      {"2.1/3", kFocus, "", "idle", "start", nothing, "spin_up", "", nullptr,
       around([](Surroundings& a) { a.temperature_c = 45; })},
      {"2.1/4", kFocus, "", "idle", "start", around(cardOut), "idle", "card_absent"},
      {"2.1/4", kFocus, "", "idle", "start", around(cardFull), "idle", "card_full"},
      {"2.1/4", kFocus, "", "idle", "start", around(cardLocked), "idle", "card_locked"},
      {"2.1/5", kFocus, "", "idle", "start", around(leaning<3>), "idle", "tilt_question",
       then("start_anyway", "spin_up", says("3° are levelled", [](Device& d) { return !isUnlevelled(d); }))},
      {"2.1/5", kFocus, "", "idle", "start", around(leaning<6>), "idle", "tilt_question",
       then("start_anyway", "spin_up", says("6° are not levelled", isUnlevelled))},
      {"2.1/6", kFocus, "", "spin_up", "elapsed", runs, "scanning", "", says("8 to 10 s", spinsUpForEightToTenSeconds)},
      {"2.1/7", kFocus, "", "scanning", "elapsed", runs, "saving", "", nullptr, with("colour", "on")},
      {"2.1/8", kFocus, "", "scanning", "elapsed", all({runs, with("colour", "on")}), "photographing"},
      {"2.1/9", kFocus, "", "scanning", "stop", runs, "scanning", "stop_question",
       then("stop_confirmed", "idle", says("the part is dropped", isDropped))},
      {"2.1/9", kFocus, "", "scanning", "stop", runs, "scanning", "stop_question",
       then("keep_partial", "saving", says("the part is kept", isCut))},
      {"2.1/10", kFocus, "", "photographing", "elapsed", runs, "saving"},
      {"2.1/11", kFocus, "", "saving", "elapsed", measured, "idle", "", says("it is stored", isListed), runs},
      {"2.1/12", kFocus, "", "scanning", "battery_critical", runs, "saving", "battery_critical",
       says("a part is kept", isCut)},
      {"2.1/12", kFocus, "", "photographing", "battery_critical", runs, "saving", "battery_critical"},
      {"2.1/12", kFocus, "", "saving", "elapsed", all({measured, around(empty)}), "idle", "battery_shut_down",
       then("shut_down", "shutting_down")},
      {"2.1/13", kFocus, "", "idle", "power_key", nothing, "idle", "shut_down",
       then("shut_down", "shutting_down", lamp("blue flashing"))},
      {"2.1/14", kFocus, "", "shutting_down", "elapsed", nothing, "off"},

      {"2.2/1", kRtc, "", "off", "power_key", nothing, "booting", "", nullptr, around(empty)},
      {"2.2/2", kRtc, "", "booting", "elapsed", nothing, "idle", "", on("home")},
      {"2.2/3", kRtc, "", "idle", "start", nothing, "scanning_pass_1", "", says("number", isReserved),
       around(leaning<7>)},
      {"2.2/4", kRtc, "", "idle", "start", around(cardOut), "idle", "card_absent"},
      {"2.2/4", kRtc, "", "idle", "start", around(cardFull), "idle", "card_full"},
      {"2.2/5", kRtc, "", "scanning_pass_1", "elapsed", all({runs, with("double_scan", "on")}), "scanning_pass_2", "",
       nullptr, runs},
      {"2.2/6", kRtc, "", "scanning_pass_1", "elapsed", runs, "photographing"},
      {"2.2/6", kRtc, "", "scanning_pass_2", "elapsed", all({runs, with("double_scan", "on")}), "photographing"},
      {"2.2/7", kRtc, "", "scanning_pass_1", "elapsed", all({measured, with("images", "off")}), "storing"},
      {"2.2/7", kRtc, "", "scanning_pass_2", "elapsed",
       all({measured, with("images", "off"), with("double_scan", "on")}), "storing"},
      {"2.2/8", kRtc, "", "photographing", "elapsed", measured, "storing", "", says("60 s", shootsForAMinute)},
      {"2.2/9", kRtc, "", "storing", "elapsed", measured, "vis_tracking", "", says("it is listed", isListed)},
      {"2.2/10", kRtc, "", "vis_tracking", "set_down", nothing, "idle", "link_proposed"},
      {"2.2/11", kRtc, "", "vis_tracking", "set_down", around(wayLost), "idle", "link_lost",
       says("no link", linksNothing)},
      {"2.2/11", kRtc, "", "storing", "elapsed", all({measured, having("vis", "off")}), "idle", "",
       says("no link", linksNothing)},
      {"2.2/12", kRtc, "", "scanning_pass_1", "stop", runs, "scanning_pass_1", "stop_question",
       then("stop_confirmed", "idle", says("discarded", isDropped))},
      {"2.2/12", kRtc, "", "scanning_pass_2", "stop", runs, "scanning_pass_2", "stop_question",
       then("stop_confirmed", "idle", says("discarded", isDropped))},
      {"2.2/12", kRtc, "", "photographing", "stop", runs, "photographing", "stop_question",
       then("stop_confirmed", "idle", says("discarded", isDropped))},
      {"2.2/13", kRtc, "", "scanning_pass_1", "tripod_moved", runs, "error", "tripod_moved",
       says("flagged", wasPushed)},
      {"2.2/13", kRtc, "", "scanning_pass_2", "tripod_moved", runs, "error", "tripod_moved",
       says("flagged", wasPushed)},
      {"2.2/13", kRtc, "", "photographing", "tripod_moved", runs, "error", "tripod_moved", says("flagged", wasPushed)},

      {"2.3/1", kBlk, kFirstBlk, "ready", "key", nothing, "self_timer", "",
       then("elapsed", "shooting", fact("operation", "Standalone"))},
      {"2.3/2", kBlk, kFirstBlk, "connected", "start", having("connection", "OK"), "shooting", "",
       both(fact("operation", "PanoramaShoot"), then("elapsed", "scanning", fact("operation", "PointCloudScan")))},
      {"2.3/3", kBlk, kFirstBlk, "scanning", "elapsed", measured, "storing", "",
       then("elapsed", "ready", both(fact("device.state", "Idle"), fact("data.state", "Complete")))},
      {"2.3/4", kBlk, kFirstBlk, "scanning", "tripod_moved", runs, "error", "", partial("Device_Moved")},
      {"2.3/5", kBlk, kFirstBlk, "scanning", "blocked", runs, "error", "", partial("Device_Blocked")},
      {"2.3/6", kBlk, kFirstBlk, "ready", "battery_low", nothing, "error", "", fact("error", "Low_Battery")},
      {"2.3/6", kBlk, kFirstBlk, "self_timer", "battery_low", nothing, "error", "", fact("error", "Low_Battery")},
      {"2.3/6", kBlk, kFirstBlk, "scanning", "battery_low", runs, "error", "", fact("error", "Low_Battery")},
      {"2.3/6", kBlk, kFirstBlk, "ready", "key", around([](Surroundings& a) { a.battery = 0.08; }), "error", "",
       fact("error", "Low_Battery"), around([](Surroundings& a) { a.battery = 0.08, a.mains = true; })},
      {"2.3/7", kBlk, kFirstBlk, "ready", "key", around(cardFull), "error", "", fact("error", "Storage_Exceeded")},
      {"2.3/7", kBlk, kFirstBlk, "connected", "start", around(cardFull), "error", "",
       fact("error", "Storage_Exceeded")},
      {"2.3/8", kBlk, kFirstBlk, "ready", "temperature", around([](Surroundings& a) { a.temperature_c = 0; }), "error",
       "", fact("error", "Temp_Low")},
      {"2.3/8", kBlk, kFirstBlk, "scanning", "temperature",
       all({runs, around([](Surroundings& a) { a.temperature_c = 43; })}), "error", "", fact("error", "Temp_High")},
      {"2.3/8", kBlk, kFirstBlk, "self_timer", "temperature", around([](Surroundings& a) { a.temperature_c = 43; }),
       "error", "", fact("error", "Temp_High")},
      {"2.3/8", kBlk, kFirstBlk, "connected", "temperature", around([](Surroundings& a) { a.temperature_c = 60; }),
       "fatal", "", fact("error", "Temp_Critical")},
      {"2.3/9", kBlk, kFirstBlk, "error", "acknowledge", nothing, "ready", "", fact("device.state", "Idle")},

      {"2.3/10", kBlk, kSecondBlk, "ready", "key", having("self_timer", "0"), "shooting", "", lamp("white spinning"),
       all({having("self_timer", "0"), around(empty)})},
      {"2.3/10", kBlk, kSecondBlk, "connected", "start", nothing, "shooting", "", fact("capture", "InProgress"),
       around(cardFull)},
      {"2.3/10", kBlk, kSecondBlk, "connected", "start", nothing, "shooting", "", nullptr,
       around([](Surroundings& a) { a.temperature_c = 60; })},
      {"2.3/11", kBlk, kSecondBlk, "storing", "elapsed", measured, "ready", "",
       both(fact("capture", "Completed"), says("it is listed", isListed))},
      {"2.3/12", kBlk, kSecondBlk, "scanning", "stop_confirmed", runs, "ready", "", fact("capture", "Cancelled")},
      {"2.3/13", kBlk, kSecondBlk, "scanning", "blocked", runs, "error", "",
       both(fact("capture", "Aborted"), fact("error.action", "Acknowledge"))},
      {"2.3/14", kBlk, kSecondBlk, "storing", "elapsed", measured, "ready", "", says("it is linked", isLinking)},
      {"2.3/14", kBlk, kSecondBlk, "connected", "linked", linkedWith(0.002, 0.5), "connected", "link_joined",
       fact("vis.accuracy", "Accurate")},
      {"2.3/14", kBlk, kSecondBlk, "connected", "linked", linkedWith(0.03, 0.5), "connected", "link_joined",
       fact("vis.accuracy", "Inaccurate")},

      {"2.4/1", kP, "", "idle", "setup_station", nothing, "idle", "", on("station_setup")},
      {"2.4/1", kP, "", "idle", "setup_station", noProject, "idle", "no_project"},
      {"2.4/2", kP, "", "idle", "solve", all({having("method", "resection_6"), sighting(3)}), "idle", "",
       both(on("station_result"), then("accept", "idle", fact("orientation.accepted", "yes")))},
      {"2.4/2", kP, "", "idle", "solve", all({having("method", "resection_6"), sighting(2)}), "idle", "needs_three"},
      {"2.4/3", kP, "", "idle", "solve", all({having("method", "resection_4"), sighting(2)}), "idle", "",
       both(on("station_result"), then("accept", "idle", fact("orientation.accepted", "yes")))},
      {"2.4/3", kP, "", "idle", "solve", all({having("method", "resection_4"), sighting(1)}), "idle", "needs_two"},
      {"2.4/3", kP, "", "idle", "solve",
       all({having("method", "resection_4"), sighting(2), having("compensator", "off")}), "idle", "needs_compensator"},
      {"2.4/4", kP, "", "idle", "solve", having("method", "standard"), "idle", "station_local",
       fact("orientation.local", "yes")},
      {"2.4/5", kP, "", "idle", "start", nothing, "idle", "no_setup_question", then("start_anyway", "scanning")},
      {"2.4/5", kP, "", "idle", "start", around([](Surroundings& a) { a.tilt_x_deg = 5.1 / 60; }), "idle",
       "level_question"},
      {"2.4/5", kP, "", "idle", "start", around(cardFull), "idle", "card_full"},
      {"2.4/5", kP, "", "idle", "start", around(empty), "idle", "battery_critical"},
      {"2.4/6", kP, "", "scanning", "elapsed", runs, "imaging", "", nullptr, all({runs, with("images", "off")})},
      {"2.4/7", kP, "", "scanning", "tilted", runs, "paused", "compensator_question",
       then("continue_unlevelled", "scanning", says("flagged", isUnlevelled))},
      {"2.4/7", kP, "", "imaging", "tilted", runs, "paused", "compensator_question",
       then("continue_unlevelled", "imaging", says("flagged", isUnlevelled))},
      {"2.4/7", kP, "", "scanning", "tilted", runs, "paused", "compensator_question",
       then("stop_confirmed", "idle", says("dropped", isDropped))},
      {"2.4/8", kP, "", "imaging", "elapsed", measured, "storing", "",
       then("elapsed", "idle", says("it is listed", isListed))},
      {"2.4/8", kP, "", "scanning", "elapsed", all({measured, with("images", "off")}), "storing"},
      {"2.4/9", kP, "", "idle", "pick", entered("picked", "T1"), "searching_target", "",
       then("sighted", "searching_target", then("elapsed", "idle", on("target_result")))},

      {"2.5/1", kX7, "", "idle", "new_project/create", all({entered("first", "7"), entered("name", "Flat")}), "idle",
       "", both(on("map_view"), fact("project.first", "7"))},
      {"2.5/1", kX7, "", "idle", "new_project/create", all({entered("first", "7"), entered("name", "A|B")}), "idle",
       "refused"},
      {"2.5/2", kX7, "", "disconnected", "connect", nothing, "connecting", "", then("elapsed", "idle"),
       around([](Surroundings& a) { a.wlan = false; })},
      {"2.5/3", kX7, "", "idle", "start", nothing, "calibrating", "", nullptr, around(cardFull)},
      {"2.5/3", kX7, "", "idle", "start", nothing, "calibrating", "", nullptr, around(empty)},
      {"2.5/4", kX7, "", "calibrating", "elapsed", nothing, "levelling", "", nullptr, having("self_levelling", "off")},
      {"2.5/5", kX7, "", "levelling", "elapsed", around(leaning<9>), "scanning"},
      {"2.5/5", kX7, "", "levelling", "elapsed", around(leaning<11>), "not_level", "not_level_question",
       then("scan_unlevelled", "scanning", says("not survey grade", isUnlevelled))},
      {"2.5/5", kX7, "", "levelling", "elapsed", around(leaning<46>), "idle", "tilt_refused"},
      {"2.5/6", kX7, "", "scanning", "elapsed", runs, "imaging", "", nullptr, all({runs, with("images", "off")})},
      {"2.5/7", kX7, "", "imaging", "elapsed", runs, "downloading"},
      {"2.5/7", kX7, "", "scanning", "elapsed", all({runs, with("images", "off")}), "downloading"},
      {"2.5/8", kX7, "", "downloading", "elapsed", measured, "registering", "", says("it is linked", isLinking),
       all({measured, having("auto_registration", "off")})},
      {"2.5/9", kX7, "", "registering", "elapsed", linkedWith(0.002, 0.8), "idle", "",
       fact("registration", "registered")},
      {"2.5/10", kX7, "", "registering", "elapsed", linkedWith(0.007, 0.8), "idle", "check_by_eye",
       fact("registration", "check")},
      {"2.5/11", kX7, "", "registering", "elapsed", linkedWith(0.02, 0.8), "idle", "not_registered",
       fact("registration", "failed")},
      {"2.5/11", kX7, "", "registering", "elapsed",
       all({[](Device& d) { d.newestSetup()->lean_x_deg = 5.1; }, linkedWith(0.002, 0.8)}), "idle", "tilt_difference",
       fact("registration", "failed")},

      {"2.6/1", kVz, "", "unavailable", "power_key", nothing, "booting", "", then("elapsed", "waiting")},
      {"2.6/2", kVz, "", "waiting", "scan", nothing, "scanning", "", says("number", isReserved), noProject},
      {"2.6/2", kVz, "", "storing", "elapsed", all({measured, having("registration", "off")}), "waiting", "",
       fact("setup.next", "4")},
      {"2.6/3", kVz, "", "storing", "elapsed", measured, "processing", "", says("it is linked", isLinking),
       all({measured, having("registration", "off")})},
      {"2.6/4", kVz, "", "processing", "elapsed", linkedWith(0.002, 0.8), "waiting", "",
       fact("registration.result", "ok")},
      {"2.6/5", kVz, "", "processing", "elapsed", linkedWith(0, 0, false), "waiting", "fast_reg_failed"},
      {"2.6/5", kVz, "", "processing", "elapsed", linkedWith(0.5, 0.8), "waiting", "scan_reg_failed"},
  };
  return rows;
}

Device deviceOf(const ReferenceRow& row, const std::string& screen) {
  auto type = loadDevice(*findDevice(row.device), row.instrument);
  EXPECT_TRUE(type) << describe(type.error());
  const auto* phase = findPhase((*type)->definition, row.from);
  EXPECT_NE(phase, nullptr) << row.from;
  return working(*type, *phase, screen.empty() ? phase->screen : screen);
}

void come(const ReferenceRow& row, Device& d) {
  const std::string event = row.event;
  const auto slash = event.find('/');
  if (slash != std::string::npos)
    EXPECT_TRUE(d.act(event.substr(slash + 1)));
  else
    EXPECT_TRUE(d.fire(event)) << "it means nothing";
}

std::string screenOf(const ReferenceRow& row) {
  const std::string event = row.event;
  return event.find('/') == std::string::npos ? "" : event.substr(0, event.find('/'));
}

class ReferenceTransitions : public testing::TestWithParam<std::size_t> {
 protected:
  const ReferenceRow& row() const { return referenceRows()[GetParam()]; }
};

TEST_P(ReferenceTransitions, LeadWhereTheReferenceSays) {
  auto d = deviceOf(row(), screenOf(row()));
  row().given(d);
  come(row(), d);
  EXPECT_EQ(d.state().phase, row().to);
  EXPECT_EQ(d.state().dialog, row().dialog);
  if (row().effect) {
    EXPECT_TRUE(row().effect(d));
  }
}

TEST_P(ReferenceTransitions, LeadElsewhereWhereTheGuardDoesNotHold) {
  if (!row().unless) return;
  auto d = deviceOf(row(), screenOf(row()));
  row().unless(d);
  (void)d.fire(row().event);
  EXPECT_NE(d.state().phase, row().to);
}

std::string rowTitle(const testing::TestParamInfo<std::size_t>& info) {
  const auto& row = referenceRows()[info.param];
  std::string name = std::string(row.id) + "_" + row.from + "_" + row.event + "_" + std::to_string(info.param);
  const auto odd = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; };
  std::replace_if(name.begin(), name.end(), odd, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, ReferenceTransitions, testing::Range<std::size_t>(0, referenceRows().size()), rowTitle);

// 14 of the Focus, 13 of the RTC360, 14 of the BLK360, 9 of the P-series, 11 of the X7, 5 of the VZ-i.
TEST(ReferenceTransitionsList, HoldsEachOfTheSixtySix) {
  std::vector<std::string> ids;
  for (const auto& row : referenceRows())
    if (std::find(ids.begin(), ids.end(), row.id) == ids.end()) ids.emplace_back(row.id);
  std::vector<std::string> expected;
  const std::vector<std::pair<std::string, int>> tables = {{"2.1", 14}, {"2.2", 13}, {"2.3", 14},
                                                           {"2.4", 9},  {"2.5", 11}, {"2.6", 5}};
  for (const auto& [section, rows] : tables)
    for (int i = 1; i <= rows; ++i) expected.push_back(section + "/" + std::to_string(i));
  EXPECT_EQ(ids, expected);
}

}  // namespace
}  // namespace standpoint

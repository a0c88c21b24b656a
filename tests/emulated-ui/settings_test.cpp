// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scanners/camera/panorama.h"
#include "scanners/instruments/chosen_effect.h"
#include "tests/emulated-ui/working.h"

// Every setting has its effect, or its help says that it has none. Whoever adds one that nothing reads fails here.
namespace standpoint {
namespace {

const char* const kExcuse = "no effect in the emulation";  // in the English help

// --- settings of the scanner: what a scan with them does ---

std::string scanOf(const Instrument& instrument, const ScanSettings& s) {
  const auto& c = s.camera;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} | {} {} {} {} {} {} {} {} {}",
                     s.columns, s.rows, s.azimuth_from_rad, s.azimuth_to_rad, s.elevation_from_rad, s.elevation_to_rad,
                     s.max_range_m, s.reference_reflectivity, s.noise_factor, s.passes, s.laser, s.imaging,
                     s.unambiguous_m, s.drops.deviation_m, s.drops.weak_factor, s.drops.overload, s.nearest_m,
                     s.farthest_m, s.scan_seconds, s.imaging_seconds, c.columns, c.shots, c.hdr, c.metered, c.stops,
                     c.warmth, c.flash, static_cast<int>(meteringOf(instrument, s.values)),
                     chosenEffect(instrument, s.values, "most_returns").value_or(0));
}

// On grounds that differ in one setting: a flash acts on pictures only. To allow what is refused else is an effect,
// too: a field of view lets its edges be set.
bool changesTheScan(const Instrument& instrument, const InstrumentSetting& setting) {
  std::vector<SettingValues> grounds = {resolveSettings(instrument, {})->values};
  for (const auto& other : instrument.settings)
    for (const auto& choice : other.choices)
      if (const auto adapted = adaptedSettings(instrument, grounds.front(), other.key, choice.value))
        grounds.push_back(*adapted);
  for (const auto& other : instrument.settings) {
    if (!other.choices.empty()) continue;
    for (const auto& choice : setting.choices)
      if (const auto adapted =
              adaptedSettings(instrument, withSetting(grounds.front(), setting.key, choice.value), other.key, "30"))
        grounds.push_back(*adapted);
  }
  std::vector<std::string> values;
  for (const auto& choice : setting.choices) values.push_back(choice.value);
  if (setting.choices.empty())
    for (const double fraction : {0.0, 0.3, 0.7, 1.0})
      values.push_back(fmt::format("{:g}", setting.minimum + fraction * (setting.maximum - setting.minimum)));
  for (const auto& ground : grounds) {
    std::set<std::string> scans;
    for (const auto& value : values) {
      const auto scan = resolveSettings(instrument, withSetting(ground, setting.key, value));
      scans.insert(scan ? scanOf(instrument, *scan) : "refused");
    }
    if (scans.size() > 1) return true;
  }
  return false;
}

// --- the device's own values: what it shows, orders and does ---

std::string orderText(const Order& order) {
  if (const auto* scan = std::get_if<ScanOrder>(&order))
    return fmt::format("scan {} {} {} {} {} {} {} {} {}", scan->name, scan->folder, scan->compensator, scan->panorama,
                       scan->noise_factor, scan->filters, scan->sensors, scan->notes, scan->operator_in_view) +
           settingsText(scan->settings);
  if (const auto* link = std::get_if<LinkOrder>(&order))
    return fmt::format("link {} {} {} {}", link->from_file, link->shift_x_m, link->shift_y_m, link->turn_deg);
  if (const auto* transfer = std::get_if<TransferOrder>(&order))
    return fmt::format("transfer {} {} {}", transfer->by, transfer->extension, transfer->files);
  if (const auto* sight = std::get_if<SightOrder>(&order))
    return fmt::format("sight {} {} {}", sight->target, sight->kind, sight->compensator);
  return "order";
}

// What can be seen of a device without looking at the widgets of `value` itself.
std::string seen(Device device, const std::string& value) {
  const auto& type = device.type();
  std::set<std::string> own;
  for (const auto& screen : type.definition.screens)
    for (const auto& w : screen.widgets)
      if (w.value == value || w.shows.find("value." + value) != std::string::npos) own.insert(w.id);
  const auto screen = device.screen();
  std::string text =
      fmt::format("{} {} {} {} {} {:.6f} {:.3f}", device.state().phase, screen.id, screen.title, screen.light,
                  screen.has_dialog, device.state().around.battery, device.state().clock_s);
  if (screen.has_dialog) text += "|" + screen.dialog.id + screen.dialog.text;
  for (const auto& w : screen.widgets) {
    if (own.contains(w.id)) continue;
    text += fmt::format("|{}={} {} {} {}", w.id, w.value, w.label, w.enabled, w.unit);
    for (const auto& o : w.options) text += fmt::format(",{}{}", o.label, o.enabled);
  }
  if (const auto* project = device.project()) text += "|" + project->photo + project->note;
  text += settingsText(device.state().settings);
  if (const auto order = device.takeOrder()) text += "|" + orderText(*order);
  return text;
}

using Deed = std::function<void(Device&)>;

// What befalls two devices that differ in one value: time, hands, troubles, results.
std::vector<Deed> events() {
  return {[](Device& d) { d.tick(2000); },
          [](Device& d) { (void)d.hand("stand_at", "S2"); },
          [](Device& d) { (void)d.trouble("wlan_lost"); },
          [](Device& d) { (void)d.trouble("tilted"); },
          [](Device& d) { (void)d.trouble("tracking_lost"); },
          [](Device& d) {  // the simulation is done
            StoredSetup setup;
            setup.name = "Setup 9", setup.file = "Setup 9.e57", setup.bytes = 1e8;
            d.scanDone(setup);
            for (int i = 0; i < 5; ++i) d.tick(1000);
          },
          [](Device& d) {
            for (auto& project : d.change().projects)
              for (auto& s : project.setups) s.link = LinkResult{true, 0.025, 0.35, 0, 0};
            d.change().linking = "Setup 2.e57";
            d.fire("linked");
            d.tick(100);
          },
          [](Device& d) {
            d.fire("targets_measured");
            d.tick(100);
          }};
}

// What the screen offers.
std::vector<Deed> presses(const Device& device) {
  std::vector<Deed> deeds = {[](Device&) {}};
  const auto screen = device.screen();
  for (const auto* widgets : {&screen.widgets, &screen.body})
    for (const auto& w : *widgets)
      for (const auto& value : valuesOf(w)) deeds.push_back([id = w.id, value](Device& d) { (void)d.act(id, value); });
  return deeds;
}

// Situations in which a value shows: a scan that runs, a coloured cloud, a tilt, an overridden position.
std::vector<Variant> situationsOf(const DeviceType& type) {
  auto situations = variantsOf(type);
  const auto over_a_mark = [](DeviceState& s) {
    s.values["method"] = "quick";
    s.entries["station_id"] = "S9";
    knowPlaces(s);
    s.orientation->accepted = true;
    s.accepted = s.orientation;
  };
  situations.insert(situations.begin() + 1, over_a_mark);
  situations.push_back([](DeviceState& s) {
    s.running = ScanOrder{};
    s.around.tilt_x_deg = 0.05;
  });
  situations.push_back([](DeviceState& s) { s.around.tilt_x_deg = 20; });
  situations.push_back([](DeviceState& s) {
    s.projects[0].setups[0].station = s.projects[0].setups[1].station = "S2";
    s.entries["pointer"] = "0.3,0.4";
  });
  return situations;
}

std::vector<std::string> alternatives(const ValueRow& value) {
  if (value.kind == WidgetKind::choice || value.kind == WidgetKind::toggle) return value.choices;
  if (value.kind == WidgetKind::text) return {"", "Ada"};
  return {fmt::format("{:g}", value.minimum), fmt::format("{:g}", (value.minimum + value.maximum) / 2),
          fmt::format("{:g}", value.maximum), value.default_value};
}

// The devices that have each of the values, else alike, go through the same: do they end differently?
bool endDifferently(const std::vector<Device>& twins, const std::string& value, const std::vector<Deed>& deeds) {
  return std::any_of(deeds.begin(), deeds.end(), [&](const Deed& deed) {
    std::set<std::string> outcomes;
    for (Device twin : twins) {
      deed(twin);
      outcomes.insert(seen(twin, value));
    }
    return outcomes.size() > 1;
  });
}

// At rest any screen may be shown, else that of the phase.
bool changesTheDevice(const std::shared_ptr<const DeviceType>& type, const ValueRow& value,
                      const std::vector<Variant>& situations) {
  const auto values = alternatives(value);
  const auto in = [&](const Variant& situation, const PhaseRow& phase, const std::string& screen) {
    std::vector<Device> twins;
    for (const auto& v : values) {
      Device d = working(type, phase, screen);
      situation(d.change());
      (void)d.setSettings(d.state().settings);
      d.change().values[value.id] = v;
      if (value.id == "language") d.change().language = v;  // as choosing it does
      twins.push_back(std::move(d));
    }
    return twins;
  };
  const auto pressed = [&](const Variant& situation) {
    for (const auto& phase : type->definition.phases)
      for (const auto& screen : type->definition.screens) {
        const bool rests = !phase.ends() || phase.waits;
        if (!phase.on || (!rests && screen.id != phase.screen)) continue;
        const auto twins = in(situation, phase, screen.id);
        if (endDifferently(twins, value.id, presses(twins.front()))) return true;
      }
    return false;
  };
  const auto befallen = [&](const Variant& situation) {
    return std::any_of(type->definition.phases.begin(), type->definition.phases.end(), [&](const PhaseRow& phase) {
      const auto& screen = phase.screen.empty() ? type->definition.screens.front().id : phase.screen;
      return phase.on && endDifferently(in(situation, phase, screen), value.id, events());
    });
  };
  // What is quick comes first.
  return pressed(situations.front()) || std::any_of(situations.begin(), situations.end(), befallen) ||
         std::any_of(situations.begin() + 1, situations.end(), pressed);
}

std::string helpOf(const DeviceType& type, const WidgetRow& w) {
  return type.words->text(type.definition.id, w.words + "?", "en");
}

class EverySetting : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(EverySetting, OfTheScannerChangesTheScanOrItsHelpSaysThatItDoesNot) {
  const auto first = loadDevice(*GetParam());
  ASSERT_TRUE(first) << describe(first.error());
  for (const auto& id : (*first)->definition.instruments) {
    if (id == "*") continue;
    const auto type = *loadDevice(*GetParam(), id);
    for (const auto& screen : type->definition.screens)
      for (const auto& w : screen.widgets) {
        const auto& settings = type->instrument.settings;
        const auto setting = std::find_if(settings.begin(), settings.end(),
                                          [&](const InstrumentSetting& s) { return s.key == w.setting; });
        if (setting == settings.end() || setting->choices.size() == 1) continue;
        const bool excused = helpOf(*type, w).find(kExcuse) != std::string::npos;
        EXPECT_NE(changesTheScan(type->instrument, *setting), excused) << id << " " << screen.id << "/" << w.id;
      }
  }
}

TEST_P(EverySetting, OfTheDeviceChangesWhatItDoesOrItsHelpSaysThatItDoesNot) {
  const auto loaded = loadDevice(*GetParam());
  ASSERT_TRUE(loaded) << describe(loaded.error());
  const auto& type = *loaded;
  const auto elsewhere = testedBy(*GetParam(), "values");
  std::set<std::string> asked;
  for (const auto& screen : type->definition.screens)
    for (const auto& w : screen.widgets) {
      if (w.value.empty() || elsewhere.contains(w.value)) continue;
      const bool excused = helpOf(*type, w).find(kExcuse) != std::string::npos;
      if (!asked.insert(w.value).second) continue;
      auto situations = situationsOf(*type);
      if (excused) situations.resize(1);  // that there is none anywhere would take minutes
      EXPECT_NE(changesTheDevice(type, *findValue(type->definition, w.value), situations), excused)
          << screen.id << "/" << w.id;
    }
  for (const auto& value : type->definition.values) {
    const bool read_by_code = value.id == "connection" || value.id == "address" ||
                              value.id == "self_timer";  // shown, and set by the device itself
    EXPECT_TRUE(asked.contains(value.id) || elsewhere.contains(value.id) || read_by_code)
        << "no widget sets " << value.id;
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, EverySetting, testing::ValuesIn(everyDevice()), deviceName);

}  // namespace
}  // namespace standpoint

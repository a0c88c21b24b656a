// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/definition.h"
#include "emulated-ui/device/program.h"
#include "emulated-ui/device/state.h"
#include "emulated-ui/device/words.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What all devices of a kind share: data, code, the scanner that is in it, words.
struct DeviceType {
  DeviceDefinition definition;
  DeviceProgram program;  // its transitions are those of the file and those of the code behind them
  Instrument instrument;
  std::shared_ptr<const Words> words;
  std::vector<Condition> guards;  // of the program's transitions
};
// `instrument` is one of the definition's; refuses an instrument that the definition does not name or that needs a
// trajectory.
Result<std::shared_ptr<const DeviceType>> makeDeviceType(DeviceDefinition definition, const DeviceProgram& program,
                                                         Instrument instrument, std::shared_ptr<const Words> words);

// An emulated instrument: a state machine without window, clock or thread of its own. A copy is another instrument in
// the same state. Screens and wording are our own, after the field's labels; not affiliated with or endorsed by the
// makers.
class Device {
 public:
  explicit Device(std::shared_ptr<const DeviceType> type);

  const DeviceType& type() const { return *type_; }
  const DeviceState& state() const { return state_; }

  Screen screen() const;
  // What a widget of the present screen does, what its choices cost, and where it is on the device.
  std::string help(const std::string& widget) const;
  // Presses, chooses, types, or does another gesture. What is not there or is grey is an error of kind usage; what the
  // device itself refuses, it says in a dialogue.
  Result<void> act(const std::string& widget, const std::string& value = {}, Gesture by = Gesture::tap);
  // What hands do to it: see handRows().
  Result<void> hand(const std::string& id, const std::string& value = {});
  // A trouble of the field: see troubleRows().
  Result<void> trouble(const std::string& id);
  // The device's clock goes on.
  void tick(double seconds);
  // True while the clock must tick: it starts, measures, stores, or tracks.
  bool busy() const;
  // Nothing that takes time goes on: no phase has time left, and no scan is held up by a person.
  bool idles() const;
  bool on() const;

  std::optional<Fact> fact(const std::string& name) const;
  std::optional<FactDomain> domain(const std::string& name) const;
  // As a screen shows it: "4:34", "43.7 M", "82 %".
  std::string shown(const std::string& fact) const;
  // The word, with its {facts} and {detail} filled in.
  std::string word(const std::string& key) const;

  // The host takes an order once, runs it, and reports back. An order that was taken back is told by takeCancel.
  std::optional<Order> takeOrder();
  bool takeCancel();
  void orderMoved(double fraction) { state_.engine_fraction = fraction; }
  void scanDone(StoredSetup setup);
  void linkDone(const LinkResult& link);
  void targetsDone(std::vector<FittedTarget> targets);
  void previewDone(const std::string& file, const std::shared_ptr<const ScanPreview>& preview);
  void sightDone(const FittedTarget& target);
  void pickDone(const std::string& file, const FittedTarget& target);
  void sceneDone();
  void seen(std::shared_ptr<const SeenMap> map) { state_.walk.seen = std::move(map); }
  void transferDone(const std::vector<std::string>& files);
  void orderFailed(const std::string& message);
  // True once after the device has stored a scan: from then on the setup exists.
  bool takeStored();
  // A stored setup that the user wants to see in the viewport; once.
  std::optional<StoredSetup> takeView();
  // A station set-up that was accepted, once: from then on the station has coordinates.
  std::optional<StationOrientation> takeOriented();
  void orientationErred(const PlaceError& error);  // the accepted one, against the truth
  // Known places, as they are copied to the device.
  void know(ControlList control) { state_.control = std::move(control); }
  // What the project already holds of this instrument's work: the card's content.
  void load(const std::vector<StoredSetup>& stored);

  // For the code of devices, actions and hands.
  DeviceState& change() { return state_; }
  bool in(const PhaseId& phase) const { return state_.phase == phase.name; }
  bool in(const Phases& phases) const;
  bool can(const EventId& event) const;
  bool fire(const EventId& event);       // false: the phase knows no such event now
  void show(const std::string& screen);  // "back": where one came from
  void ask(const std::string& dialog, const std::string& detail = {});
  void note(const std::string& what, const std::string& detail = {});
  Result<void> setSettings(const SettingValues& wanted);
  const ScanSettings& expected() const { return expected_; }
  std::string value(const std::string& id) const;  // of the device's own values
  std::string setting(const std::string& key) const;
  std::string entry(const std::string& id) const;   // what was typed into a field; empty: nothing
  double number(const std::string& fact) const;     // 0 where it is none; "value.azimuth", "setting.vertical_to"
  double entryNumber(const std::string& id) const;  // the same of what was typed
  const DeviceProject* project() const;
  DeviceProject* project();
  StoredSetup* shownSetup();
  const StoredSetup* shownSetup() const;
  StoredSetup* newestSetup();
  const StoredSetup* newestSetup() const;
  void give(Order order);
  void takeBack();  // the running order
  void markStored() { stored_ = true; }
  void view(const StoredSetup& setup) { view_ = setup; }
  void acceptOrientation();
  double expectedBytes() const;
  double tilt() const;           // degrees
  bool levelled() const;         // a scan that begins now is
  double levelledRange() const;  // degrees: of the scanner's compensator, else of the body
  bool showsFeet() const { return value("units") == "feet"; }
  // At rest for so long that its display went dark: what is pressed next only wakes it.
  bool asleep() const;

 private:
  FactLookup facts() const;
  const WidgetRow* rowOf(const std::string& id) const;
  std::optional<Widget> widget(const WidgetRow& row) const;
  Result<void> press(const WidgetRow& row, const Widget& widget, const std::string& value);
  Result<void> carryOut(const WidgetEffect& effect, const std::string& value, const Widget& widget);
  Result<void> bind(const WidgetRow& row, const Widget& widget, const std::string& value);
  void enter(const PhaseRow& phase);
  std::string movedAlong(const SettingValues& adapted, const std::string& key) const;
  std::optional<double> leftOfPhase() const;
  void pass(double seconds);
  void wake() { state_.untouched_s = 0; }
  void run(double seconds);
  void watchBattery(double before);
  void watchWalk(double before_s);

  std::shared_ptr<const DeviceType> type_;
  DeviceState state_;
  ScanSettings expected_;
  std::optional<Order> order_;
  std::optional<StoredSetup> view_;
  std::optional<StationOrientation> oriented_;
  bool cancel_ = false;
  bool stored_ = false;
};

// What hands can do to an instrument, and the troubles that a lecturer, or chance, can send.
struct HandRow {
  const char* id;     // "insert_card"; its word is "hand.insert_card"
  const char* group;  // "memory", "power", "tripod", "around"; its word is "hands.memory"; rows of one stand together
  const char* value;  // what its value is: "" none, "x,y in degrees", …
  Result<void> (*act)(Device&, const std::string& value);
};
const std::vector<HandRow>& handRows();

struct TroubleRow {
  const char* id;  // "card_full"; its word is "trouble.card_full"
  void (*happens)(Device&);
};
const std::vector<TroubleRow>& troubleRows();

const std::vector<FactRow>& sharedFacts();
const std::vector<DeviceAction>& sharedActions();
// As of a device that is in use: where no project is open, the last one is, or a new one by the name that the device
// proposes.
void openSomeProject(Device& device);
const std::vector<ListRow>& sharedLists();

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An emulated instrument's menu as a state machine: no ImGui, no clock and no thread of its own. A screen is data (a list
// of widgets); the draw half shows it in the instrument's skin, a test or an exercise reads it and acts on it.
// Screens and wording are our own, after the field's labels; not affiliated with or endorsed by the makers.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scanners/instrument.h"

namespace standpoint {

enum class WidgetKind {
  status,    // in the status row: battery, memory, …
  readout,   // label and value
  button,
  key,       // the one that starts or stops the laser: drawn large
  choice,    // one of options; act with the option's text
  text,      // an entry field; act with the new text
  number,    // an entry field that is taken over when it is confirmed; act with the number as text
  list,      // rows to open; act with the row's number as text
  progress,  // value is the percentage as text
  message,   // a dialogue's text; the buttons that follow belong to it
};

struct Widget {
  std::string id;
  WidgetKind kind = WidgetKind::readout;
  std::string label;
  std::string value;
  std::vector<std::string> options;   // of a choice or list
  bool enabled = true;
  std::string why_not;                // when it is not enabled
};

struct Screen {
  std::string id;
  std::string title;
  std::vector<Widget> widgets;
};

const Widget* findWidget(const Screen& screen, const std::string& id);

// What the menu asks of whoever hosts it.
struct ScanRequest {
  std::string instrument;       // id
  std::string job;              // on the instrument
  int setup = 0;                // number within the job, from 1
  std::string station;          // where it stands
  SettingValues settings;
};
struct StoredScan {
  std::string job;
  int setup = 0;
  std::string station;
  SettingValues settings;
  std::string file;
  std::uint64_t points = 0;
  double instrument_seconds = 0;
};

class Menu {
 public:
  virtual ~Menu() = default;
  virtual Screen screen() const = 0;
  // Presses, chooses, types. What the present screen does not have, or what is not enabled, is an error of kind usage.
  virtual Result<void> act(const std::string& widget, const std::string& value = {}) = 0;
  // The instrument's own clock goes on by that many seconds.
  virtual void tick(double seconds) = 0;

  // Where the tripod stands; empty: nowhere.
  virtual void standAt(const std::string& station) = 0;
  // What the project already holds of this instrument's work: the memory card's content.
  virtual void load(const std::vector<StoredScan>& stored) = 0;

  // The host takes a request once, runs it, and reports back.
  virtual std::optional<ScanRequest> takeRequest() = 0;
  virtual bool takeCancel() = 0;
  virtual void scanMoved(double share) = 0;
  virtual void scanDone(const StoredScan& stored) = 0;
  virtual void scanFailed(const std::string& message) = 0;
  // True once after the instrument has stored the scan that scanDone brought: from then on the setup exists.
  virtual bool takeStored() = 0;
  // A stored scan that the user asked to see; once.
  virtual std::optional<StoredScan> takeView() = 0;

  // True while the clock must tick: booting, scanning, storing.
  virtual bool busy() const = 0;
};

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/menu.h"

namespace standpoint::rtc360 {

enum class Phase { off, booting, ready, scanning, photographing, storing };

struct DeviceJob {
  std::string name;
  std::vector<StoredScan> setups;
};

// All that the instrument knows; a plain value.
struct State {
  Phase phase = Phase::off;
  std::string screen = "off";
  std::vector<DeviceJob> jobs;
  int job = -1;                   // the open one
  int setup = -1;                 // the one shown on the setup screen
  std::string new_name;
  std::string station;
  SettingValues settings;         // complete, in the instrument's words
  double elapsed_s = 0;           // in the present phase
  double engine_share = 0;        // of the simulation behind it
  bool stopping = false;          // the question is on the screen
  std::string message;            // a dialogue; empty: none
  std::optional<StoredScan> finished;   // the simulation is done before the instrument's clock is
  double battery_share = 1;
  bool usb_present = true;
  double memory_free_bytes = 0;
};

}  // namespace standpoint::rtc360

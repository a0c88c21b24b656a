// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulated-ui/device/condition.h"

namespace standpoint {

class Device;
struct DeviceDefinition;

// A sine tone, or a rest at 0 Hz.
struct Beep {
  double hertz = 0;
  double milliseconds = 0;
  bool operator==(const Beep&) const = default;
};
constexpr double kLongestSound_ms = 3000;

// What a device lets hear: `sounds` of its file.
struct SoundRow {
  std::string id;
  std::vector<std::string> on;  // events of its log, as facts count them: "pressed", "phase.booting", "trouble"
  std::vector<Beep> tones;      // one after the other
  std::string source;
};
struct SoundsRow {
  Condition when;  // it is not silenced; empty: it never is
  std::vector<SoundRow> rows;
};

// The sound of what the device has logged since it had logged `noted` events; of several that are due the one that
// stands last in the file. Null: silence.
const SoundRow* soundSince(const Device& device, std::uint64_t noted);

// An event that a sound waits for and that never comes, in words; empty: it can come.
std::string unheardOf(const DeviceDefinition& definition, const std::string& event);

}  // namespace standpoint

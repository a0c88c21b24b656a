// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scanners/instrument.h"

namespace standpoint {

SettingValues withSetting(SettingValues values, const std::string& key, const std::string& value);

// The settings with `key` at `value`. Where that does not go with the others, one of them moves to its first choice that
// does: what a device does when a resolution is chosen to which the quality does not fit. Else the numbers go back to their
// standards: those of an area that is no longer chosen. An error when that does not help either.
Result<SettingValues> adaptedSettings(const Instrument& instrument, const SettingValues& now, const std::string& key,
                                      const std::string& value);

// In one line, for profiles and stored configurations: "resolution=12mm;images=on;".
std::string settingsText(const SettingValues& settings);
SettingValues settingsFromText(const std::string& text);

}  // namespace standpoint

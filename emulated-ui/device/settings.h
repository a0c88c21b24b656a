// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scanners/instruments/instrument.h"

namespace standpoint {

SettingValues withSetting(SettingValues values, const std::string& key, const std::string& value);

// The settings with `key` at `value`. Where that does not go with the others, one that comes after it in the data sheet
// moves to its nearest choice that does: a resolution moves the quality that does not fit it, while a quality that does
// not fit the resolution is an error, so it is grey. Else the numbers go back to their standards: those of an area that
// is no longer chosen. An error when that does not help either.
Result<SettingValues> adaptedSettings(const Instrument& instrument, const SettingValues& now, const std::string& key,
                                      const std::string& value);

// In one line, for profiles and stored configurations: "resolution=12mm;images=on;".
std::string settingsText(const SettingValues& settings);
SettingValues settingsFromText(const std::string& text);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/linking.h"

namespace standpoint::trimble_x7 {

// How the tablet judges the link of a station to the one before: error, overlap, consistency and confidence, two limits
// (73 and 91) and the difference of the tilts (instrument facts, section 2.5).

constexpr double kAmberConfidence = 73, kGreenConfidence = 91;  // [S14]
constexpr double kMostTiltDifference_deg = 5;                   // [S14]: from here on a link is refused

// [P] Consistency in percent: 100 / (1 + (error / 10 mm)^4): 99.8 at 2 mm, 94 at 5 mm, 50 at 10 mm.
double consistencyOf(const LinkResult& link);
// [P] Confidence in percent: the consistency, less what too little overlap takes: 1 - exp(-(overlap / 0.2)^2), which is
// 0.89 at 30 % and next to 1 from 50 % on. Good links then have what two real projects show: 99, 100 and 73 to 88 %
// [S14].
double confidenceOf(const LinkResult& link);
double tiltDifference_deg(const StoredSetup& a, const StoredSetup& b);

// "none", "registered", "check", "failed", "applied" or "rejected".
std::string registrationOf(const Device& device, const StoredSetup& setup);
void forgetRegistration(Device& device, const StoredSetup& setup);
void setRegistration(Device& device, const StoredSetup& setup, const std::string& state);
// The station whose link is on view; null where none has a partner.
const StoredSetup* linkedSetup(const Device& device);

// Effects.
void refineShown(Device& device);  // from where the user has laid it
void refineFirst(Device& device);  // of all
void judgeLink(Device& device);
void judgeAndRefineNext(Device& device);
void forgetLink(Device& device);      // of the station on view
int linksLeft(const Device& device);  // of those that are refined in one go

Result<void> chooseLink(Device& device, const std::string& row);
Result<void> choosePair(Device& device, const std::string& rows);
Result<void> applyLink(Device& device, const std::string&);
Result<void> rejectLink(Device& device, const std::string&);
std::vector<WidgetOption> linkRows(const Device& device);

}  // namespace standpoint::trimble_x7

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/device/device.h"

namespace standpoint::riegl_vz_i {

// What a VZ-i does after a scan: the search for reflectors and the registration; and the control points.

double registrationSeconds(const Device& device);
std::string registrationResult(const Device& device);  // "none", "ok", "fast_failed" or "scan_failed"
void beginRegistration(Device& device);
// "2,0", drawn on the plan: the earlier position that the newest is registered against.
Result<void> chooseReference(Device& device, const std::string& rows);
void judgeRegistration(Device& device);
void storeAndRegister(Device& device);

double reach(const Device& device);  // to which the reflectors of the chosen model are seen
void filterReflectors(Device& device);
void storeAndSearch(Device& device);

std::vector<std::string> controlNames(const Device& device);
std::vector<WidgetOption> controlRows(const Device& device);
Result<void> addPoint(Device& device, const std::string&);
Result<void> clearPoints(Device& device, const std::string&);
Result<void> georeference(Device& device, const std::string&);
bool isGeoreferenced(const Device& device);

}  // namespace standpoint::riegl_vz_i

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulated-ui/device/device.h"

// What the tablet of an X7 does beside registering: projects and connection (tablet.cpp), scan panel and capture
// (scan_panel.cpp), stations (stations.cpp).
namespace standpoint::trimble_x7 {

Result<void> sharedAction(Device& device, std::string_view name, const std::string& value = {});
Result<void> proposeNew(Device& device, const std::string&);
Result<void> createNew(Device& device, const std::string&);  // an empty name takes the one that is proposed
bool startIndexValid(const Device& device);
// Of the raw scans those that lie on the scanner's card only: what an interrupted download has left there.
Result<void> importNow(Device& device, const std::string&);

bool reachable(const Device& device);
bool connected(const Device& device);
double downloadSeconds(const Device& device);

std::vector<WidgetOption> modeRows(const Device& device);  // the seven columns [S15]
Result<void> chooseMode(Device& device, const std::string& duration);
const StoredSetup* parentOfArea(const Device& device);
Result<void> proposeArea(Device& device, const std::string&);
Result<void> takeArea(Device& device, const std::string&);
double stepProgress(const Device& device);
std::vector<WidgetOption> stepRows(const Device& device);
void prepareScan(const Device& device, ScanOrder& order);
void storeStation(Device& device);
void storeAndRegister(Device& device);
void storeArea(Device& device);  // a window of a station stands where that station does

std::vector<WidgetOption> stationRows(const Device& device);
Result<void> addAnnotation(Device& device, const std::string&);
std::vector<WidgetOption> annotationRows(const Device& device);
Result<void> switchPointer(Device& device, const std::string&);
Result<void> measureOrPoint(Device& device, const std::string& at);
std::optional<Eigen::Vector3d> pointerSpot(
    const Device& device);                                  // what the laser pointer rests on, in the scanner's frame
double unmeasured(const Device& device);                    // share of the picture on view
std::vector<WidgetOption> errorRows(const Device& device);  // level and description [S15]

}  // namespace standpoint::trimble_x7

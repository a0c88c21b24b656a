// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

class Device;
struct LinkOrder;
struct StoredSetup;

// What transitions do, for the tables of the devices.
void beginScan(Device& device);  // gives the order and reserves the number
void storeScan(Device& device);  // the data go onto the card, and the setup is listed and shown
void dropScan(Device& device);   // the running scan is taken back
void markMoved(Device& device);  // the tripod was pushed: the rest of the scan stands elsewhere
// Who scans walks into its view, or out of it, and somebody crosses it, while the laser turns: from here on.
void operatorComes(Device& device);
void operatorGoes(Device& device);
void somebodyWalksBy(Device& device);
void keepPartial(Device& device);  // the columns that are done are kept as a scan of their own
// Degrees by which a setup lies turned in plan before it is fitted to an earlier one, where a room looks the same from
// both sides and no compass tells them apart.
double falseStart(const Device& device, const StoredSetup& newer, const StoredSetup& older);
// The trouble of a registration that fails: it begins where there is nothing.
void mislay(Device& device, LinkOrder& order);
void orderLink(Device& device);  // of the newest setup to the one before, where there is one
void orderLinkTo(Device& device, const StoredSetup& newer, const StoredSetup& older);
void storeAndLink(Device& device);
void loseTracking(Device& device);
void resetTracking(Device& device);  // it watches the way from here on

void deleteShownSetup(Device& device);
void deleteOpenProject(Device& device);  // with its setups
// Everything on the card is gone; what was not copied before is lost, as in the field.
void formatCard(Device& device);

// Those that a device's file may name.
struct NamedEffect {
  const char* name;  // "store_scan"
  void (*effect)(Device&);
};
const std::vector<NamedEffect>& namedEffects();

// Names that become folders and files: not empty, none of \ / : * ? " < > |, no leading or trailing dot or blank.
Result<void> checkName(const Device& device, const std::string& name);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "emulated-ui/device/device.h"

namespace standpoint {

// Links that a user makes between set-ups: by a line from mark to mark on the map, or by laying one cloud onto another
// before it is fitted. A set-up has one link, to one that was there before it.

const StoredSetup* setupWithFile(const std::vector<StoredSetup>& setups, const std::string& file);
// What joined links, one after the other, make of a place that the set-up has by itself, local frame; as it is without
// one. A ring of links comes to an end.
Pose movedByLinks(const std::vector<StoredSetup>& setups, const StoredSetup& setup);
const StoredSetup* setupOfFile(const Device& device, const std::string& file);
// What the set-up is linked to, or would be: what its user joined it with, else the one before it; null: none.
const StoredSetup* partnerOf(const Device& device, const StoredSetup& setup);
// "2,0": the rows of two set-ups of the open project, in any order; the newer one first in the answer.
Result<std::pair<StoredSetup*, StoredSetup*>> pairIn(Device& device, const std::string& rows);

// The cloud of the set-up on that of its partner, as the values shift_x, shift_y and turn have it, and as the room
// itself lays it; nothing where it has no partner.
std::optional<LaidCloud> laidCloud(const Device& device, const StoredSetup* setup);
void forgetLaid(Device& device);  // it lies as it lay before
// From where it lies to its partner.
void orderLaidLink(Device& device, const StoredSetup& setup);

// Effect: the link of the set-up on view is taken away.
void removeLink(Device& device);

// Actions. "2,0", then the link is ordered, as that to the set-up before is.
Result<void> linkSetups(Device& device, const std::string& rows);
Result<void> layCloud(Device& device, const std::string& laid);  // "x,y,turn": the three values
Result<void> layBack(Device& device, const std::string&);

}  // namespace standpoint

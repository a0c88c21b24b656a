// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/device.h"

namespace standpoint {

// The ids of the rows of a list, in its order.
template <class Rows>
std::vector<std::string> idsOf(const Rows& rows) {
  std::vector<std::string> ids;
  for (const auto& row : rows) ids.emplace_back(row.id);
  return ids;
}

// What the detail of an event is, of which "count.EVENT.DETAIL" asks.
enum class EventDetail { none, text, screen, phase, dialog, answer, press, hand, trouble, field_verb };

// Something that devices log, or that a rehearsal counts itself. Its word is "never.NAME": what did not happen where it
// never came. First those that devices share, then those that are a device's own.
struct EventRow {
  const char* name;  // "scan_started"
  EventDetail detail = EventDetail::none;
  const char* about = "";
  bool logged = true;  // by devices, so that a rule can be asked at each; false: it is only counted
};
const std::vector<EventRow>& eventRows();

// What is wrong with the name of a counter, "count.EVENT" or "count.EVENT.DETAIL", on this device; none: it can count.
std::optional<std::string> wrongCounter(const std::string& name, const Device& device);
// What is wrong with EVENT in "each EVENT".
std::optional<std::string> wrongEvent(const std::string& name);

}  // namespace standpoint

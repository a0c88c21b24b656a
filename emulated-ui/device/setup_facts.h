// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/program.h"

namespace standpoint {

struct StoredSetup;

// What a stored setup is asked for: of the newest as "newest.points", of the N-th stored one as "setup.2.points".
struct SetupFactRow {
  const char* name;  // "newest.points"
  FactUnit unit = FactUnit::none;
  FactDomain domain = {};
  Fact (*value)(const Device&, const StoredSetup*);  // null: no setup is stored
  const char* about;
};
const std::vector<SetupFactRow>& setupFactRows();

// Those of the table for the newest setup, for the list of facts that all devices share.
std::vector<FactRow> newestFacts();

// "setup.N.…", counted from 1 over all projects, and "newest.setting.KEY", "setup.N.setting.KEY": a setting that the
// setup was scanned with. Nothing: no such name, or no such setup.
std::optional<Fact> setupFact(const Device& device, const std::string& name);
std::optional<FactDomain> setupFactDomain(const Device& device, const std::string& name);
FactUnit setupFactUnit(const std::string& name);

}  // namespace standpoint

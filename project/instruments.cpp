// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/instruments.h"

#include <fmt/format.h>

#include "project/verb.h"

namespace standpoint {

Result<std::vector<Instrument>> shippedInstruments() { return readInstruments(dataFolder() / "scanners" / "instruments"); }

std::string idsOf(const std::vector<Instrument>& instruments) {
  std::string ids;
  for (const auto& i : instruments) ids += (ids.empty() ? "" : ", ") + i.id;
  return ids;
}

Result<Instrument> instrumentById(const std::string& id) {
  auto all = shippedInstruments();
  if (!all) return failure(all.error());
  for (auto& i : *all)
    if (i.id == id) return std::move(i);
  return failure(ErrorKind::usage, fmt::format("there is no instrument '{}'; there is {}", id, idsOf(*all)), "--instrument");
}

}  // namespace standpoint

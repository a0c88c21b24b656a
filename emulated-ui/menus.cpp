// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/menus.h"

#include <algorithm>
#include <array>

#include "emulated-ui/leica/rtc360.h"
#include "project/verb.h"

namespace standpoint {

namespace {

constexpr std::array kEmulated = {
    EmulatedInstrument{"leica-rtc360", "Leica RTC360", makeRtc360},
};

}  // namespace

std::span<const EmulatedInstrument> emulatedInstruments() { return kEmulated; }

Result<std::unique_ptr<Menu>> makeMenu(const EmulatedInstrument& emulated) {
  auto instrument =
      readInstrument(dataFolder() / "scanners" / "instruments" / (std::string(emulated.instrument) + ".json"));
  if (!instrument) return failure(instrument.error());
  return emulated.make(*instrument);
}

const Widget* findWidget(const Screen& screen, const std::string& id) {
  const auto found = std::find_if(screen.widgets.begin(), screen.widgets.end(), [&](const Widget& w) { return w.id == id; });
  return found == screen.widgets.end() ? nullptr : &*found;
}

}  // namespace standpoint

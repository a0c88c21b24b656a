// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/layout/place.h"
#include "emulated-ui/menus.h"
#include "tests/fuzz/fuzz_file.h"

// A layout is read, or refused with its place; one that is read places every widget of every screen in its display.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace standpoint;
  static const auto type = *loadDevice(*findDevice("leica-rtc360"));
  const auto layout = readLayout(fuzz::fileOf(data, size, ".json"), type->definition);
  if (!layout && layout.error().source.empty()) std::abort();
  if (!layout) return 0;
  const PlacingState state{[](const std::string&) { return true; }, [](const Region&) { return 0; }, 40};
  for (const auto& screen : type->definition.screens) {
    const auto& face = faceOf(*layout, screen.id);
    const Box display{0, 0, face.display[2], face.display[3]};
    for (const auto& placed : placeRegions(layout->screens.at(screen.id).root, display, state))
      if (placed.box.x < -1 || placed.box.y < -1 || placed.box.right() > display.width + 1 ||
          placed.box.bottom() > display.height + 1)
        std::abort();
  }
  return 0;
}

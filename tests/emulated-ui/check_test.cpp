// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/check.h"

#include <gtest/gtest.h>

#include "emulated-ui/menus.h"

namespace standpoint {
namespace {

TEST(Devices, AreSoundWithEachScannerThatTheyDrive) {
  for (const auto& device : emulatedDevices()) {
    const auto first = loadDevice(device);
    ASSERT_TRUE(first) << describe(first.error());
    for (const auto& instrument : (*first)->definition.instruments) {
      const auto type = instrument == "*" ? first : loadDevice(device, instrument);
      ASSERT_TRUE(type) << describe(type.error());
      for (const auto& fault : checkDevice(**type)) ADD_FAILURE() << instrument << ": " << describe(fault);
    }
  }
}

TEST(Devices, HaveWordsForAllHandsAndTroubles) {
  const auto type = loadDevice(emulatedDevices().front());
  ASSERT_TRUE(type) << describe(type.error());
  const auto& words = *(*type)->words;
  for (const auto& language : words.languages()) {
    for (const auto& hand : handRows()) {
      EXPECT_TRUE(words.has("", std::string("hand.") + hand.id, language)) << hand.id << " in " << language;
      EXPECT_TRUE(words.has("", std::string("hands.") + hand.group, language)) << hand.group << " in " << language;
    }
    for (const auto& trouble : troubleRows())
      EXPECT_TRUE(words.has("", std::string("trouble.") + trouble.id, language)) << trouble.id << " in " << language;
  }
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

Document stationInARoom() {
  return run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document;
}

json towards(const std::string& direction, const std::filesystem::path& output) {
  return {{"station", "S1"}, {"instrument", "leica-rtc360"}, {"direction", direction}, {"output", output.string()}};
}

// The inner faces of the walls are at x = 6 and y = 4, the floor at z = 0; azimuths run clockwise from Y.
TEST(WaveformVerb, WritesThePulseThatComesBackFromWhereItPoints) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "pulse.csv";
  const Document room = stationInARoom();
  for (const auto& [direction, range] : {std::pair{"90,0", 3.5}, {"0,0", 2.0}, {"45,-90", 1.6}}) {
    const auto outcome = run("waveform", room, towards(direction, file));
    ASSERT_TRUE(outcome) << describe(outcome.error());
    ASSERT_EQ(outcome->answer["echoes"].size(), 1U) << direction;
    EXPECT_NEAR(outcome->answer["echoes"][0]["range_m"].get<double>(), range, 1e-3) << direction;
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "range_m,power");
    std::size_t bins = 0;
    double at = 0, highest = 0;
    while (std::getline(in, line)) {
      std::istringstream row(line);
      double bin = 0, power = 0;
      char comma = 0;
      row >> bin >> comma >> power;
      ++bins;
      if (power > highest) highest = power, at = bin;
    }
    EXPECT_EQ(bins, outcome->answer["bins"].get<std::size_t>()) << direction;
    EXPECT_NEAR(at, range, outcome->answer["bin_m"].get<double>()) << direction;
    EXPECT_NEAR(10 * std::log10(highest), outcome->answer["echoes"][0]["power_db"].get<double>(), 0.05) << direction;
  }
}

TEST(WaveformVerb, RefusesWhatItCannotDoWithARemedy) {
  const TemporaryFolder folder;
  const Document room = stationInARoom();
  auto options = towards("90,0", folder.path() / "pulse.csv");
  const auto refused = [&](const char* key, const json& value, const char* words) {
    auto wrong = options;
    wrong[key] = value;
    const auto outcome = run("waveform", room, wrong);
    ASSERT_FALSE(outcome) << key;
    EXPECT_NE(outcome.error().message.find(words), std::string::npos) << outcome.error().message;
  };
  refused("station", "S9", "unknown station 'S9'");
  refused("instrument", "faro-focus-s350", "use a time-of-flight instrument");
  refused("direction", "north", "AZIMUTH,ELEVATION");
  refused("direction", "0,91", "elevation from -90 to 90");
  refused("output", (folder.path() / "pulse.txt").string(), "use .csv");
  refused("bin", 1e-8, "use wider ones");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pulse.csv"));
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/instrument/instrument.h"
#include "editor/instrument/speaker.h"
#include "editor/instrument/tones.h"
#include "editor/shell/actions.h"
#include "item_probe.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

// The amplitude of one frequency in samples, by Goertzel's sum.
double amplitudeOf(double hertz, std::span<const std::int16_t> samples, double rate_hz) {
  double re = 0, im = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double angle = 2 * std::numbers::pi * hertz * static_cast<double>(i) / rate_hz;
    re += samples[i] * std::cos(angle), im += samples[i] * std::sin(angle);
  }
  return 2 * std::hypot(re, im) / static_cast<double>(samples.size());
}

TEST(Tones, HaveTheirFrequencyAndLength) {
  const std::array<Beep, 3> tones = {Beep{1000, 100}, {0, 50}, {2500, 200}};
  const auto samples = samplesOf(tones, 48000);
  ASSERT_EQ(samples.size(), 350U * 48);
  const auto part = [&](std::size_t from_ms, std::size_t ms) {
    return std::span(samples).subspan(from_ms * 48, ms * 48);
  };
  EXPECT_GT(amplitudeOf(1000, part(10, 80), 48000), 7500);
  EXPECT_LT(amplitudeOf(2500, part(10, 80), 48000), 50);
  for (const auto sample : part(100, 50)) EXPECT_EQ(sample, 0);
  EXPECT_GT(amplitudeOf(2500, part(160, 180), 48000), 7500);
}

TEST(Tones, NeitherClickNorAlias) {
  const std::array<Beep, 2> tones = {Beep{1234, 37}, {30000, 20}};
  const auto samples = samplesOf(tones, 44100);
  int steepest = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) steepest = std::max(steepest, std::abs(samples[i] - samples[i - 1]));
  EXPECT_LE(steepest, 8192 * 2 * std::numbers::pi * 1234 / 44100 * 1.02) << "the steepest place of the sine itself";
  for (const auto sample : std::span(samples).last(882)) EXPECT_EQ(sample, 0) << "what the rate cannot carry";
}

// OpenAL Soft writes to a file what it plays. It reads its settings once in a process.
class SoundsInAFile : public testing::Test {
 protected:
  SoundsInAFile() {
    std::ofstream(folder_.path() / "alsoft.conf") << "[general]\ndrivers=wave\nfrequency=44100\nchannels=mono\n[wave]\n"
                                                  << "file=" << file_.string() << "\n";
    setenv("ALSOFT_CONF", (folder_.path() / "alsoft.conf").c_str(), 1);
    setenv("HOME", folder_.path().c_str(), 1);
  }
  std::vector<std::int16_t> written() const {
    std::ifstream in(file_, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto data = bytes.find("data");
    if (data == std::string::npos || bytes.size() < data + 8) return {};
    std::vector<std::int16_t> samples((bytes.size() - data - 8) / 2);
    std::memcpy(samples.data(), bytes.data() + data + 8, samples.size() * 2);
    return samples;
  }
  bool isHeard() const {
    const auto samples = written();
    return std::any_of(samples.begin(), samples.end(), [](auto sample) { return std::abs(sample) > 1000; });
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "heard.wav";
};

TEST_F(SoundsInAFile, AreOffUntilTheUserWantsThemAndThenHeardOnAPress) {
  {
    Editor editor{verbsWithDemo(), [] {}};
    GuiDriver gui{editor};
    attachInstrument(editor);
    editor.workspace = Workspace::instrument;
    gui.frames(3);
    ASSERT_TRUE(gui.click("power"));
    gui.frames(3);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(std::filesystem::exists(file_)) << "no output is even opened";

    ASSERT_TRUE(invoke(editor, "sounds"));
    EXPECT_TRUE(editor.settings.sounds);
    ASSERT_TRUE(gui.click("power"));  // a key of a device that is switched off or booting
    for (int i = 0; i < 4000 && !isHeard(); ++i) {
      gui.frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  EXPECT_TRUE(isHeard());
}

TEST(SoundsWithoutAnOutput, SayThatNothingIsHeard) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto plays = [] {
    setenv("ALSOFT_DRIVERS", "null", 1);
    std::atomic<bool> woken = false;
    Speaker speaker([&] { woken = true; });
    speaker.play({{880, 50}});
    for (int i = 0; i < 5000 && !woken; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::exit(speaker.takeProblem().starts_with("No sound output") && speaker.takeProblem().empty() ? 0 : 1);
  };
  EXPECT_EXIT(plays(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace standpoint

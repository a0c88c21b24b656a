// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/atmosphere.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/portable_math.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;

Weather clearTo(double visibility_km) {
  Weather weather;
  weather.visibility_km = visibility_km;
  return weather;
}

// V1 of physics.md §7, and its table of §2.5.
TEST(Atmosphere, V1_FollowsBeerLambertAndKim) {
  const double alpha = extinction_per_m(clearTo(23), 1550);
  EXPECT_NEAR(alpha, 0.0442e-3, 0.005 * 0.0442e-3);
  EXPECT_NEAR(10 * std::log10(std::exp(1.0)) * 1e3 * alpha, 0.192, 0.001);
  EXPECT_NEAR(std::exp(-2 * alpha * 100), 0.9912, 1e-4);
  for (const double wavelength : {532.0, 905.0, 1550.0})
    EXPECT_NEAR(extinction_per_m(clearTo(0.3), wavelength), 13.04e-3, 0.005 * 13.04e-3);
  const double table[3][6] = {{.178, .107, .100, .089, .072, .044},
                              {.813, .522, .489, .444, .369, .240},
                              {1.999, 1.547, 1.491, 1.408, 1.265, .987}};
  const double visibilities[] = {23, 5, 2};
  const double wavelengths[] = {532, 785, 830, 905, 1064, 1550};
  for (int v = 0; v < 3; ++v)
    for (int w = 0; w < 6; ++w)
      EXPECT_NEAR(1e3 * extinction_per_m(clearTo(visibilities[v]), wavelengths[w]), table[v][w], 0.0006);
}

TEST(Atmosphere, IsNoneWithoutAir) { EXPECT_EQ(extinction_per_m(kNoAir, 1550), 0); }

// The figures of the formula, and Carbonneau's fit to measurements beside them: 3.2 to 14.8 dB/km.
TEST(Atmosphere, V16_HasTheExtinctionOfMarshallAndPalmersRain) {
  const auto alpha = [](double mm_h) { return extinction_per_m(rainDrops(mm_h)); };
  EXPECT_NEAR(alpha(10), 1.56e-3, 0.02 * 1.56e-3);
  EXPECT_NEAR(std::exp(-2 * alpha(10) * 50), 0.856, 0.02 * 0.856);
  EXPECT_NEAR(alpha(5), 1.00e-3, 0.01e-3);
  EXPECT_NEAR(alpha(25), 2.77e-3, 0.02e-3);
  EXPECT_NEAR(alpha(50), 4.29e-3, 0.02e-3);
}

TEST(Atmosphere, AddsUpWhatIsInTheAir) {
  Weather all{10, 20, 3, 500, 800};
  const double sum = extinction_per_m(clearTo(10), 905) + extinction_per_m(rainDrops(20)) +
                     extinction_per_m(snowFlakes(3)) + std::log(20) / 500 + std::log(20) / 800;
  EXPECT_NEAR(extinction_per_m(all, 905), sum, 1e-12 * sum);
  EXPECT_NEAR(extinctionOfRange(50), 0.06, 1e-4);  // §2.6
}

TEST(Weather, IsReadFromItsWords) {
  EXPECT_EQ(weatherFrom("rain=10 fog=200 visibility=5").value(), (Weather{5, 10, 0, 200, 0}));
  EXPECT_EQ(weatherFrom("snow=2.5,dust=60").value(), (Weather{23, 0, 2.5, 0, 60}));
  EXPECT_EQ(weatherFrom("").value(), Weather{});
  EXPECT_EQ(weatherFrom("visibility=inf").value(), kNoAir);
}

TEST(Weather, ThatCannotBeIsRefusedWithItsBoundsAndUnits) {
  const auto refused = [](const char* text) { return weatherFrom(text).error(); };
  EXPECT_EQ(refused("rain=1000").source, "rain");
  EXPECT_THAT(refused("rain=1000").message, HasSubstr("0.1 to 300 mm/h"));
  EXPECT_THAT(refused("rain=-1").message, HasSubstr("mm/h"));
  EXPECT_THAT(refused("fog=nan").message, HasSubstr("5 to 50000 m"));
  EXPECT_THAT(refused("visibility=0").message, HasSubstr("km"));
  EXPECT_THAT(refused("visibility=-inf").message, HasSubstr("km"));
  EXPECT_THAT(refused("rain=ten").message, HasSubstr("not a number"));
  EXPECT_THAT(refused("rain").message, HasSubstr("not a number"));
  EXPECT_THAT(refused("rain=5mm").message, HasSubstr("not a number"));
  EXPECT_THAT(refused("rain=5 rain=6").message, HasSubstr("twice"));
  EXPECT_THAT(refused("hail=5").message, HasSubstr("dust takes"));
}

TEST(PortableMath, OfDoublesIsThatOfTheLibrary) {
  using std::abs, std::log, std::exp;
  for (double x = 1e-9; x < 1e9; x *= 1.37) EXPECT_NEAR(portable::log(x), log(x), 1e-15 * (1 + abs(log(x))));
  for (double x = -600; x < 600; x += 3.7) EXPECT_NEAR(portable::exp(x) / exp(x), 1, 3e-16 * (1 + abs(x)));
  for (float x = -119; x < 119; x += 0.37F) EXPECT_NEAR(portable::exp2(x) / std::exp2(static_cast<double>(x)), 1, 3e-7);
  EXPECT_NEAR(portable::pow(10, -0.21), std::pow(10, -0.21), 1e-15);
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "editor/model/coverage_view.h"
#include "editor/model/deviation_view.h"
#include "editor/model/expected_view.h"
#include "editor/model/view_state.h"

namespace standpoint {
namespace {

// Colours that people without red, green or blue cones tell apart (Machado, Oliveira and Fernandes 2009, all of
// the cone's sensitivity lost; distances in CIELAB).
using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;
constexpr std::array<Matrix, 4> kEyes = {
    Matrix{Triple{1, 0, 0}, Triple{0, 1, 0}, Triple{0, 0, 1}},
    Matrix{Triple{0.152286, 1.052583, -0.204868}, Triple{0.114503, 0.786281, 0.099216},
           Triple{-0.003882, -0.048116, 1.051998}},
    Matrix{Triple{0.367322, 0.860646, -0.227968}, Triple{0.280085, 0.672501, 0.047413},
           Triple{-0.011820, 0.042940, 0.968881}},
    Matrix{Triple{1.255528, -0.076749, -0.178779}, Triple{-0.078411, 0.930809, 0.147602},
           Triple{0.004733, 0.691367, 0.303900}}};
constexpr Matrix kXyz = {Triple{0.4124564, 0.3575761, 0.1804375}, Triple{0.2126729, 0.7151522, 0.0721750},
                         Triple{0.0193339, 0.1191920, 0.9503041}};
constexpr double kTold = 12;  // CIELAB: neighbours on a map, seen apart from each other

Triple times(const Matrix& m, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Triple seen(const std::array<std::uint8_t, 4>& colour, const Matrix& eye) {
  Triple linear{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = colour[i] / 255.0;
    linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  linear = times(eye, linear);
  for (auto& c : linear) c = std::clamp(c, 0.0, 1.0);
  Triple xyz = times(kXyz, linear);
  constexpr Triple kWhite = {0.95047, 1, 1.08883};
  for (std::size_t i = 0; i < 3; ++i) {
    const double f = xyz[i] / kWhite[i];
    xyz[i] = f > 0.008856 ? std::cbrt(f) : 7.787 * f + 16.0 / 116;
  }
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

double distance(const Triple& a, const Triple& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

using Colours = std::vector<std::array<std::uint8_t, 4>>;

void expectToldApart(const Colours& colours, const char* what) {
  for (std::size_t eye = 0; eye < kEyes.size(); ++eye)
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t j = i + 1; j < colours.size(); ++j)
        EXPECT_GT(distance(seen(colours[i], kEyes[eye]), seen(colours[j], kEyes[eye])), kTold)
            << what << ": " << i << " and " << j << " for eye " << eye;
}

template <class Scale>
void expectScale(const Scale& scale, const char* what) {
  for (std::size_t eye = 0; eye < kEyes.size(); ++eye)
    for (int i = 0; i <= 32; ++i)
      for (int j = i + 8; j <= 32; ++j)
        EXPECT_GT(distance(seen(scale(i / 32.0), kEyes[eye]), seen(scale(j / 32.0), kEyes[eye])), kTold)
            << what << ": " << i << " and " << j << " of 32 for eye " << eye;
}

std::array<std::uint8_t, 4> bytes(const Colour& c) {
  const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(x * 255)); };
  return {byte(c.r), byte(c.g), byte(c.b), 255};
}

TEST(ColourMaps, AreToldApartByPeopleWhoLackACone) {
  expectScale([](double x) { return scaleColour(ExpectedQuantity::intensity, x); }, "expected intensity");
  expectScale([](double x) { return scaleColour(ExpectedQuantity::noise, x); }, "expected noise");
  expectScale([](double x) { return deviationColour(x, 1); }, "deviation");
  expectScale(coverageScale, "point spacing and incidence");
  expectScale([](double x) { return bytes(confidenceColour(x)); }, "confidence");
}

TEST(ColourMaps, OfKindsAreToldApartByPeopleWhoLackACone) {
  Colours counts = {kHoleColour};
  for (int n = 1; n <= kMostCounted; ++n) counts.push_back(countColour(n));
  expectToldApart(counts, "number of stations");
  Colours fates;
  for (const auto fate : {ReturnFate::returned, ReturnFate::too_weak, ReturnFate::seen_through, ReturnFate::hidden,
                          ReturnFate::too_near, ReturnFate::too_far})
    fates.push_back(fateColour(fate));
  expectToldApart(fates, "detections");
  expectToldApart({bytes(confidenceColour(-1)), bytes(confidenceColour(0.2)), bytes(confidenceColour(0.65)),
                   bytes(confidenceColour(1))},
                  "confidence with what has no material");
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/format.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standpoint {

std::string clockText(double seconds) {
  const auto whole = std::lround(std::clamp(seconds, 0.0, 1e9));
  if (whole >= 3600) return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02d}", whole / 60, whole % 60);
}

std::string bytesText(double bytes) {
  const double size = std::abs(bytes);
  if (size >= 1e12) return fmt::format("{:.1f} TB", bytes / 1e12);
  return size >= 1e9 ? fmt::format("{:.1f} GB", bytes / 1e9) : fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string pointsText(double points) {
  return points >= 1e5 ? fmt::format("{:.1f} M", points / 1e6) : fmt::format("{:.0f}", points);
}

std::string lengthText(double metres, bool feet) {
  return feet ? fmt::format("{:.2f} ft", metres / kMetresPerFoot) : fmt::format("{:.2f} m", metres);
}

std::string smallLengthText(double metres, bool feet) {
  return feet ? fmt::format("{:.3f} in", metres / kMetresPerFoot * 12) : fmt::format("{:.1f} mm", metres * 1000);
}

std::string factText(const Fact& fact, FactUnit unit, bool feet) {
  if (!fact.number) return fact.text;
  const double n = *fact.number;
  switch (unit) {
    case FactUnit::none: return fmt::format("{:g}", n);
    case FactUnit::fraction: return fmt::format("{:.0f} %", n * 100);
    case FactUnit::seconds: return clockText(n);
    case FactUnit::bytes: return bytesText(n);
    case FactUnit::points: return pointsText(n);
    case FactUnit::metres: return lengthText(n, feet);
    case FactUnit::degrees: return fmt::format("{:.3f}°", n);
    case FactUnit::celsius: return feet ? fmt::format("{:.0f} °F", n * 1.8 + 32) : fmt::format("{:.0f} °C", n);
    case FactUnit::millimetres: return smallLengthText(n / 1000, feet);
  }
  return fact.text;
}

}  // namespace standpoint

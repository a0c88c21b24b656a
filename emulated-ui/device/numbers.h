// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace standpoint {

// The finite number that the whole text is; nothing when it is none.
inline std::optional<double> numberIn(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// "1.5,-0.4,180"; nothing when a part is no number.
inline std::optional<std::vector<double>> numbersIn(std::string_view text) {
  std::vector<double> all;
  while (true) {
    const auto comma = text.find(',');
    const auto number = numberIn(text.substr(0, comma));
    if (!number) return std::nullopt;
    all.push_back(*number);
    if (comma == std::string_view::npos) return all;
    text.remove_prefix(comma + 1);
  }
}

// One step up or down: in the place of the last digit that is shown, so that 0.04 becomes 0.05 and 30 becomes 31.
inline std::string stepped(std::string_view text, int steps, double minimum, double maximum) {
  const auto point = text.find('.');
  const auto decimals = point == std::string_view::npos ? 0 : text.size() - point - 1;
  const double value = numberIn(text).value_or(0) + steps * std::pow(10.0, -static_cast<double>(decimals));
  return fmt::format("{:.{}f}", std::clamp(value, minimum, std::max(minimum, maximum)), decimals);
}

}  // namespace standpoint

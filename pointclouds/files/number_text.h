// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

// The shortest text that reads back as the same number to the last bit, whatever the locale.
template <class T>
void appendNumber(std::string& text, T value) {
  char digits[40];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// `decimals` digits behind the point (at most 9), rounded; for many numbers, as fast as can be.
inline void appendFixed(std::string& text, double value, unsigned decimals) {
  constexpr double kPower[10] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
  const double scaled = std::abs(value) * kPower[decimals] + 0.5;
  if (!(scaled < 9e15)) return appendNumber(text, value);  // a double has no finer steps
  auto rest = static_cast<std::uint64_t>(scaled);
  char digits[32];
  char* at = digits + sizeof digits;
  const bool negative = value < 0 && rest > 0;
  for (unsigned i = 0; i < decimals; ++i, rest /= 10) *--at = static_cast<char>('0' + rest % 10);
  if (decimals > 0) *--at = '.';
  do *--at = static_cast<char>('0' + rest % 10);
  while ((rest /= 10) > 0);
  if (negative) *--at = '-';
  text.append(at, digits + sizeof digits);
}

// Reads back as the same float to the last bit, as appendNumber's shortest text does, in half the time: as many
// decimals as make a step smaller than that between floats of this size.
inline void appendFloat(std::string& text, float value) {
  const float size = std::abs(value);
  if (!(size >= 0x1p-6F && size < 0x1p20F)) return appendNumber(text, value);
  appendFixed(text, static_cast<double>(value),
              size < 0x1p-3F ? 9
              : size < 1     ? 8
              : size < 16    ? 7
              : size < 128   ? 6
              : size < 1024  ? 5
                             : 4);
}

template <class T>
std::string numberText(T value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

inline std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r\n");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r\n") - from + 1);
}

// The whole of `text`, blanks around it and a leading '+' allowed.
template <class T>
std::optional<T> numberFrom(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
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

// The numbers of a line between blanks, commas and semicolons; false when something there is none or they are more than
// `most`. Fills `numbers` anew.
inline bool numbersOf(std::string_view line, std::size_t most, std::vector<double>& numbers) {
  numbers.clear();
  for (;;) {
    const auto from = line.find_first_not_of(" \t\r,;");
    if (from == std::string_view::npos) return true;
    const auto end = std::min(line.find_first_of(" \t\r,;", from), line.size());
    const auto value = numberFrom<double>(line.substr(from, end - from));
    if (!value || numbers.size() == most) return false;
    numbers.push_back(*value);
    line.remove_prefix(end);
  }
}

}  // namespace standpoint

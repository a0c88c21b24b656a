// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_breaks.h"

#include <algorithm>
#include <iterator>

namespace standpoint {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isSpace(char c) { return c == ' ' || c == '\n'; }

std::size_t beginOfWord(std::string_view text, std::size_t at) {
  while (at > 0 && !isSpace(text[at - 1])) --at;
  return at;
}

}  // namespace

bool isUnit(std::string_view word) {
  static constexpr std::string_view kUnits[] = {"m",   "mm",  "cm", "km", "m²", "m³",  "mm²", "nm",   "px",   "%",
                                                "°",   "gon", "s",  "ms", "h",  "min", "rad", "mrad", "dB",   "Hz",
                                                "kHz", "kB",  "MB", "GB", "TB", "m/s", "°/s", "mm/m", "inch", "м",
                                                "мм",  "см",  "с",  "хв", "МБ", "ГБ",  "м/с"};
  const auto end = word.find_last_not_of(".,;:!?)");
  return std::find(std::begin(kUnits), std::end(kUnits), word.substr(0, end + 1)) != std::end(kUnits);
}

std::size_t beginOfNumber(std::string_view text, std::size_t at) {
  if (at >= text.size()) return at;
  const auto begin = beginOfWord(text, at);
  if (begin < at) {
    const auto before = text.substr(begin, at - begin);
    return isDigit(text[at]) && std::any_of(before.begin(), before.end(), isDigit) ? begin : at;
  }
  const auto unit = text.substr(at, std::min(text.find_first_of(" \n", at), text.size()) - at);
  if (at < 2 || text[at - 1] != ' ' || !isDigit(text[at - 2]) || !isUnit(unit)) return at;
  return beginOfWord(text, at - 1);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/words/figures.h"

#include <algorithm>
#include <array>

#include "core/number_breaks.h"
#include "core/number_text.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

bool isDigitAt(std::string_view text, std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; }

std::size_t endOfDigits(std::string_view text, std::size_t at) {
  while (isDigitAt(text, at)) ++at;
  return at;
}

// Behind the number that begins there; `at` where none does.
std::size_t endOfNumber(std::string_view text, std::size_t at) {
  const auto begin = at;
  for (const std::string_view sign : {"-", "−", "+"})
    if (text.substr(at).starts_with(sign)) at += sign.size();
  const auto whole = endOfDigits(text, at);
  if (whole == at) return begin;
  return whole < text.size() && text[whole] == '.' && isDigitAt(text, whole + 1) ? endOfDigits(text, whole + 1) : whole;
}

// Whether a number may begin there: not within a name, a version or a list.
bool standsFree(std::string_view text, std::size_t at) {
  static constexpr std::array<std::string_view, 15> kBefore = {" ", "\n", "\t", "(", "[", "-", "−", "+",
                                                               "±", "–",  "≥",  "≤", "<", ">", "~"};
  const auto before = text.substr(0, at);
  return before.empty() ||
         std::any_of(kBefore.begin(), kBefore.end(), [&](auto sign) { return before.ends_with(sign); });
}

// Of a table, but not of its first column.
bool isField(std::string_view text, std::size_t begin, std::size_t end) {
  if (begin > 0 && text[begin - 1] == '-') --begin;
  return begin > 0 && text[begin - 1] == '\t' && (end == text.size() || text[end] == '\t' || text[end] == '\n');
}

}  // namespace

std::string asFigure(std::string number) {
  if (const auto point = number.find('.'); point > 0 && isDigitAt(number, point - 1) && isDigitAt(number, point + 1))
    number[point] = decimalSign();
  return number;
}

bool isFigure(std::string_view text) {
  return text.find('.') != std::string_view::npos && endOfNumber(text, 0) == text.size();
}

bool hasUnit(std::string_view text, std::size_t end) {
  const auto rest = text.substr(std::min(end, text.size()));
  const auto unit = rest.starts_with(' ') ? rest.substr(1) : rest;
  if (isUnit(unit.substr(0, unit.find_first_of(" \n\t")))) return true;
  if (rest.starts_with(" ×")) return true;  // so many times, or by so many
  for (const std::string_view between : {" to ", " and ", " ± ", " – ", "–", " … ", "  "})
    if (rest.starts_with(between)) {
      const auto next = end + between.size(), behind = endOfNumber(text, next);
      if (behind > next) return hasUnit(text, behind);
    }
  return false;
}

std::string countsIn(std::string text) {
  static constexpr std::array<std::string_view, 34> kCounted = {
      "points",    "triangles", "products",  "files",       "faces",   "vertices",  "elements", "surfaces", "collision",
      "shapes",    "nodes",     "lines",     "entries",     "samples", "times",     "colours",  "meshes",   "pulses",
      "returns",   "rays",      "cells",     "places",      "pixels",  "numbers",   "entities", "bodies",   "objects",
      "instances", "indices",   "positions", "intensities", "similar", "duplicate", "distinct"};
  constexpr std::size_t kUngrouped = 3;  // digits
  const auto counts = [&](std::size_t end) {
    const auto rest = std::string_view(text).substr(end);
    if (!rest.starts_with(' ')) return false;
    const auto word = rest.substr(1, rest.find_first_of(" ,;.:()\n", 1) - 1);
    return std::find(kCounted.begin(), kCounted.end(), word) != kCounted.end();
  };
  for (std::size_t begin = 0; begin < text.size(); ++begin) {
    const auto end = endOfDigits(text, begin);
    if (end == begin) continue;
    const auto last = endOfDigits(text, end + 4);
    const auto rest = std::string_view(text).substr(end, 4);
    const bool of_many = (rest == " of " || rest == " to ") && last > end + 4 && counts(last);
    if (end - begin > kUngrouped && end - begin < 19 && standsFree(text, begin) && (counts(end) || of_many)) {
      const auto grouped = groupedDigits(std::stoull(text.substr(begin, end - begin)));
      text.replace(begin, end - begin, grouped);
      begin += grouped.size();
    } else {
      begin = end;
    }
  }
  return text;
}

std::string figuresIn(std::string text) {
  if (decimalSign() == '.') return text;
  for (auto point = text.find('.'); point != std::string::npos; point = text.find('.', point + 1)) {
    auto begin = point;
    while (begin > 0 && isDigitAt(text, begin - 1)) --begin;
    if (begin == point || !isDigitAt(text, point + 1) || !standsFree(text, begin)) continue;
    const auto end = endOfDigits(text, point + 1);
    if (hasUnit(text, end) || isField(text, begin, end)) text[point] = decimalSign();
  }
  return text;
}

}  // namespace standpoint

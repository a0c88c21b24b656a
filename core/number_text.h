// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "core/result.h"

namespace standpoint {

// What a number that somebody types is measured in, and what it may be.
struct NumberKind {
  std::string_view unit = {};  // "m", "mm", "°", "%" …; empty: a plain number
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool whole = false;  // no fractions
};

// The number that a text stands for, in kind.unit; else in plain words why it stands for none that may be.
//
// A text is an expression with + - * / and parentheses, e.g. "3.4-35cm" or "(1,2 + 0,4) / 2". A number without a unit
// has the kind's own; lengths may be given in mm, cm, m, km or ft, angles in °. Decimal point and decimal comma are
// both read: of two different signs the last one is decimal and the other groups thousands ("1.234,5"), a lone one is
// always decimal.
Result<double> numberFromText(std::string_view text, const NumberKind& kind = {});

// "0.05 to 1 m", "0 m or more": what the kind lets through; empty when that is every number.
std::string rangeText(const NumberKind& kind);

// The shortest text that reads as this number again, without a unit: "0.1", "25", "1e-07".
std::string exactText(double number);

std::string groupedDigits(std::uint64_t number);  // "12 345 678"

}  // namespace standpoint

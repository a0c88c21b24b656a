// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_text.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace standpoint {

namespace {

struct LengthUnit {
  std::string_view name;
  double metres;
};
constexpr std::array kLengths = {LengthUnit{"mm", 1e-3}, LengthUnit{"cm", 1e-2}, LengthUnit{"m", 1},
                                 LengthUnit{"km", 1e3}, LengthUnit{"ft", 0.3048}};

constexpr std::size_t kLongest = 500;  // a reader that calls itself must not run out of stack

std::optional<double> metresOf(std::string_view unit) {
  for (const auto& length : kLengths)
    if (length.name == unit) return length.metres;
  return std::nullopt;
}

bool isAngle(std::string_view unit) { return unit == "°" || unit == "deg"; }

bool digit(char c) { return c >= '0' && c <= '9'; }
bool separator(char c) { return c == '.' || c == ','; }

// What a part of an expression comes to, in the unit that is wanted. A factor ("2 *") has none.
struct Quantity {
  double number = 0;
  bool measured = false;
};

// Recursive descent: a sum of products of signed numbers and parentheses.
class Reader {
 public:
  Reader(std::string_view text, std::string_view unit) : text_(text), unit_(unit) {}

  Result<double> whole() {
    TRY_ASSIGN(const Quantity all, sum());
    skipSpace();
    if (at_ < text_.size()) return unreadable();
    if (!std::isfinite(all.number)) return wrong("Division by zero, or a number too large");
    return all.number;
  }

 private:
  static tl::unexpected<Error> wrong(std::string why) { return failure(ErrorKind::usage, std::move(why)); }
  tl::unexpected<Error> unreadable() const {
    if (at_ >= text_.size()) return wrong("Incomplete: a number is missing at the end");
    return wrong(fmt::format("Cannot read '{}'", text_.substr(at_)));
  }

  void skipSpace() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool takes(std::string_view sign) {
    skipSpace();
    if (text_.substr(at_, sign.size()) != sign) return false;
    at_ += sign.size();
    return true;
  }
  bool takesMinus() { return takes("-") || takes("−"); }

  Result<Quantity> sum() {
    TRY_ASSIGN(Quantity left, product());
    while (true) {
      const bool plus = takes("+");
      if (!plus && !takesMinus()) return left;
      TRY_ASSIGN(const Quantity right, product());
      left = {plus ? left.number + right.number : left.number - right.number, left.measured || right.measured};
    }
  }

  Result<Quantity> product() {
    TRY_ASSIGN(Quantity left, signedPart());
    while (true) {
      const bool times = takes("*") || takes("×");
      if (!times && !takes("/")) return left;
      TRY_ASSIGN(const Quantity right, signedPart());
      if (times && left.measured && right.measured) return wrong("Two units cannot be multiplied");
      if (!times && right.measured && !left.measured) return wrong("A number cannot be divided by one with a unit");
      left = {times ? left.number * right.number : left.number / right.number,
              times ? left.measured || right.measured : left.measured && !right.measured};
    }
  }

  Result<Quantity> signedPart() {
    if (takes("+")) return signedPart();
    if (!takesMinus()) return part();
    TRY_ASSIGN(const Quantity after, signedPart());
    return Quantity{-after.number, after.measured};
  }

  Result<Quantity> part() {
    if (takes("(")) {
      TRY_ASSIGN(const Quantity inside, sum());
      if (!takes(")")) return wrong("A ')' is missing");
      return withUnit(inside);
    }
    skipSpace();
    if (at_ >= text_.size() || (!digit(text_[at_]) && !separator(text_[at_]))) return unreadable();
    TRY_ASSIGN(const double figures, number());
    return withUnit({figures, false});
  }

  // Digits and separators, perhaps with an exponent.
  Result<double> number() {
    const auto from = at_;
    while (at_ < text_.size() && (digit(text_[at_]) || separator(text_[at_]))) ++at_;
    TRY_ASSIGN(std::string plain, withoutGroups(text_.substr(from, at_ - from)));
    plain += exponent();
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (error == std::errc::result_out_of_range) return wrong(fmt::format("'{}' is too large", plain));
    if (error != std::errc() || end != plain.data() + plain.size())
      return wrong(fmt::format("Cannot read '{}'", text_.substr(from)));
    return value;
  }

  std::string exponent() {
    auto end = at_;
    if (end >= text_.size() || (text_[end] != 'e' && text_[end] != 'E')) return {};
    ++end;
    if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
    if (end >= text_.size() || !digit(text_[end])) return {};
    const bool positive = text_[at_ + 1] == '+';
    while (end < text_.size() && digit(text_[end])) ++end;
    const auto digits = text_.substr(at_ + (positive ? 2 : 1), end - at_ - (positive ? 2 : 1));
    at_ = end;
    return "e" + std::string(digits);
  }

  // The last separator is the decimal sign; those before it are of the other kind and group thousands.
  static Result<std::string> withoutGroups(std::string_view figures) {
    const auto last = figures.find_last_of(".,");
    if (last == std::string_view::npos) return std::string(figures);
    std::string plain;
    for (std::size_t i = 0; i < last; ++i) {
      if (!separator(figures[i])) {
        plain += figures[i];
        continue;
      }
      const auto next = figures.find_first_of(".,", i + 1);
      if (figures[i] == figures[last] || i == 0 || next != i + 4)
        return wrong(fmt::format("'{}' has more than one decimal sign", figures));
    }
    return plain + "." + std::string(figures.substr(last + 1));
  }

  Result<Quantity> withUnit(Quantity quantity) {
    skipSpace();
    const auto from = at_;
    if (text_.substr(at_, unit_.size()) == unit_ && !unit_.empty() && !letterAt(at_ + unit_.size())) {
      at_ += unit_.size();  // its own, whatever that is
    } else if (takes("°")) {
    } else {
      while (letterAt(at_)) ++at_;
    }
    const auto written = text_.substr(from, at_ - from);
    if (written.empty()) return quantity;
    if (quantity.measured) return wrong(fmt::format("Two units: '{}'", written));
    if (written == unit_ || (isAngle(written) && isAngle(unit_))) return Quantity{quantity.number, true};
    const auto given = metresOf(written), wanted = metresOf(unit_);
    if (given && wanted) return Quantity{quantity.number * (*given / *wanted), true};
    if (!given && !isAngle(written)) return wrong(fmt::format("Unknown unit '{}'", written));
    return wrong(unit_.empty() ? fmt::format("A plain number is expected, without '{}'", written)
                               : fmt::format("'{}' does not fit: the unit is {}", written, unit_));
  }

  bool letterAt(std::size_t i) const {
    return i < text_.size() && std::isalpha(static_cast<unsigned char>(text_[i])) != 0;
  }

  std::string_view text_, unit_;
  std::size_t at_ = 0;
};

std::string withUnitOf(const NumberKind& kind, const std::string& text) {
  if (kind.unit.empty()) return text;
  return text + (kind.unit == "°" ? "" : " ") + std::string(kind.unit);
}

}  // namespace

Result<double> numberFromText(std::string_view text, const NumberKind& kind) {
  if (text.find_first_not_of(" \t") == std::string_view::npos) return failure(ErrorKind::usage, "Enter a number");
  if (text.size() > kLongest) return failure(ErrorKind::usage, "Too long");
  TRY_ASSIGN(const double number, Reader(text, kind.unit).whole());
  if (kind.whole && number != std::round(number)) return failure(ErrorKind::usage, "Whole numbers only");
  if (!(number >= kind.least && number <= kind.most)) return failure(ErrorKind::usage, "Allowed: " + rangeText(kind));
  return number;
}

std::string rangeText(const NumberKind& kind) {
  constexpr double kEnd = 1e300;  // what verbs say for "no limit"
  const bool from = kind.least > -kEnd, to = kind.most < kEnd;
  if (from && to) return withUnitOf(kind, fmt::format("{} to {}", exactText(kind.least), exactText(kind.most)));
  if (from) return withUnitOf(kind, exactText(kind.least)) + " or more";
  return to ? withUnitOf(kind, exactText(kind.most)) + " or less" : std::string();
}

std::string exactText(double number) {
  for (const int digits : {12, 15, 16, 17})
    if (auto text = fmt::format("{:.{}g}", number, digits); digits == 17 || std::stod(text) == number) return text;
  return {};
}

std::string groupedDigits(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

}  // namespace standpoint

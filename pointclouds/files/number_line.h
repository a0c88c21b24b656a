// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "pointclouds/files/number_text.h"

namespace standpoint {

// Reads the numbers of a line between blanks, or also between commas and semicolons: the same to the last bit as
// std::from_chars makes of each word.
enum class Between { blanks, blanks_and_commas };
template <Between between>
class NumberLine {
 public:
  explicit NumberLine(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

  enum class Word { number, none, end };  // none: something that is no number
  Word next(double& value) {
    while (at_ != end_ && isBetween(*at_)) ++at_;
    if (at_ == end_) return Word::end;
    const char* const word = at_;
    if (short_(value) && (at_ == end_ || isBetween(*at_))) return Word::number;
    for (at_ = word; at_ != end_ && !isBetween(*at_);) ++at_;
    const auto number = numberFrom<double>({word, static_cast<std::size_t>(at_ - word)});
    value = number.value_or(0);
    return number ? Word::number : Word::none;
  }
  // Passes a word by, whatever it is; false when there is none.
  bool skip() {
    while (at_ != end_ && isBetween(*at_)) ++at_;
    const char* const word = at_;
    while (at_ != end_ && !isBetween(*at_)) ++at_;
    return at_ != word;
  }

 private:
  static bool isBetween(char c) {
    constexpr auto bit = [](char of) { return std::uint64_t{1} << static_cast<unsigned>(of); };
    constexpr std::uint64_t kBlanks = bit(' ') | bit('\t') | bit('\r') | bit('\n');
    constexpr std::uint64_t kAll = between == Between::blanks ? kBlanks : kBlanks | bit(',') | bit(';');
    const auto code = static_cast<unsigned char>(c);
    return code < 64 && (kAll >> code & 1U) != 0;
  }
  static bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

  // One by one: eight at once by arithmetic on a word was a tenth slower, since few words have eight.
  void takeDigits(std::uint64_t& digits) {
    for (; at_ != end_ && isDigit(*at_); ++at_) digits = 10 * digits + static_cast<std::uint64_t>(*at_ - '0');
  }

  // A number of few digits: its digits as an integer and a power of ten are both exact as doubles, so that one division
  // rounds once. False when it is another; then `at_` is anywhere in the word.
  bool short_(double& value) {
    constexpr double kPower[] = {1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    constexpr int kLargestPower = 22, kMostDigits = 18;
    constexpr std::uint64_t kLargestExact = std::uint64_t{1} << 53U;
    const bool negative = *at_ == '-';
    if (negative) ++at_;
    std::uint64_t digits = 0;
    const char* const from = at_;
    takeDigits(digits);
    auto count = at_ - from;
    int exponent = 0;
    if (at_ != end_ && *at_ == '.') {
      const char* const behind = ++at_;
      takeDigits(digits);
      count += at_ - behind;
      if (count > kMostDigits) return false;  // before the place of the point is made an int
      exponent = -static_cast<int>(at_ - behind);
    }
    if (count == 0 || count > kMostDigits || digits > kLargestExact) return false;
    if (at_ != end_ && (*at_ == 'e' || *at_ == 'E')) {
      if (++at_ == end_) return false;
      const bool down = *at_ == '-';
      if (down || *at_ == '+') ++at_;
      int power = 0;
      const char* const first = at_;
      for (; at_ != end_ && isDigit(*at_) && at_ - first < 3; ++at_) power = 10 * power + (*at_ - '0');
      if (at_ == first) return false;
      exponent += down ? -power : power;
    }
    if (exponent > kLargestPower || exponent < -kLargestPower) return false;
    const auto whole = static_cast<double>(digits);
    const double size = exponent < 0 ? whole / kPower[-exponent] : whole * kPower[exponent];
    value = negative ? -size : size;
    return true;
  }

  const char* at_;
  const char* end_;
};

// The numbers of a line between blanks, commas and semicolons; false when something there is none or they are more than
// `most`. Fills `numbers` anew.
inline bool numbersOf(std::string_view line, std::size_t most, std::vector<double>& numbers) {
  numbers.clear();
  using Words = NumberLine<Between::blanks_and_commas>;
  Words words(line);
  double value = 0;
  for (;;) {
    const auto word = words.next(value);
    if (word == Words::Word::end) return true;
    if (word == Words::Word::none || numbers.size() == most) return false;
    numbers.push_back(value);
  }
}

}  // namespace standpoint

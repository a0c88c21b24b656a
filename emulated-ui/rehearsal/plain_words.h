// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/rehearsal/exercise.h"

namespace standpoint {

class Device;

// What people read of an exercise's facts and conditions, in a language: on the certificate and in its texts.
struct PlainWords {
  const Device& device;
  const Exercise& exercise;
  std::string language;

  // "Stored setups in the project", of "setups"; the fact's own name where nothing calls it otherwise.
  std::string name(const std::string& fact) const;
  // With its unit, in as few digits as show on which side of each of `limits` it is, three at least.
  std::string figure(const std::string& fact, double value, const std::vector<double>& limits) const;
  // A figure as `figure` has it, a choice by its label; a dash where there is none.
  std::string value(const std::string& fact, const std::optional<Fact>& is, const std::vector<double>& limits) const;
  // "Tilt: at most 2°; Compensator: On"
  std::string condition(const Condition& condition) const;

 private:
  std::string word(const std::string& key) const;  // of the device or of all; empty: there is none
  std::string fill(const char* pattern, std::initializer_list<std::pair<const char*, std::string>> places) const;
  std::string labelOf(const std::string& widget_id) const;
  std::string choice(const std::string& fact, const std::string& value) const;
};

// Of a fact: "mm", "°"; empty: it has none.
std::string unitOf(const Device& device, const std::string& fact);
std::string withUnit(const std::string& number, const std::string& unit);  // "2.7°", "6 mm"
// The numbers that the condition compares the fact with.
std::vector<double> limitsOf(const Condition& condition, const std::string& fact);

// Figures in a text: "{orientation.plan}" is a fact with its unit, "{orientation.azimuth / 57.3 * 20000 : 0} mm" is
// computed from facts and numbers with + - * / and brackets, with so many decimals, without them in three digits. Signs
// between facts stand between blanks.
std::vector<std::string> factsInText(const std::string& text);
// An error says what is wrong with a figure of the text.
Result<void> checkFigures(const std::string& text);
// A figure without a value is a dash.
std::string filledFigures(const std::string& text, const PlainWords& words, const FactLookup& facts);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "project/fields.h"
#include "survey/registration/registration.h"

namespace standpoint {

std::span<const Choice<TargetMatching>> choices(TargetMatching);

// "x,y,turn": an offset in plan, m, and a turn about itself, degrees.
struct StartOffset {
  double x_m = 0, y_m = 0, turn_deg = 0;
};
template <>
struct FieldValue<StartOffset> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<StartOffset> read(const nlohmann::json& text);
  static nlohmann::json write(const StartOffset& offset);
};

struct RegisterOptions {
  std::vector<std::filesystem::path> files;
  std::string fix;  // station that keeps its pose; empty: the first
  TargetMatching by = TargetMatching::by_names;
  std::filesystem::path control;
  bool cloud = false;
  std::filesystem::path output;
  double reach_m = 0.5;                     // of `cloud`
  std::optional<StartOffset> start_offset;  // likewise
  double click_m = MeasuringRequest{}.click_m;
  std::uint64_t seed = 1;
};
const Fields<RegisterOptions>& registerFields();
Result<Outcome> runRegister(const Document& document, const RegisterOptions& options, Progress& progress);

}  // namespace standpoint

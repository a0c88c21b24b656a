// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/quality_limits.h"

#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {

namespace {

struct LimitRow {
  const char *id, *label, *unit;
  bool more_is_better;
  struct Pair {
    double good, bad;
  };
  Pair by_profile[3];  // LOA20, LOA30, LOA40
  const char* source;
};

constexpr const char* kOurs = "a choice of ours";
constexpr const char* kLink = "a choice of ours for LOA30, scaled to the profile";

// docs/explanation/quality.md says where each comes from.
constexpr std::array kRows = {
    LimitRow{"coverage", "Coverage", "%", true, {{95, 85}, {95, 85}, {95, 85}}, kOurs},
    LimitRow{"coverage_twice", "Seen by two stations", "%", true, {{50, 25}, {50, 25}, {50, 25}}, kOurs},
    LimitRow{"overlap", "Weakest overlap", "%", true, {{40, 25}, {40, 25}, {40, 25}}, kOurs},
    LimitRow{
        "spacing", "Spacing, 95 %", "mm", false, {{25, 50}, {13, 25}, {6, 13}}, "smallest part of GSA BIM guide 03"},
    LimitRow{"incidence", "Incidence, 95 %", "°", false, {{60, 75}, {60, 75}, {60, 75}}, "Soudarissanane 2009"},
    LimitRow{"deviation_median", "Deviation, median", "mm", false, {{10, 20}, {3, 6}, {1, 2}}, kLink},
    LimitRow{"deviation_95", "Deviation, 95 %", "mm", false, {{50, 100}, {15, 30}, {5, 10}}, "USIBD LOA at 95 %"},
    LimitRow{"stray", "Stray points", "%", false, {{1, 5}, {1, 5}, {1, 5}}, kOurs},
    LimitRow{"noise", "Noise / expected", "×", false, {{1.2, 2}, {1.2, 2}, {1.2, 2}}, kOurs},
    LimitRow{"pose_position", "Position error", "mm", false, {{10, 20}, {3, 6}, {1, 2}}, kLink},
    LimitRow{"pose_rotation", "Rotation error", "°", false, {{0.03, 0.06}, {0.01, 0.02}, {0.003, 0.006}}, kLink},
    LimitRow{"targets", "Targets per station", "", true, {{3, 2}, {3, 2}, {3, 2}}, "three targets hold a station"},
};

void readLimit(JsonFields& fields, QualityLimit& limit) {
  limit.good = fields.numberOr("good", limit.good, 0, 1e6);
  limit.bad = fields.numberOr("bad", limit.bad, 0, 1e6);
  if (limit.more_is_better ? limit.good < limit.bad : limit.good > limit.bad)
    fields.wrong("good", fmt::format("{:g} is worse than what is already bad, {:g}", limit.good, limit.bad));
  limit.source = "limits file";
}

}  // namespace

const char* nameOf(Verdict verdict) {
  constexpr const char* kNames[] = {"good", "warn", "bad", "unknown"};
  return kNames[static_cast<int>(verdict)];
}

QualityLimits qualityLimits(QualityProfile profile) {
  QualityLimits limits;
  for (const auto& row : kRows) {
    const auto& pair = row.by_profile[static_cast<int>(profile)];
    limits.push_back({row.id, row.label, row.unit, row.more_is_better, pair.good, pair.bad, row.source});
  }
  return limits;
}

Result<QualityLimits> readQualityLimits(const std::filesystem::path& file, QualityLimits defaults) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(file.filename().string());
  JsonFields fields(fault, json, "");
  for (auto& limit : defaults) fields.object(limit.id, [&](JsonFields& one) { readLimit(one, limit); });
  fields.close();
  TRY(fault.result());
  return defaults;
}

Verdict verdictOf(const QualityLimit& limit, double value) {
  const double sign = limit.more_is_better ? 1 : -1;
  if (sign * value >= sign * limit.good) return Verdict::good;
  return sign * value >= sign * limit.bad ? Verdict::warn : Verdict::bad;
}

std::string goodText(const QualityLimit& limit) {
  return fmt::format("{} {:g}{}{}", limit.more_is_better ? "≥" : "≤", limit.good, limit.unit.empty() ? "" : " ",
                     limit.unit);
}

std::string badText(const QualityLimit& limit) {
  return fmt::format("{} {:g}{}{}", limit.more_is_better ? "<" : ">", limit.bad, limit.unit.empty() ? "" : " ",
                     limit.unit);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace standpoint {

enum class Verdict { good, warn, bad, unknown };
const char* nameOf(Verdict verdict);

// Levels of accuracy of the USIBD, which say how much of the millimetres in the limits.
enum class QualityProfile { loa20, loa30, loa40 };

// Up to where a figure is good, and from where on it is bad; in between it is worth a look.
struct QualityLimit {
  std::string id, label, unit;  // "coverage", "Coverage", "%"
  bool more_is_better = false;
  double good = 0, bad = 0;
  std::string source;
};
using QualityLimits = std::vector<QualityLimit>;  // in the order of the report

QualityLimits qualityLimits(QualityProfile profile);
// {"coverage": {"good": 90, "bad": 80}, …}: what the file does not name stays. Errors name file and JSON pointer.
Result<QualityLimits> readQualityLimits(const std::filesystem::path& file, QualityLimits defaults);
Verdict verdictOf(const QualityLimit& limit, double value);
std::string goodText(const QualityLimit& limit);  // "≥ 95 %"
std::string badText(const QualityLimit& limit);   // "< 85 %"

}  // namespace standpoint

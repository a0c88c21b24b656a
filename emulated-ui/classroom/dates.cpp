// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/dates.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <optional>

#include <fmt/format.h>

namespace standpoint {

namespace {

std::string formatted(const std::tm& moment, const char* format) {
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), format, &moment);
  return text.data();
}

// Whole text by the format; days that there are not are refused.
std::optional<std::tm> parsed(const std::string& text, const char* format, int fields) {
  std::tm moment{};
  int used = -1;
  if (std::sscanf(text.c_str(), format, &moment.tm_year, &moment.tm_mon, &moment.tm_mday, &moment.tm_hour,
                  &moment.tm_min, &used) < fields)
    return std::nullopt;
  if (moment.tm_year < 2000 || moment.tm_year > 2999 || moment.tm_hour < 0 || moment.tm_hour > 23 ||
      moment.tm_min < 0 || moment.tm_min > 59)
    return std::nullopt;
  moment.tm_year -= 1900;
  moment.tm_mon -= 1;
  moment.tm_isdst = -1;
  std::tm same = moment;
  if (timegm(&same) == -1 || same.tm_mon != moment.tm_mon || same.tm_mday != moment.tm_mday) return std::nullopt;
  return moment;
}

std::optional<std::time_t> utcMoment(const std::string& text) {
  auto moment = parsed(text, "%4d-%2d-%2dT%2d:%2d", 5);
  if (!moment) return std::nullopt;
  int second = 0;
  if (text.size() >= 19 && std::sscanf(text.c_str() + 16, ":%2d", &second) == 1) moment->tm_sec = second;
  return timegm(&*moment);
}

bool shapedLike(const std::string& text, std::string_view shape) {
  if (text.size() != shape.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (shape[i] == '0' ? text[i] < '0' || text[i] > '9' : text[i] != shape[i]) return false;
  return true;
}

}  // namespace

std::string utcText(std::time_t moment) {
  std::tm utc{};
  gmtime_r(&moment, &utc);
  return formatted(utc, "%Y-%m-%dT%H:%M:%SZ");
}

std::string utcNow() { return utcText(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())); }

Result<std::string> utcFrom(const std::string& text, const std::string& option) {
  if (shapedLike(text, "0000-00-00T00:00Z") || shapedLike(text, "0000-00-00T00:00:00Z")) {
    if (const auto moment = utcMoment(text)) return utcText(*moment);
  } else if (shapedLike(text, "0000-00-00T00:00")) {
    if (auto local = parsed(text, "%4d-%2d-%2dT%2d:%2d", 5)) return utcText(std::mktime(&*local));
  } else if (shapedLike(text, "0000-00-00")) {
    if (auto local = parsed(text + "T23:59", "%4d-%2d-%2dT%2d:%2d", 5)) {
      local->tm_sec = 59;
      return utcText(std::mktime(&*local));
    }
  }
  return failure(
      ErrorKind::usage,
      fmt::format("'{}' is not a date: use 2026-12-01, 2026-12-01T18:00, or 2026-12-01T17:00Z for UTC", text), option);
}

std::string localText(const std::string& utc) {
  const auto moment = utcMoment(utc);
  if (!moment) return utc;
  std::tm local{};
  localtime_r(&*moment, &local);
  return formatted(local, "%Y-%m-%d %H:%M");
}

}  // namespace standpoint

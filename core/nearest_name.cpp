// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/nearest_name.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace standpoint {

namespace {

constexpr std::size_t kLongestCompared = 64;  // a longer one is compared by its beginning

// Letters to put in, take out or change to come from one to the other (Levenshtein).
std::size_t changes(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = corner + (a[i] == b[j] ? 0 : 1);
      corner = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// The less, the more alike: who remembers half of a name remembers its beginning.
int unlike(const std::string& written, const std::string& name) {
  const auto until = std::mismatch(written.begin(), written.end(), name.begin(), name.end()).first - written.begin();
  return 2 * static_cast<int>(changes(written, name)) - static_cast<int>(until);
}

}  // namespace

std::string knownInstead(const std::string& wanted, std::vector<std::string> known, std::size_t most) {
  if (known.empty()) return "none";
  const auto written = wanted.substr(0, kLongestCompared);
  std::stable_sort(known.begin(), known.end(),
                   [&](const std::string& a, const std::string& b) { return unlike(written, a) < unlike(written, b); });
  const bool alike = unlike(written, known.front()) <= static_cast<int>(std::max(written.size(), known.front().size()));
  std::string text = alike ? fmt::format("did you mean '{}'? ", known.front()) : std::string();
  const bool all = known.size() <= most;
  if (!all) known.resize(most);
  return text +
         fmt::format("{} {}{}", all ? "available:" : "closest matches:", fmt::join(known, ", "), all ? "" : ", …");
}

}  // namespace standpoint

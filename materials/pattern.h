// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

// Lower case without accents (Ä a, ß ss, Ø o, …), Greek and Cyrillic in lower case, everything else as it is, so that a
// pattern written one way fits names written another. At most the first kLongestName bytes, which bounds the matching.
constexpr std::size_t kLongestName = 1024;
std::string folded(std::string_view utf8);

// Globs (`*`, `?` = one character) separated by `|`.
class Pattern {
 public:
  explicit Pattern(std::string_view globs);
  bool empty() const { return folded_.empty(); }
  // Index of the first glob that fits the whole folded text, or -1.
  int fit(std::string_view folded_text) const;
  const std::string& glob(int index) const { return globs_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<std::string> globs_;  // as written
  std::vector<std::string> folded_;
};

// A class fits its own name and that of the standard case: IfcWall means IfcWallStandardCase too.
int fitClass(const Pattern& pattern, std::string_view ifc_class);

}  // namespace standpoint

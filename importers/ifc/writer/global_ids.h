// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace standpoint::ifc {

// IfcGloballyUniqueId: 128 bits as 22 digits of base 64.
bool isGlobalId(std::string_view text);

// Each of the file's GlobalIds once. What has none is given one that depends on nothing but its key and the project, so
// that the same model is the same file.
class GlobalIds {
 public:
  explicit GlobalIds(std::string project) : project_(std::move(project)) {}
  // The stated one where it is a GlobalId that nothing else has, else a made one.
  std::string keep(const std::string& stated, std::string_view key);
  std::string make(std::string_view key);
  std::size_t replaced() const { return replaced_; }  // stated ones that could not be kept

 private:
  std::string project_;
  std::set<std::string> used_;
  std::size_t replaced_ = 0;
};

}  // namespace standpoint::ifc

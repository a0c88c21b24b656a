// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/global_ids.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "core/sha256.h"

namespace standpoint::ifc {
namespace {

constexpr std::string_view kDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
constexpr std::size_t kLength = 22;

// Two bits, then 21 times six.
std::string idOfHash(std::string_view hex) {
  std::string id;
  unsigned bits = 0, count = 4;  // 132 digits' bits for 128: the first four are 0
  for (const char c : hex.substr(0, 32)) {
    const unsigned nibble = c <= '9' ? static_cast<unsigned>(c - '0') : static_cast<unsigned>(c - 'a') + 10U;
    bits = bits << 4U | nibble;
    count += 4;
    if (count >= 6) {
      count -= 6;
      id += kDigits[bits >> count & 63U];
      bits &= (1U << count) - 1U;
    }
  }
  return id;
}

}  // namespace

bool isGlobalId(std::string_view text) {
  return text.size() == kLength && text[0] >= '0' && text[0] <= '3' &&
         text.find_first_not_of(kDigits) == std::string_view::npos;
}

std::string GlobalIds::keep(const std::string& stated, std::string_view key) {
  if (isGlobalId(stated) && used_.insert(stated).second) return stated;
  if (!stated.empty()) ++replaced_;
  return make(key);
}

std::string GlobalIds::make(std::string_view key) {
  std::string text = project_ + '\n' + std::string(key);
  for (;; text += '+')
    if (std::string id = idOfHash(sha256Of(text)); used_.insert(id).second) return id;
}

}  // namespace standpoint::ifc

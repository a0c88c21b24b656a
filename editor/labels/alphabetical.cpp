// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/labels/alphabetical.h"

#include <memory>
#include <unicode/coll.h>
#include <unicode/unistr.h>
#include <vector>

namespace standpoint {

namespace {

// Null where ICU has no data.
std::unique_ptr<const icu::Collator> numericCollator() {
  UErrorCode status = U_ZERO_ERROR;
  std::unique_ptr<icu::Collator> collator(icu::Collator::createInstance(icu::Locale::getRoot(), status));
  if (U_FAILURE(status)) return nullptr;
  collator->setAttribute(UCOL_NUMERIC_COLLATION, UCOL_ON, status);
  return collator;
}

icu::UnicodeString unicode(std::string_view text) {
  return icu::UnicodeString::fromUTF8({text.data(), static_cast<std::int32_t>(text.size())});
}

}  // namespace

std::string alphabeticalKey(std::string_view name) {
  static const auto collator = numericCollator();
  std::string key;
  if (collator) {
    const auto text = unicode(name);
    std::vector<std::uint8_t> bytes(64);
    auto needed =
        static_cast<std::size_t>(collator->getSortKey(text, bytes.data(), static_cast<std::int32_t>(bytes.size())));
    if (needed > bytes.size()) {
      bytes.resize(needed);
      collator->getSortKey(text, bytes.data(), static_cast<std::int32_t>(needed));
    }
    key.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(needed));  // it ends with a zero
  }
  return key + std::string(name);
}

std::string withoutCase(std::string_view text) {
  std::string folded;
  return unicode(text).foldCase().toUTF8String(folded);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/labels/alphabetical.h"

#include <memory>
#include <unicode/coll.h>
#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
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

std::string forSearch(std::string_view text) {
  UErrorCode status = U_ZERO_ERROR;
  icu::UnicodeString folded = unicode(text).foldCase();
  if (const auto* decomposer = icu::Normalizer2::getNFDInstance(status); U_SUCCESS(status)) {
    const icu::UnicodeString whole = decomposer->normalize(folded, status);
    icu::UnicodeString plain;
    for (std::int32_t i = 0; i < whole.length(); i = whole.moveIndex32(i, 1))
      if (const UChar32 c = whole.char32At(i); u_charType(c) != U_NON_SPACING_MARK) plain.append(c);
    if (U_SUCCESS(status)) folded = plain;
  }
  std::string result;
  return folded.toUTF8String(result);
}

}  // namespace standpoint

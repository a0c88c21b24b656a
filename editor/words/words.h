// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace standpoint {

// The editor's own texts in other languages, by gettext: the English text in the code is the key, and
// editor/words/<code>.po has what it is elsewhere (decision 013). What has no translation stays English.

struct Language {
  const char* code;  // ISO 639: "de"
  const char* name;  // in itself: "Deutsch"
  char decimal_sign;
};
std::span<const Language> languages();  // English first

// The first of them that the user's locale asks for, as gettext reads it: LANGUAGE, LC_ALL, LC_MESSAGES, LANG.
// English where none is.
std::string languageOfSystem();

// From now on texts are in this language; "": in languageOfSystem(). Any thread may ask for texts meanwhile. The locale
// of the program stays as it is, for files and what is read back have the decimal point in any language.
void speak(std::string_view code);
std::string_view spoken();  // its code
char decimalSign();         // its own: '.' or ','

// Asked instead of the catalogues, by tests that listen; null: the catalogues again.
using Interpreter = std::function<std::optional<std::string>(std::string_view english)>;
void speakThrough(Interpreter interpreter);

// The English texts of a catalogue (.mo) that have this context; none where the file cannot be read.
std::vector<std::string> catalogueOfContext(const std::filesystem::path& file, std::string_view context);

// The text in the language that is spoken. Icons and spaces around it and an id of Dear ImGui ("##…") are not part of
// what is looked up, and stay.
std::string tr(std::string_view english);

std::string trFormatted(fmt::string_view english, fmt::format_args arguments);
std::string trCounted(fmt::string_view one, fmt::string_view many, std::size_t count, fmt::format_args arguments);

// Whether all digits of a number that was written so are zeros.
inline bool isZeroAsWritten(std::string_view number) {
  return number.find('0') != std::string_view::npos && number.find_first_of("123456789") == std::string_view::npos;
}

// A number as an argument of a text that is drawn: with the decimal sign of the language, and without the minus of what
// is rounded to zero.
template <std::floating_point Number>
struct DrawnNumber {
  Number value;
};

template <class Argument>
decltype(auto) asDrawn(Argument& argument) {
  using Plain = std::remove_cv_t<Argument>;
  if constexpr (std::floating_point<Plain>)
    return DrawnNumber<Plain>{argument};
  else
    return (argument);
}

// fmt::format with the decimal sign of the language, for what is drawn or pasted into a spreadsheet:
// figures("{:.2f} m", x) is "1,60 m" in German. fmt::format keeps the point: for ids, files and what is read back.
template <class... Arguments>
std::string figures(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  return fmt::vformat(text, fmt::make_format_args(asDrawn(arguments)...));
}

// fmt::format of the translated text, with figures as figures() writes them. A translation may take the arguments in
// another order: "{1} von {0}".
template <class... Arguments>
std::string trf(fmt::format_string<Arguments...> english, Arguments&&... arguments) {
  return trFormatted(english, fmt::make_format_args(asDrawn(arguments)...));
}

// One text for one, another for many, and as many forms as the language has: trn("{} station", "{} stations", n, n).
template <class... Arguments>
std::string trn(fmt::format_string<Arguments...> one, fmt::format_string<Arguments...> many, std::size_t count,
                Arguments&&... arguments) {
  return trCounted(one, many, count, fmt::make_format_args(asDrawn(arguments)...));
}

}  // namespace standpoint

template <std::floating_point Number>
struct fmt::formatter<standpoint::DrawnNumber<Number>> : fmt::formatter<Number> {
  template <class Context>
  auto format(const standpoint::DrawnNumber<Number>& number, Context& context) const {
    fmt::memory_buffer plain;
    Context into(fmt::appender(plain), context.args(), context.locale());
    fmt::formatter<Number>::format(number.value, into);
    if (std::signbit(number.value) && standpoint::isZeroAsWritten({plain.data(), plain.size()})) {
      plain.clear();
      fmt::formatter<Number>::format(Number{0}, into);  // "0.0", not "-0.0"
    }
    return std::replace_copy(plain.begin(), plain.end(), context.out(), '.', standpoint::decimalSign());
  }
};

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace standpoint {

// The editor's own texts in other languages, by gettext: the English text in the code is the key, and
// editor/words/<code>.po has what it is elsewhere (decision 013). What has no translation stays English.

struct Language {
  const char* code;  // ISO 639: "de"
  const char* name;  // in itself: "Deutsch"
};
std::span<const Language> languages();  // English first

// The first of them that the user's locale asks for, as gettext reads it: LANGUAGE, LC_ALL, LC_MESSAGES, LANG.
// English where none is.
std::string languageOfSystem();

// From now on texts are in this language; "": in languageOfSystem(). Numbers keep their decimal point. Any thread may
// ask for texts meanwhile.
void speak(std::string_view code);
std::string_view spoken();  // its code

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

// fmt::format of the translated text. A translation may take the arguments in another order: "{1} von {0}".
template <class... Arguments>
std::string trf(fmt::format_string<Arguments...> english, Arguments&&... arguments) {
  return trFormatted(english, fmt::make_format_args(arguments...));
}

// One text for one, another for many, and as many forms as the language has: trn("{} station", "{} stations", n, n).
template <class... Arguments>
std::string trn(fmt::format_string<Arguments...> one, fmt::format_string<Arguments...> many, std::size_t count,
                Arguments&&... arguments) {
  return trCounted(one, many, count, fmt::make_format_args(arguments...));
}

}  // namespace standpoint

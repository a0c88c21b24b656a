// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/words/words.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/locale/gnu_gettext.hpp>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <memory>

#include "core/data_folder.h"

namespace standpoint {

namespace {

constexpr std::array kLanguages = {Language{"en", "English", '.'}, Language{"de", "Deutsch", ','},
                                   Language{"uk", "Українська", ','}};

using Messages = boost::locale::message_format<char>;

// The catalogue of one language. It is made without std::locale's name, so no locale needs to be generated on the
// machine, and it is never the global locale, so that numbers in files are written as ever.
struct Catalogue {
  const Language* language = &kLanguages.front();
  std::locale held = std::locale::classic();
  const Messages* messages = nullptr;  // null: English
};

Catalogue read(const Language& language) {
  Catalogue result{&language};
  boost::locale::gnu_gettext::messages_info info;
  info.language = language.code;
  info.encoding = "UTF-8";
  info.domains.emplace_back("editor");
  info.paths.push_back((dataFolder() / "editor/words").string());
  try {
    result.held = std::locale(std::locale::classic(), boost::locale::gnu_gettext::create_messages_facet<char>(info));
    result.messages = &std::use_facet<Messages>(result.held);
  } catch (const std::exception&) {  // a file of garbage: English
  }
  return result;
}

// Read once and kept, as another thread may be asking while the language changes.
const std::array<Catalogue, kLanguages.size()>& catalogues() {
  static const auto all = [] {
    std::array<Catalogue, kLanguages.size()> result;
    for (std::size_t i = 1; i < result.size(); ++i) result[i] = read(kLanguages[i]);
    return result;
  }();
  return all;
}

std::atomic<const Catalogue*> current = nullptr;
std::atomic<std::shared_ptr<const Interpreter>> listening;

const Language* languageOf(std::string_view code) {
  const auto found =
      std::find_if(kLanguages.begin(), kLanguages.end(), [&](const Language& l) { return code == l.code; });
  return found == kLanguages.end() ? nullptr : &*found;
}

const Language& spokenLanguage() {
  const auto* catalogue = current.load();
  return catalogue == nullptr ? kLanguages.front() : *catalogue->language;
}

const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// "de" of "de_AT.UTF-8"; "en" of the locales that belong to no language.
std::string_view codeOf(std::string_view locale) {
  const auto code = locale.substr(0, locale.find_first_of("_.@-"));
  return code == "C" || code == "POSIX" ? "en" : code;
}

// U+F000 to U+F2FF, for private use, in UTF-8.
bool beginsWithIcon(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  return text.size() > 2 && byte(0) == 0xef && byte(1) >= 0x80 && byte(1) <= 0x8b;
}

// Where the text begins behind icons and spaces.
std::size_t beginOf(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == ' ')
      ++at;
    else if (beginsWithIcon(text.substr(at)))
      at += 3;
    else
      break;
  }
  return at;
}

struct Parts {
  std::string_view before, text, after;
};

Parts partsOf(std::string_view whole) {
  const auto begin = beginOf(whole);
  auto end = std::min(whole.find("##"), whole.size());
  while (end > begin && whole[end - 1] == ' ') --end;
  if (end < begin) return {whole, {}, {}};
  return {whole.substr(0, begin), whole.substr(begin, end - begin), whole.substr(end)};
}

bool saysSomething(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::isalpha(c) != 0 || c > 127; });
}

std::optional<std::string> translated(std::string_view text) {
  if (const auto interpreter = listening.load()) return (*interpreter)(text);
  const auto* catalogue = current.load();
  if (catalogue == nullptr || catalogue->messages == nullptr) return std::nullopt;
  const std::string id(text);
  const char* found = catalogue->messages->get(0, nullptr, id.c_str());
  if (found == nullptr) found = catalogue->messages->get(0, "sentence", id.c_str());
  return found == nullptr ? std::nullopt : std::optional<std::string>(found);
}

// A translation whose places do not fit the arguments must not end the program; the tests compare them.
std::string filledIn(const std::string& text, fmt::string_view english, fmt::format_args arguments) {
  try {
    return fmt::vformat(text, arguments);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, arguments);
  }
}

std::string joined(const Parts& parts, std::string_view text) {
  return std::string(parts.before).append(text).append(parts.after);
}

}  // namespace

std::span<const Language> languages() { return kLanguages; }

std::string languageOfSystem() {
  std::string_view list = variable("LANGUAGE");
  while (!list.empty()) {
    const auto colon = std::min(list.find(':'), list.size());
    if (const auto* known = languageOf(codeOf(list.substr(0, colon)))) return known->code;
    list.remove_prefix(std::min(colon + 1, list.size()));
  }
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    if (*variable(name) == 0) continue;
    const auto* known = languageOf(codeOf(variable(name)));
    return known == nullptr ? kLanguages.front().code : known->code;
  }
  return kLanguages.front().code;
}

void speak(std::string_view code) {
  const std::string wanted = code.empty() ? languageOfSystem() : std::string(code);
  const auto* known = languageOf(wanted);
  current = known == nullptr ? nullptr : &catalogues()[static_cast<std::size_t>(known - kLanguages.data())];
}

std::string_view spoken() { return spokenLanguage().code; }
char decimalSign() { return spokenLanguage().decimal_sign; }

std::vector<std::string> catalogueOfContext(const std::filesystem::path& file, std::string_view context) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  // The header of a .mo file: magic, revision, how many texts, where their table begins; a row is length and place.
  std::vector<std::string> texts;
  const auto prefix = std::string(context) + '\4';
  const auto table = number(12);
  for (std::size_t i = 0; i < number(8) && table + 8 * i + 8 <= bytes.size(); ++i) {
    const auto length = number(table + 8 * i), begin = number(table + 8 * i + 4);
    if (begin > bytes.size() || length > bytes.size() - begin) continue;
    const auto id = std::string_view(bytes).substr(begin, length);
    if (id.starts_with(prefix)) texts.emplace_back(id.substr(prefix.size()));
  }
  return texts;
}

void speakThrough(Interpreter interpreter) {
  listening = interpreter ? std::make_shared<const Interpreter>(std::move(interpreter)) : nullptr;
}

std::string tr(std::string_view english) {
  const auto parts = partsOf(english);
  if (!saysSomething(parts.text)) return std::string(english);
  const auto found = translated(parts.text);
  return found ? joined(parts, *found) : std::string(english);
}

std::string trFormatted(fmt::string_view english, fmt::format_args arguments) {
  return filledIn(tr({english.data(), english.size()}), english, arguments);
}

std::string trCounted(fmt::string_view one, fmt::string_view many, std::size_t count, fmt::format_args arguments) {
  const std::string_view single(one.data(), one.size()), plural(many.data(), many.size());
  const auto english = count == 1 ? single : plural;
  const auto parts = partsOf(english);
  if (listening.load()) return filledIn(tr(english), english, arguments);
  const auto* catalogue = current.load();
  if (catalogue == nullptr || catalogue->messages == nullptr) return fmt::vformat(english, arguments);
  const auto n = static_cast<int>(std::min<std::size_t>(count, std::numeric_limits<int>::max()));
  const char* found = catalogue->messages->get(0, nullptr, std::string(partsOf(single).text).c_str(), n);
  return filledIn(found == nullptr ? std::string(english) : joined(parts, found), english, arguments);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/pattern.h"

#include <algorithm>
#include <cstdint>

namespace standpoint {

namespace {

struct Run {
  char32_t first, last;
  const char* base;
};
// Latin-1 Supplement and Latin Extended-A by their base letters (Unicode 15, charts U0080 and U0100).
constexpr Run kBases[] = {
    {0xA0, 0xA0, " "},
    {0xB2, 0xB2, "2"},
    {0xB3, 0xB3, "3"},
    {0xD7, 0xD7, "x"},
    {0xC0, 0xC5, "a"},
    {0xC6, 0xC6, "ae"},
    {0xC7, 0xC7, "c"},
    {0xC8, 0xCB, "e"},
    {0xCC, 0xCF, "i"},
    {0xD0, 0xD0, "d"},
    {0xD1, 0xD1, "n"},
    {0xD2, 0xD6, "o"},
    {0xD8, 0xD8, "o"},
    {0xD9, 0xDC, "u"},
    {0xDD, 0xDD, "y"},
    {0xDE, 0xDE, "th"},
    {0xDF, 0xDF, "ss"},
    {0xE0, 0xE5, "a"},
    {0xE6, 0xE6, "ae"},
    {0xE7, 0xE7, "c"},
    {0xE8, 0xEB, "e"},
    {0xEC, 0xEF, "i"},
    {0xF0, 0xF0, "d"},
    {0xF1, 0xF1, "n"},
    {0xF2, 0xF6, "o"},
    {0xF8, 0xF8, "o"},
    {0xF9, 0xFC, "u"},
    {0xFD, 0xFD, "y"},
    {0xFE, 0xFE, "th"},
    {0xFF, 0xFF, "y"},
    {0x100, 0x105, "a"},
    {0x106, 0x10D, "c"},
    {0x10E, 0x111, "d"},
    {0x112, 0x11B, "e"},
    {0x11C, 0x123, "g"},
    {0x124, 0x127, "h"},
    {0x128, 0x131, "i"},
    {0x132, 0x133, "ij"},
    {0x134, 0x135, "j"},
    {0x136, 0x138, "k"},
    {0x139, 0x142, "l"},
    {0x143, 0x14B, "n"},
    {0x14C, 0x151, "o"},
    {0x152, 0x153, "oe"},
    {0x154, 0x159, "r"},
    {0x15A, 0x161, "s"},
    {0x162, 0x167, "t"},
    {0x168, 0x173, "u"},
    {0x174, 0x175, "w"},
    {0x176, 0x178, "y"},
    {0x179, 0x17E, "z"},
    {0x17F, 0x17F, "s"},
    {0x300, 0x36F, ""},
    {0x1E9E, 0x1E9E, "ss"},
    {0x2000, 0x200A, " "},
    {0x2010, 0x2015, "-"},
    {0x2018, 0x201F, "'"},
    {0xFEFF, 0xFEFF, ""},
    // Cyrillic letters that stand for one another in names: ё for е, ґ for г.
    {0x401, 0x401, "е"},
    {0x451, 0x451, "е"},
    {0x490, 0x491, "г"},
};

std::size_t sequenceLength(unsigned char lead) {
  return lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF8 ? 4 : 1;
}

// Length of the character at `at`; a byte that begins no whole sequence counts as one character.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto length = sequenceLength(static_cast<unsigned char>(text[at]));
  if (at + length > text.size()) return 1;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0U) != 0x80U) return 1;
  return length;
}

char32_t decoded(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  char32_t code = lead & (0x7FU >> character.size());
  for (std::size_t i = 1; i < character.size(); ++i)
    code = code << 6U | (static_cast<unsigned char>(character[i]) & 0x3FU);
  return code;
}

void appendTwoBytes(std::string& text, char32_t code) {
  text += static_cast<char>(0xC0U | code >> 6U);
  text += static_cast<char>(0x80U | (code & 0x3FU));
}

void appendFolded(std::string& text, std::string_view character) {
  const char32_t code = decoded(character);
  for (const auto& run : kBases)
    if (code >= run.first && code <= run.last) {
      text += run.base;
      return;
    }
  if ((code >= 0x391 && code <= 0x3A9) || (code >= 0x410 && code <= 0x42F)) return appendTwoBytes(text, code + 0x20);
  if (code >= 0x400 && code <= 0x40F) return appendTwoBytes(text, code + 0x50);
  text += character;
}

enum class Kind { letter, digit, other };

Kind kindAt(std::string_view text, std::size_t at) {
  const auto c = static_cast<unsigned char>(text[at]);
  return c >= '0' && c <= '9' ? Kind::digit : (c >= 'a' && c <= 'z') || c >= 0x80 ? Kind::letter : Kind::other;
}

// Where a run of letters or of digits begins or ends.
bool beginsAt(std::string_view text, std::size_t at) {
  return at < text.size() && kindAt(text, at) != Kind::other && (at == 0 || kindAt(text, at - 1) != kindAt(text, at));
}
bool endsAt(std::string_view text, std::size_t at) {
  return at > 0 && kindAt(text, at - 1) != Kind::other &&
         (at == text.size() || kindAt(text, at) != kindAt(text, at - 1));
}

// One glob against the whole text; remembers only the last star, so time is bounded by the product of the lengths.
bool globFits(std::string_view glob, std::string_view text) {
  std::size_t g = 0, t = 0, star = std::string_view::npos, resume = 0;
  for (;;) {
    const char c = g < glob.size() ? glob[g] : '\0';
    if (c == '*') {
      star = g++;
      resume = t;
    } else if ((c == '<' && beginsAt(text, t)) || (c == '>' && endsAt(text, t))) {
      ++g;
    } else if (g == glob.size() && t == text.size()) {
      return true;
    } else if (c == '?' && t < text.size()) {
      ++g;
      t += characterLength(text, t);
    } else if (c == '#' && t < text.size() && text[t] >= '0' && text[t] <= '9') {
      ++g;
      ++t;
    } else if (g < glob.size() && t < text.size() && c != '<' && c != '>' && c == text[t]) {
      ++g;
      ++t;
    } else if (star != std::string_view::npos && resume < text.size()) {
      g = star + 1;
      resume += characterLength(text, resume);
      t = resume;
    } else {
      return false;
    }
  }
}

// Calls `take` with each part of a text between separators, empty ones too.
template <class Take>
void eachPart(std::string_view text, char separator, Take take) {
  for (;;) {
    const auto end = text.find(separator);
    take(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text = text.substr(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

bool isList(std::string_view term) { return term.size() > 2 && term.front() == '{' && term.back() == '}'; }

}  // namespace

std::string folded(std::string_view utf8) {
  utf8 = utf8.substr(0, kLongestName);
  std::string text;
  text.reserve(utf8.size());
  for (std::size_t i = 0; i < utf8.size();) {
    const auto length = characterLength(utf8, i);
    const char c = utf8[i];
    if (length > 1)
      appendFolded(text, utf8.substr(i, length));
    else
      text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    i += length;
  }
  return text;
}

std::uint64_t bytePairs(std::string_view text) {
  std::uint64_t pairs = 0;
  for (std::size_t i = 1; i < text.size(); ++i) {
    const auto code =
        static_cast<std::uint64_t>(static_cast<unsigned char>(text[i - 1])) << 8U | static_cast<unsigned char>(text[i]);
    pairs |= std::uint64_t{1} << (code * 0x9E3779B97F4A7C15ULL >> 58U);
  }
  return pairs;
}

Glob::Glob(std::string_view folded_glob) : glob_(folded_glob) {
  for (std::size_t begin = 0; begin < glob_.size();) {  // between two signs that may stand for anything
    const auto end = std::min(glob_.find_first_of("*?#<>", begin), glob_.size());
    pairs_ |= bytePairs(std::string_view(glob_).substr(begin, end - begin));
    begin = end + 1;
  }
  if (glob_.find_first_of("<>") != std::string::npos) glob_ = '*' + glob_ + '*';
  const auto stars = glob_.size() > 2 && glob_.front() == '*' && glob_.back() == '*';
  inside_ = stars && glob_.find_first_of("*?#<>", 1) == glob_.size() - 1;
  if (inside_) glob_ = glob_.substr(1, glob_.size() - 2);
}

Glob Glob::word(std::string_view word) { return Glob('*' + folded(word) + '*'); }

bool Glob::fits(std::string_view folded_text) const {
  return inside_ ? folded_text.find(glob_) != std::string_view::npos : globFits(glob_, folded_text);
}

WordTable::WordTable(const WordLists& lists) {
  for (const auto& [name, words] : lists) {
    index_.emplace(name, static_cast<int>(lists_.size()));
    auto& list = lists_.emplace_back();
    for (const auto& word : words) list.emplace_back(word, Glob::word(word));
  }
}

int WordTable::index(std::string_view name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? -1 : found->second;
}

int WordTable::fit(int list, std::string_view folded_text, std::uint64_t pairs) const {
  const auto& words = lists_[static_cast<std::size_t>(list)];
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].second.fits(folded_text, pairs)) return static_cast<int>(i);
  return -1;
}

Pattern::Pattern(std::string_view alternatives, const WordTable& words) : words_(&words) {
  if (alternatives.empty()) return;
  eachPart(alternatives, '|', [&](std::string_view alternative) {
    auto& terms = alternatives_.emplace_back();
    eachPart(alternative, '&', [&](std::string_view written) {
      auto text = trimmed(written);
      const bool negated = text.starts_with('!');
      if (negated) text = trimmed(text.substr(1));
      const int list = isList(text) ? words.index(text.substr(1, text.size() - 2)) : -1;
      terms.push_back({std::string(text), negated, list, Glob(folded(text))});
    });
  });
}

const WordTable& Pattern::none() {
  static const WordTable kNone;
  return kNone;
}

int Pattern::wordIn(int list, Folded& text) const {
  auto& known = text.word_of_list[static_cast<std::size_t>(list)];
  if (known == Folded::kNotAsked) known = words_->fit(list, text.text, text.pairs);
  return known;
}

int Pattern::fit(Folded& text) const {
  for (std::size_t i = 0; i < alternatives_.size(); ++i) {
    bool all = true;
    for (const auto& term : alternatives_[i])
      all = all &&
            (term.list >= 0 ? wordIn(term.list, text) >= 0 : term.glob.fits(text.text, text.pairs)) != term.negated;
    if (all) return static_cast<int>(i);
  }
  return -1;
}

int Pattern::fit(std::string_view folded_text) const {
  for (std::size_t i = 0; i < alternatives_.size(); ++i) {
    bool all = true;
    for (const auto& term : alternatives_[i]) all = all && term.glob.fits(folded_text) != term.negated;
    if (all) return static_cast<int>(i);
  }
  return -1;
}

std::string Pattern::found(int alternative, Folded& text) const {
  std::string all;
  for (const auto& term : alternatives_[static_cast<std::size_t>(alternative)])
    if (!term.negated)
      all += (all.empty() ? "" : " & ") +
             (term.list >= 0 ? words_->word(term.list, wordIn(term.list, text)) : term.written);
  return all;
}

std::string flawOf(std::string_view alternatives, const WordLists& lists) {
  std::string flaw;
  eachPart(alternatives, '|', [&](std::string_view alternative) {
    eachPart(alternative, '&', [&](std::string_view written) {
      auto text = trimmed(written);
      if (text.starts_with('!')) text = trimmed(text.substr(1));
      if (!flaw.empty()) return;
      if (text.empty())
        flaw = "contains an empty pattern";
      else if (isList(text) && !lists.contains(std::string(text.substr(1, text.size() - 2))))
        flaw = "refers to word list " + std::string(text) + ", which does not exist";
      else if (!isList(text) && text.find_first_of("{}") != std::string_view::npos)
        flaw = "contains an unmatched brace";
    });
  });
  return flaw;
}

std::string literalPattern(std::string_view name) {
  std::string pattern(name);
  for (char& c : pattern)
    if (std::string_view("*?#<>{}&!|@=").find(c) != std::string_view::npos) c = '?';
  return pattern;
}

int fitClass(const Pattern& pattern, std::string_view ifc_class) {
  const auto name = folded(ifc_class);
  if (const int whole = pattern.fit(name); whole >= 0) return whole;
  for (const std::string_view suffix : {"standardcase", "elementedcase"})
    if (name.ends_with(suffix)) return pattern.fit(std::string_view(name).substr(0, name.size() - suffix.size()));
  return -1;
}

}  // namespace standpoint

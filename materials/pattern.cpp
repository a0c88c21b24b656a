// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/pattern.h"

#include <cstdint>

namespace standpoint {

namespace {

struct Run {
  char32_t first, last;
  const char* base;
};
// Latin-1 Supplement and Latin Extended-A by their base letters (Unicode 15, charts U0080 and U0100).
constexpr Run kBases[] = {
    {0xA0, 0xA0, " "},      {0xC0, 0xC5, "a"},    {0xC6, 0xC6, "ae"},  {0xC7, 0xC7, "c"},   {0xC8, 0xCB, "e"},
    {0xCC, 0xCF, "i"},      {0xD0, 0xD0, "d"},    {0xD1, 0xD1, "n"},   {0xD2, 0xD6, "o"},   {0xD8, 0xD8, "o"},
    {0xD9, 0xDC, "u"},      {0xDD, 0xDD, "y"},    {0xDE, 0xDE, "th"},  {0xDF, 0xDF, "ss"},  {0xE0, 0xE5, "a"},
    {0xE6, 0xE6, "ae"},     {0xE7, 0xE7, "c"},    {0xE8, 0xEB, "e"},   {0xEC, 0xEF, "i"},   {0xF0, 0xF0, "d"},
    {0xF1, 0xF1, "n"},      {0xF2, 0xF6, "o"},    {0xF8, 0xF8, "o"},   {0xF9, 0xFC, "u"},   {0xFD, 0xFD, "y"},
    {0xFE, 0xFE, "th"},     {0xFF, 0xFF, "y"},    {0x100, 0x105, "a"}, {0x106, 0x10D, "c"}, {0x10E, 0x111, "d"},
    {0x112, 0x11B, "e"},    {0x11C, 0x123, "g"},  {0x124, 0x127, "h"}, {0x128, 0x131, "i"}, {0x132, 0x133, "ij"},
    {0x134, 0x135, "j"},    {0x136, 0x138, "k"},  {0x139, 0x142, "l"}, {0x143, 0x14B, "n"}, {0x14C, 0x151, "o"},
    {0x152, 0x153, "oe"},   {0x154, 0x159, "r"},  {0x15A, 0x161, "s"}, {0x162, 0x167, "t"}, {0x168, 0x173, "u"},
    {0x174, 0x175, "w"},    {0x176, 0x178, "y"},  {0x179, 0x17E, "z"}, {0x17F, 0x17F, "s"}, {0x300, 0x36F, ""},
    {0x1E9E, 0x1E9E, "ss"}, {0xFEFF, 0xFEFF, ""},
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

// One glob against the whole text; remembers only the last star, so time is bounded by the product of the lengths.
bool globFits(std::string_view glob, std::string_view text) {
  std::size_t g = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      resume = t;
    } else if (g < glob.size() && glob[g] == '?') {
      ++g;
      t += characterLength(text, t);
    } else if (g < glob.size() && glob[g] == text[t]) {
      ++g;
      ++t;
    } else if (star != std::string_view::npos) {
      g = star + 1;
      resume += characterLength(text, resume);
      t = resume;
    } else {
      return false;
    }
  }
  while (g < glob.size() && glob[g] == '*') ++g;
  return g == glob.size();
}

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

Pattern::Pattern(std::string_view globs) {
  while (!globs.empty()) {
    const auto bar = globs.find('|');
    globs_.emplace_back(globs.substr(0, bar));
    folded_.push_back(folded(globs_.back()));
    globs = bar == std::string_view::npos ? std::string_view() : globs.substr(bar + 1);
  }
}

int Pattern::fit(std::string_view folded_text) const {
  for (std::size_t i = 0; i < folded_.size(); ++i)
    if (globFits(folded_[i], folded_text)) return static_cast<int>(i);
  return -1;
}

int fitClass(const Pattern& pattern, std::string_view ifc_class) {
  const auto name = folded(ifc_class);
  if (const int whole = pattern.fit(name); whole >= 0) return whole;
  for (const std::string_view suffix : {"standardcase", "elementedcase"})
    if (name.ends_with(suffix)) return pattern.fit(std::string_view(name).substr(0, name.size() - suffix.size()));
  return -1;
}

}  // namespace standpoint

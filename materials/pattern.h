// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace standpoint {

// Lower case without accents (Ä a, ß ss, Ø o, …), Greek and Cyrillic in lower case, everything else as it is, so that a
// pattern written one way fits names written another. At most the first kLongestName bytes, which bounds the matching.
constexpr std::size_t kLongestName = 1024;
std::string folded(std::string_view utf8);

// Lists of words by name. A word is found anywhere in a text; `<` and `>` in it stand for the begin and the end of a
// run of letters or of digits, `#` for a digit, `*` and `?` as in globs: "<eps>" fits "EPS100" and "EPS 035", not
// "steps".
using WordLists = std::map<std::string, std::vector<std::string>>;

// Which pairs of neighbouring bytes occur in a text, as a set of 64 bits. A glob cannot fit a text that lacks one of
// its pairs, which spares nearly all of the thousands of words a look at each name.
std::uint64_t bytePairs(std::string_view text);

// A glob made ready for many texts.
class Glob {
 public:
  explicit Glob(std::string_view folded_glob);
  static Glob word(std::string_view word);
  bool fits(std::string_view folded_text) const;
  bool fits(std::string_view folded_text, std::uint64_t pairs_of_text) const {
    return (pairs_ & ~pairs_of_text) == 0 && fits(folded_text);
  }

 private:
  std::string glob_;
  bool inside_ = false;  // it is plain text that may stand anywhere
  std::uint64_t pairs_ = 0;
};

class WordTable {
 public:
  WordTable() = default;
  explicit WordTable(const WordLists& lists);
  std::size_t size() const { return lists_.size(); }
  int index(std::string_view name) const;                                      // -1: there is no such list
  int fit(int list, std::string_view folded_text, std::uint64_t pairs) const;  // the first word that fits, or -1
  const std::string& word(int list, int index) const {
    return lists_[static_cast<std::size_t>(list)][static_cast<std::size_t>(index)].first;
  }

 private:
  std::map<std::string, int, std::less<>> index_;
  std::vector<std::vector<std::pair<std::string, Glob>>> lists_;
};

// A folded text with what is known of it already: each list of words is held against it once.
struct Folded {
  std::string text;
  std::uint64_t pairs;
  std::vector<int> word_of_list;  // what WordTable::fit said; kNotAsked before

  static constexpr int kNotAsked = -2;
  Folded(std::string_view utf8, const WordTable& words)
      : text(folded(utf8)), pairs(bytePairs(text)), word_of_list(words.size(), kNotAsked) {}
};

// Alternatives separated by `|`; in each, all terms joined by `&` must fit and those with `!` before them must not. A
// term is a glob (`*`, `?`, `#` = a digit) for the whole text, one with `<` or `>` for any part of it, or {name} of a
// list of words.
class Pattern {
 public:
  explicit Pattern(std::string_view alternatives, const WordTable& words = none());
  bool empty() const { return alternatives_.empty(); }
  // Index of the first alternative that fits the folded text, or -1.
  int fit(Folded& text) const;
  int fit(std::string_view folded_text) const;  // for patterns without lists
  // What was found in the text: "*beton*", or of a list the word.
  std::string found(int alternative, Folded& text) const;

 private:
  struct Term {
    std::string written;
    bool negated = false;
    int list = -1;
    Glob glob;
  };
  static const WordTable& none();
  int wordIn(int list, Folded& text) const;

  const WordTable* words_;
  std::vector<std::vector<Term>> alternatives_;
};

// What is wrong with a pattern, or empty: no term where one belongs, a list that there is not, a brace that is not
// closed.
std::string flawOf(std::string_view alternatives, const WordLists& lists);

// A name as a pattern that fits it: what patterns mean otherwise becomes `?`.
std::string literalPattern(std::string_view name);

// A class fits its own name and that of the standard case: IfcWall means IfcWallStandardCase too.
int fitClass(const Pattern& pattern, std::string_view ifc_class);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace standpoint {

class JsonFields;

// What is known of something under a name: a number, a word, or both.
struct Fact {
  std::string text;
  std::optional<double> number;
};
inline Fact wordFact(std::string text) { return {std::move(text), std::nullopt}; }
Fact numberFact(double number);
inline Fact yesNo(bool yes) { return wordFact(yes ? "yes" : "no"); }

// What a fact can be.
struct FactDomain {
  std::vector<std::string> words;  // it is one of these; none: any word, unless it is a number
  bool is_number = false;
  double minimum = -1e300, maximum = 1e300;
};

using FactLookup = std::function<std::optional<Fact>(const std::string& name)>;
using DomainLookup = std::function<std::optional<FactDomain>(const std::string& name)>;

// A condition over facts, as screens, state machines and exercises state it:
//   battery > 0.1 and card == present
//   setting.resolution in {3mm, 6mm} or not (tilt <= 2)
//   card.free >= @expected.bytes          the right side is a fact, too
//   link                                  alone: it is "yes"
// `or` binds weakest, then `and`, then `not`. Words with blanks or signs stand in 'quotes'. A condition on a fact that
// is not there does not hold. The empty condition always holds.
class Condition {
 public:
  static Result<Condition> parse(std::string_view text);  // the error names the column

  bool holds(const FactLookup& fact) const;
  const std::string& text() const { return text_; }
  bool empty() const { return root_ == nullptr; }
  std::vector<std::string> facts() const;  // that it speaks of, each once, in its order

  // Refuses unknown facts, comparisons with what the fact can never be, and conditions that can never hold.
  Result<void> check(const DomainLookup& domain) const;

  enum class Sign { equal, unequal, less, at_most, more, at_least };
  struct Comparison {
    std::string fact;
    Sign sign = Sign::equal;
    std::vector<std::string> words;  // right side; `in` has several
    bool of_fact = false;            // the right side is a fact's name
  };
  std::vector<Comparison> comparisons() const;

  // As people read it: each comparison by `comparison`, between them `all` or `any`; `none` is of what must not hold,
  // as {what}.
  struct Wording {
    std::function<std::string(const Comparison&)> comparison;
    std::string all, any, none;
  };
  std::string worded(const Wording& wording) const;
  struct Node;

 private:
  std::string text_;
  std::shared_ptr<const Node> root_;
};

Condition conditionAt(JsonFields& fields, std::string_view key);  // empty when it is missing

}  // namespace standpoint

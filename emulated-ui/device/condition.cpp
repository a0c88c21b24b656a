// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/condition.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/device/replaced.h"

namespace standpoint {

struct Condition::Node {
  enum class Kind { comparison, all, any, none } kind = Kind::comparison;
  Comparison comparison;
  std::vector<std::shared_ptr<const Node>> parts;  // of all and any; one of none
};

namespace {

using Node = Condition::Node;
using NodePointer = std::shared_ptr<const Node>;
using Comparison = Condition::Comparison;
using Sign = Condition::Sign;

constexpr int kDeepest = 32;
constexpr std::size_t kLongest = 2000;
constexpr std::size_t kMostCases = 4096;  // of a condition's disjunctive form

struct Token {
  enum class Kind { word, quoted, sign, end } kind = Kind::end;
  std::string text;
  std::size_t column = 1;
};

bool partOfWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-' || c == '/' || c == '+' ||
         c == '@' || c == '%' || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

// One sign, word or quoted word after the other.
Result<std::vector<Token>> tokens(std::string_view text) {
  std::vector<Token> found;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t from = i;
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++i;
    } else if (c == '\'') {
      const auto end = text.find('\'', i + 1);
      if (end == std::string_view::npos)
        return failure(ErrorKind::unusable, fmt::format("column {}: unclosed quote", i + 1));
      found.push_back({Token::Kind::quoted, std::string(text.substr(i + 1, end - i - 1)), from + 1});
      i = end + 1;
    } else if (partOfWord(c)) {
      while (i < text.size() && partOfWord(text[i])) ++i;
      found.push_back({Token::Kind::word, std::string(text.substr(from, i - from)), from + 1});
    } else {
      const std::string_view two = text.substr(i, 2);
      const bool pair = two == "==" || two == "!=" || two == "<=" || two == ">=";
      if (!pair && std::string_view("<>(){},").find(c) == std::string_view::npos)
        return failure(ErrorKind::unusable, fmt::format("column {}: unexpected '{}'", i + 1, c));
      i += pair ? 2 : 1;
      found.push_back({Token::Kind::sign, std::string(text.substr(from, i - from)), from + 1});
    }
  }
  found.push_back({Token::Kind::end, "the end", text.size() + 1});
  return found;
}

NodePointer joined(Node::Kind kind, std::vector<NodePointer> parts) {
  if (parts.size() == 1 && kind != Node::Kind::none) return parts[0];
  return std::make_shared<const Node>(Node{kind, {}, std::move(parts)});
}

class Parser {
 public:
  explicit Parser(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  Result<NodePointer> whole() {
    auto node = any(0);
    if (node && next().kind != Token::Kind::end) return wrong("'and', 'or' or the end");
    return node;
  }

 private:
  const Token& next() const { return tokens_[at_]; }
  bool take(const char* text) {
    if (next().kind == Token::Kind::quoted || next().kind == Token::Kind::end || next().text != text) return false;
    ++at_;
    return true;
  }
  tl::unexpected<Error> wrong(const char* wanted) const {
    return failure(ErrorKind::unusable,
                   fmt::format("column {}: '{}' found, expected {}", next().column, next().text, wanted));
  }

  Result<NodePointer> series(const char* between, Node::Kind kind, int depth,
                             Result<NodePointer> (Parser::*part)(int)) {
    std::vector<NodePointer> parts;
    do {
      auto node = (this->*part)(depth);
      if (!node) return node;
      parts.push_back(*node);
    } while (take(between));
    return joined(kind, std::move(parts));
  }
  Result<NodePointer> any(int depth) { return series("or", Node::Kind::any, depth, &Parser::all); }
  Result<NodePointer> all(int depth) { return series("and", Node::Kind::all, depth, &Parser::single); }

  Result<NodePointer> single(int depth) {
    if (depth > kDeepest) return failure(ErrorKind::unusable, "the condition is nested too deeply");
    if (take("not")) {
      auto node = single(depth + 1);
      return node ? Result<NodePointer>(joined(Node::Kind::none, {*node})) : node;
    }
    if (take("(")) {
      auto node = any(depth + 1);
      if (node && !take(")")) return wrong("')'");
      return node;
    }
    return comparison();
  }

  Result<NodePointer> comparison() {
    if (next().kind != Token::Kind::word) return wrong("a fact");
    Node node;
    node.comparison.fact = tokens_[at_++].text;
    constexpr std::pair<const char*, Sign> kSigns[] = {{"==", Sign::equal},   {"!=", Sign::unequal},
                                                       {"<=", Sign::at_most}, {">=", Sign::at_least},
                                                       {"<", Sign::less},     {">", Sign::more}};
    bool signed_ = false;
    for (const auto& [text, sign] : kSigns)
      if (!signed_ && take(text)) {
        node.comparison.sign = sign;
        signed_ = true;
      }
    if (signed_) {
      TRY(word(node.comparison));
    } else if (take("in")) {
      if (!take("{")) return wrong("'{'");
      do {
        TRY(word(node.comparison));
      } while (take(","));
      if (!take("}")) return wrong("'}'");
    } else {
      node.comparison.words = {"yes"};
    }
    return std::make_shared<const Node>(std::move(node));
  }

  Result<void> word(Comparison& comparison) {
    const Token& token = next();
    if (token.kind != Token::Kind::word && token.kind != Token::Kind::quoted) return wrong("a word or number");
    const bool fact = token.kind == Token::Kind::word && token.text.starts_with('@');
    if (fact && !comparison.words.empty()) return wrong("a word or number");
    comparison.of_fact = fact;
    comparison.words.push_back(fact ? token.text.substr(1) : token.text);
    ++at_;
    return {};
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

bool ordered(Sign sign, double a, double b) {
  switch (sign) {
    case Sign::equal: return a == b;
    case Sign::unequal: return a != b;
    case Sign::less: return a < b;
    case Sign::at_most: return a <= b;
    case Sign::more: return a > b;
    case Sign::at_least: return a >= b;
  }
  return false;
}

bool compares(const Comparison& c, const FactLookup& lookup) {
  const auto fact = lookup(c.fact);
  if (!fact) return false;
  std::vector<Fact> right;
  for (const auto& word : c.words) {
    if (c.of_fact) {
      const auto other = lookup(word);
      if (!other) return false;
      right.push_back(*other);
    } else {
      right.push_back({word, numberIn(word)});
    }
  }
  const auto one = [&](const Fact& other) {
    if (fact->number && other.number)
      return ordered(c.sign == Sign::unequal ? Sign::equal : c.sign, *fact->number, *other.number);
    return (c.sign == Sign::equal || c.sign == Sign::unequal) && fact->text == other.text;
  };
  const bool any = std::any_of(right.begin(), right.end(), one);
  return c.sign == Sign::unequal ? !any : any;
}

bool nodeHolds(const Node& node, const FactLookup& lookup) {
  const auto part = [&](const NodePointer& p) { return nodeHolds(*p, lookup); };
  switch (node.kind) {
    case Node::Kind::comparison: return compares(node.comparison, lookup);
    case Node::Kind::all: return std::all_of(node.parts.begin(), node.parts.end(), part);
    case Node::Kind::any: return std::any_of(node.parts.begin(), node.parts.end(), part);
    case Node::Kind::none: return !part(node.parts[0]);
  }
  return false;
}

struct Literal {
  Comparison comparison;
  bool negated = false;
};
using Case = std::vector<Literal>;  // all of them hold

tl::unexpected<Error> tooManyCases() { return failure(ErrorKind::unusable, "the condition has too many cases"); }

// The cases of which one must hold, `negated` or not.
Result<std::vector<Case>> casesOf(const Node& node, bool negated) {
  if (node.kind == Node::Kind::comparison) return std::vector<Case>{{{node.comparison, negated}}};
  if (node.kind == Node::Kind::none) return casesOf(*node.parts[0], !negated);
  const bool either = (node.kind == Node::Kind::any) != negated;
  std::vector<Case> cases(either ? 0 : 1);
  for (const auto& part : node.parts) {
    auto more = casesOf(*part, negated);
    if (!more) return more;
    if (either) {
      cases.insert(cases.end(), more->begin(), more->end());
    } else {
      if (cases.size() * more->size() > kMostCases) return tooManyCases();
      std::vector<Case> product;
      for (const auto& a : cases)
        for (const auto& b : *more) {
          product.push_back(a);
          product.back().insert(product.back().end(), b.begin(), b.end());
        }
      cases = std::move(product);
    }
    if (cases.size() > kMostCases) return tooManyCases();
  }
  return cases;
}

// What is left of a fact's domain.
class Possible {
 public:
  explicit Possible(FactDomain domain) : domain_(std::move(domain)), low_(domain_.minimum), high_(domain_.maximum) {}

  void narrow(const Literal& literal) {
    const auto& c = literal.comparison;
    if (c.of_fact) return;  // may hold or not
    const bool out = literal.negated != (c.sign == Sign::unequal);
    if (c.sign == Sign::equal || c.sign == Sign::unequal) return out ? exclude(c.words) : demand(c.words);
    const double bound = numberIn(c.words[0]).value_or(0);
    const bool below = (c.sign == Sign::less || c.sign == Sign::at_most) != literal.negated;
    const bool open = (c.sign == Sign::less || c.sign == Sign::more) != literal.negated;
    if (below && (bound < high_ || (bound == high_ && open))) high_ = bound, high_open_ = open;
    if (!below && (bound > low_ || (bound == low_ && open))) low_ = bound, low_open_ = open;
  }

  bool any() const {
    if (demanded_) {
      return std::any_of(demanded_->begin(), demanded_->end(), [&](const std::string& word) {
        return std::find(excluded_.begin(), excluded_.end(), word) == excluded_.end() && inDomain(word);
      });
    }
    if (domain_.is_number) return low_ < high_ || (low_ == high_ && !low_open_ && !high_open_);
    if (domain_.words.empty()) return true;
    return std::any_of(domain_.words.begin(), domain_.words.end(), [&](const std::string& word) {
      return std::find(excluded_.begin(), excluded_.end(), word) == excluded_.end();
    });
  }

 private:
  void exclude(const std::vector<std::string>& words) { excluded_.insert(excluded_.end(), words.begin(), words.end()); }
  void demand(const std::vector<std::string>& words) {
    if (!demanded_) {
      demanded_ = words;
      return;
    }
    std::erase_if(*demanded_,
                  [&](const std::string& w) { return std::find(words.begin(), words.end(), w) == words.end(); });
  }
  bool inDomain(const std::string& word) const {
    if (!domain_.is_number)
      return domain_.words.empty() ||
             std::find(domain_.words.begin(), domain_.words.end(), word) != domain_.words.end();
    const double v = numberIn(word).value_or(-1e301);
    return v >= low_ && v <= high_ && !(v == low_ && low_open_) && !(v == high_ && high_open_);
  }

  FactDomain domain_;
  double low_, high_;
  bool low_open_ = false, high_open_ = false;
  std::optional<std::vector<std::string>> demanded_;
  std::vector<std::string> excluded_;
};

Result<void> checkComparison(const Comparison& c, const DomainLookup& lookup) {
  const auto domain = lookup(c.fact);
  if (!domain) return failure(ErrorKind::unusable, fmt::format("unknown fact '{}'", c.fact));
  if (c.of_fact) {
    if (!lookup(c.words[0])) return failure(ErrorKind::unusable, fmt::format("unknown fact '{}'", c.words[0]));
    return {};
  }
  for (const auto& word : c.words) {
    const auto number = numberIn(word);
    if (c.sign != Sign::equal && c.sign != Sign::unequal && !number)
      return failure(ErrorKind::unusable,
                     fmt::format("'{}' is compared with '{}', which is not a number", c.fact, word));
    if (domain->is_number && !number)
      return failure(ErrorKind::unusable, fmt::format("'{}' is a number, '{}' is not", c.fact, word));
    if (!domain->is_number && c.sign != Sign::equal && c.sign != Sign::unequal)
      return failure(ErrorKind::unusable, fmt::format("'{}' is not a number", c.fact));
    if (!domain->is_number && !domain->words.empty() &&
        std::find(domain->words.begin(), domain->words.end(), word) == domain->words.end())
      return failure(ErrorKind::unusable,
                     fmt::format("'{}' is never '{}', only {}", c.fact, word, fmt::join(domain->words, ", ")));
  }
  return {};
}

Result<void> checkFacts(const Node& node, const DomainLookup& lookup) {
  if (node.kind == Node::Kind::comparison) return checkComparison(node.comparison, lookup);
  for (const auto& part : node.parts)
    if (auto ok = checkFacts(*part, lookup); !ok) return ok;
  return {};
}

void collectFacts(const Node& node, std::vector<std::string>& names) {
  const auto take = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (node.kind == Node::Kind::comparison) {
    take(node.comparison.fact);
    if (node.comparison.of_fact) take(node.comparison.words[0]);
  }
  for (const auto& part : node.parts) collectFacts(*part, names);
}

void collectComparisons(const Node& node, std::vector<Comparison>& found) {
  if (node.kind == Node::Kind::comparison) found.push_back(node.comparison);
  for (const auto& part : node.parts) collectComparisons(*part, found);
}

std::string nodeWorded(const Node& node, const Condition::Wording& wording) {
  if (node.kind == Node::Kind::comparison) return wording.comparison(node.comparison);
  if (node.kind == Node::Kind::none) return replaced(wording.none, "{what}", nodeWorded(*node.parts[0], wording));
  std::string text;
  for (const auto& part : node.parts) {
    const bool inner = node.kind == Node::Kind::all && part->kind == Node::Kind::any;
    const auto one = nodeWorded(*part, wording);
    text += (text.empty()                   ? ""
             : node.kind == Node::Kind::all ? wording.all
                                            : wording.any) +
            (inner ? "(" + one + ")" : one);
  }
  return text;
}

bool canHold(const Case& one, const DomainLookup& lookup) {
  std::vector<std::pair<std::string, Possible>> facts;
  for (const auto& literal : one) {
    auto found =
        std::find_if(facts.begin(), facts.end(), [&](const auto& f) { return f.first == literal.comparison.fact; });
    if (found == facts.end())
      found = facts.emplace(facts.end(), literal.comparison.fact, Possible(*lookup(literal.comparison.fact)));
    found->second.narrow(literal);
  }
  return std::all_of(facts.begin(), facts.end(), [](const auto& f) { return f.second.any(); });
}

}  // namespace

Fact numberFact(double number) { return {fmt::format("{}", number), number}; }

Result<Condition> Condition::parse(std::string_view text) {
  Condition condition;
  condition.text_ = text;
  if (text.find_first_not_of(" \t\n\r") == std::string_view::npos) return condition;
  if (text.size() > kLongest) return failure(ErrorKind::unusable, "the condition is too long");
  TRY_ASSIGN(auto found, tokens(text));
  TRY_ASSIGN(auto root, Parser(std::move(found)).whole());
  condition.root_ = root;
  return condition;
}

bool Condition::holds(const FactLookup& fact) const { return root_ == nullptr || nodeHolds(*root_, fact); }

std::vector<std::string> Condition::facts() const {
  std::vector<std::string> names;
  if (root_ != nullptr) collectFacts(*root_, names);
  return names;
}

std::vector<Condition::Comparison> Condition::comparisons() const {
  std::vector<Comparison> found;
  if (root_ != nullptr) collectComparisons(*root_, found);
  return found;
}

std::string Condition::worded(const Wording& wording) const {
  return root_ == nullptr ? std::string() : nodeWorded(*root_, wording);
}

Result<void> Condition::check(const DomainLookup& domain) const {
  if (root_ == nullptr) return {};
  if (auto ok = checkFacts(*root_, domain); !ok) return ok;
  TRY_ASSIGN(const auto cases, casesOf(*root_, false));
  if (std::none_of(cases.begin(), cases.end(), [&](const Case& one) { return canHold(one, domain); }))
    return failure(ErrorKind::unusable, fmt::format("'{}' can never be true", text_));
  return {};
}

Condition conditionAt(JsonFields& fields, std::string_view key) {
  auto parsed = Condition::parse(fields.textOr(key, "", "setups >= 1"));
  if (!parsed) fields.wrong(key, parsed.error().message);
  return std::move(parsed).value_or(Condition());
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/step_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "fast_float/fast_float.h"
#include "importers/ifc/model/step_bytes.h"

namespace standpoint::ifc {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v' || c == '\0'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameChar(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || isDigit(c) || c == '_' || c == '-';
}

const char* skipComment(const char* p, const char* end) {  // at "/*"
  for (p += 2; p < end; ++p) {
    p = static_cast<const char*>(std::memchr(p, '*', static_cast<std::size_t>(end - p)));
    if (!p) return end;
    if (p + 1 < end && p[1] == '/') return p + 2;
  }
  return end;
}

bool atComment(const char* p, const char* end) { return *p == '/' && p + 1 < end && p[1] == '*'; }

const char* skipSpace(const char* p, const char* end) {
  while (p < end) {
    if (isSpace(*p))
      ++p;
    else if (atComment(p, end))
      p = skipComment(p, end);
    else
      break;
  }
  return p;
}

// At the quote; a doubled quote reads as two strings in a row. Some writers of Japanese text escape bytes as \S\c even
// where c is the quote itself, without doubling it: such a quote does not end the string.
const char* skipQuoted(const char* p, const char* end) {
  const char* const begin = p;
  const char quote = *p;
  while (++p < end) {
    p = static_cast<const char*>(std::memchr(p, quote, static_cast<std::size_t>(end - p)));
    if (!p) return end;
    const bool escaped = p - begin > 3 && p[-1] == '\\' && p[-2] == 'S' && p[-3] == '\\';
    if (!escaped) return p + 1;
    const bool doubled = p + 2 < end && p[1] == quote && p[2] != ',' && p[2] != ')';
    if (doubled) ++p;
  }
  return end;
}

// Up to the comma or parenthesis that ends the value, or to the end of the record.
const char* skipValue(const char* p, const char* end) {
  std::size_t depth = 0;
  while (p < end) {
    switch (*p) {
      case '(':
        ++depth;
        ++p;
        break;
      case ')':
        if (depth == 0) return p;
        --depth;
        ++p;
        break;
      case ',':
        if (depth == 0) return p;
        ++p;
        break;
      case ';': return p;
      case '\'':
      case '"': p = skipQuoted(p, end); break;
      case '/': p = atComment(p, end) ? skipComment(p, end) : p + 1; break;
      default: ++p;
    }
  }
  return p;
}

std::string_view nameAt(const char* p, const char* end) {
  const char* begin = p;
  while (p < end && isNameChar(*p)) ++p;
  return {begin, static_cast<std::size_t>(p - begin)};
}

}  // namespace

bool Value::present() const { return at_ && *at_ != '$' && *at_ != '*' && *at_ != ',' && *at_ != ')'; }

Id Value::reference() const {
  if (!isReference()) return 0;
  Id id = 0;
  const auto [stop, error] = std::from_chars(at_ + 1, end_, id);
  return error == std::errc() ? id : 0;
}

std::optional<double> Value::number() const {
  const Value v = inner();
  if (!v.at_) return {};
  const char* p = v.at_;
  if (*p == '+') ++p;
  double x = 0;
  const auto [stop, error] = fast_float::from_chars(p, v.end_, x);
  if (error != std::errc() || !(x - x == 0)) return {};  // neither infinite nor not-a-number
  if (stop < v.end_ && *stop == '#') return {};          // 1.#QNAN and 1.#INF of old run-time libraries
  return x;
}

std::int64_t Value::integer(std::int64_t otherwise) const {
  const Value v = inner();
  if (!v.at_) return otherwise;
  std::int64_t x = 0;
  const auto [stop, error] = std::from_chars(v.at_ + (*v.at_ == '+' ? 1 : 0), v.end_, x);
  return error == std::errc() ? x : otherwise;
}

std::string Value::text() const {
  const Value v = inner();
  if (!v.isText()) return {};
  const char* p = v.at_;
  const char* stop = skipQuoted(p, v.end_);
  while (stop < v.end_ && *stop == '\'') stop = skipQuoted(stop, v.end_);
  return decodeText({p + 1, static_cast<std::size_t>(std::max(stop - p - 2, std::ptrdiff_t{0}))});
}

std::string_view Value::symbol() const {
  const Value v = inner();
  if (!v.at_ || *v.at_ != '.') return {};
  const std::string_view name = nameAt(v.at_ + 1, v.end_);
  return v.at_ + 1 + name.size() < v.end_ && v.at_[1 + name.size()] == '.' && !isDigit(v.at_[1]) ? name
                                                                                                 : std::string_view{};
}

std::string_view Value::typeName() const {
  if (!at_ || !(isNameChar(*at_) && !isDigit(*at_) && *at_ != '-')) return {};
  const std::string_view name = nameAt(at_, end_);
  const char* p = skipSpace(at_ + name.size(), end_);
  return p < end_ && *p == '(' ? name : std::string_view{};
}

Value Value::inner() const {
  Value v = *this;
  for (int nested = 0; nested < 4; ++nested) {  // a select of a select; deeper than that is nonsense
    const std::string_view name = v.typeName();
    if (name.empty()) break;
    const char* p = skipSpace(v.at_ + name.size(), v.end_);
    p = skipSpace(p + 1, v.end_);
    v = p < v.end_ ? Value(p, v.end_) : Value();
  }
  return v;
}

std::string_view Value::raw() const {
  if (!at_) return {};
  return {at_, static_cast<std::size_t>(skipValue(at_, end_) - at_)};
}

Value::Iterator Value::begin() const {
  if (!isList()) return end();
  const char* p = skipSpace(at_ + 1, end_);
  return p < end_ && *p != ')' && *p != ';' ? Iterator(p, end_) : end();
}

Value::Iterator& Value::Iterator::operator++() {
  const char* p = skipValue(at_, end_);
  at_ = nullptr;
  if (p < end_ && *p == ',') {
    p = skipSpace(p + 1, end_);
    if (p < end_ && *p != ';') at_ = p;
  }
  if (!at_) end_ = nullptr;
  return *this;
}

std::size_t Value::size() const {
  std::size_t n = 0;
  for (auto it = begin(); it != end(); ++it) ++n;
  return n;
}

std::string_view Entity::typeName() const {
  return record_ ? std::string_view(file_->typeNames()[record_->type]) : std::string_view();
}

Value Entity::arguments() const {
  if (!record_) return {};
  const std::string& text = file_->text();
  return {text.data() + record_->offset, text.data() + text.size()};
}

Value Entity::operator[](std::size_t index) const {
  const Value all = arguments();
  auto it = all.begin();
  for (; index > 0 && it != all.end(); --index) ++it;
  return it != all.end() ? *it : Value();
}

Entity Entity::follow(const Value& value) const { return record_ ? file_->entity(value.reference()) : Entity(); }

std::vector<Entity> Entity::refs(std::size_t index) const {
  std::vector<Entity> found;
  for (const Value v : (*this)[index])
    if (const Entity e = follow(v)) found.push_back(e);
  return found;
}

Value Entity::dangling(std::size_t index) const {
  for (const Value v : (*this)[index])
    if (v.present() && !follow(v)) return v;
  return {};
}

std::string shown(const Value& value) {
  std::string text(value.raw().substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string notInFile(const Value& reference) { return shown(reference) + ", which the file does not have"; }

Entity StepFile::entity(Id id) const {
  if (id == 0) return {};
  if (!position_of_id_.empty()) {
    if (id >= position_of_id_.size() || position_of_id_[id] == 0) return {};
    return {this, &records_[position_of_id_[id] - 1]};
  }
  const auto it =
      std::lower_bound(records_.begin(), records_.end(), id, [](const Record& r, Id i) { return r.id < i; });
  return it != records_.end() && it->id == id ? Entity(this, &*it) : Entity();
}

std::vector<Entity> StepFile::all(std::string_view upper_case_name) const {
  std::vector<Entity> found;
  const auto it = std::find(type_names_.begin(), type_names_.end(), upper_case_name);
  if (it == type_names_.end()) return found;
  for (const std::uint32_t p : positions_of_type_[static_cast<std::size_t>(it - type_names_.begin())])
    found.push_back(at(p));
  return found;
}

std::size_t StepFile::lineOf(std::size_t offset) const {
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min(offset, text_.size()); ++i)
    if (text_[i] == '\n' || (text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n'))) ++line;
  return line;
}

// The one pass over the text.
class Scanner {
 public:
  Scanner(StepFile& file, const std::string& name, Report& report)
      : file_(file), name_(name), report_(report), p_(file.text_.data()), end_(p_ + file.text_.size()) {}

  Result<void> run() {
    file_.type_names_.emplace_back();
    if (std::string_view(p_, static_cast<std::size_t>(end_ - p_)).starts_with("\xEF\xBB\xBF")) p_ += 3;
    if (!std::string_view(skipSpace(p_, end_), end_).starts_with("ISO-10303-21"))
      report_.warn("line 1", "missing header ISO-10303-21");
    for (p_ = skipSpace(p_, end_); p_ < end_; p_ = skipSpace(p_, end_)) {
      const auto done = *p_ == '#' ? record() : statement();
      if (!done) return done;
    }
    if (!data_) return failure(ErrorKind::unusable, "no DATA section: not a STEP physical file", name_ + " line 1");
    if (!ended_) report_.lose(line(end_), "the file ends inside its DATA section: the rest is missing");
    sortRecords();
    return {};
  }

 private:
  std::string line(const char* p) const {
    return "line " + std::to_string(file_.lineOf(static_cast<std::size_t>(p - file_.text_.data())));
  }

  // To the semicolon that ends what begins at p; nullptr when the file ends first.
  const char* statementEnd(const char* p) {
    int depth = 0;
    deepest_ = 0;
    while (p < end_) {
      switch (*p) {
        case ';': return p;
        case '(':
          deepest_ = std::max(deepest_, ++depth);
          ++p;
          break;
        case ')':
          --depth;
          ++p;
          break;
        case '\'':
        case '"': p = skipQuoted(p, end_); break;
        case '/': p = atComment(p, end_) ? skipComment(p, end_) : p + 1; break;
        default: ++p;
      }
    }
    return nullptr;
  }

  // What was complete before the cut is kept: half a building, said aloud, serves better than none.
  Result<void> cut(const char* begin, const std::string& what) {
    if (!file_.records_.empty()) {
      report_.lose(line(begin),
                   "the file ends inside " + what + ": truncated file or unclosed string; the rest is missing");
      p_ = end_;
      ended_ = true;
      return {};
    }
    return failure(ErrorKind::unusable, "the file ends inside " + what + ": truncated file or unclosed string",
                   name_ + " " + line(begin));
  }

  Result<void> statement() {
    const char* begin = p_;
    const std::string_view name = nameAt(p_, end_);
    const char* stop = statementEnd(p_);
    if (name == "FILE_SCHEMA" && stop) schema(p_ + name.size());
    if (name == "DATA") data_ = true, ended_ = false;
    if (name == "ENDSEC" && data_) ended_ = true;
    if (!stop) {
      if (name == "END-ISO-10303-21") return p_ = end_, Result<void>{};
      if (data_ && !ended_) return cut(begin, "a statement");
      p_ = end_;
      return {};
    }
    if (name.empty() && data_) tolerate(begin, "skipped text that is not a record");
    p_ = stop + 1;
    return {};
  }

  void schema(const char* p) {
    const char* quote = static_cast<const char*>(std::memchr(p, '\'', static_cast<std::size_t>(end_ - p)));
    if (!quote) return;
    file_.schema_ = Value(quote, end_).text();
    std::transform(file_.schema_.begin(), file_.schema_.end(), file_.schema_.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  }

  Result<void> record() {
    const char* begin = p_;
    Id id = 0;
    const auto [after, error] = std::from_chars(p_ + 1, end_, id);
    const char* p = skipSpace(after, end_);
    const char* stop = statementEnd(p);
    if (!stop) return cut(begin, "record #" + std::to_string(id));
    p_ = stop + 1;
    if (error != std::errc() || id == 0 || p >= stop || *p != '=')
      return tolerate(begin, "skipped a record without a valid number"), Result<void>{};
    p = skipSpace(p + 1, end_);
    const std::string_view name = nameAt(p, end_);
    p = skipSpace(p + name.size(), end_);
    if (name.empty() || p >= stop || *p != '(')
      return tolerate(begin, "record #" + std::to_string(id) + " is not a simple entity and was skipped"),
             Result<void>{};
    data_ = true;  // records without a header: fragments are read, too
    if (deepest_ > kDeepest)
      tolerate(begin, "record #" + std::to_string(id) + " (" + std::string(name.substr(0, 80)) +
                          ") nests parentheses more than 100 deep; what they hold is not read");
    file_.records_.push_back({id, intern(name), static_cast<std::uint64_t>(p - file_.text_.data())});
    return {};
  }

  std::uint32_t intern(std::string_view name) {
    const auto known = types_.find(name);
    if (known != types_.end()) return known->second;
    std::string upper(name);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    auto& names = file_.type_names_;
    auto it = std::find(names.begin(), names.end(), upper);
    if (it == names.end()) it = names.insert(names.end(), upper);
    const auto type = static_cast<std::uint32_t>(it - names.begin());
    types_.emplace(name, type);
    return type;
  }

  void tolerate(const char* at, const std::string& what) {
    constexpr int kTold = 20;  // a hostile file would fill the memory with complaints
    if (++tolerated_ <= kTold) report_.lose(line(at), what);
    if (tolerated_ == kTold) report_.lose(line(at), "further occurrences not listed");
  }

  void sortRecords() {
    auto& records = file_.records_;
    const auto by_id = [](const Record& a, const Record& b) { return a.id < b.id; };
    if (!std::is_sorted(records.begin(), records.end(), by_id)) std::stable_sort(records.begin(), records.end(), by_id);
    const auto same_id = [](const Record& a, const Record& b) { return a.id == b.id; };
    const auto twice = std::adjacent_find(records.begin(), records.end(), same_id);
    if (twice != records.end()) {
      report_.warn("#" + std::to_string(twice->id), "duplicate record numbers; the first record of each is used");
      records.erase(std::unique(twice, records.end(), same_id), records.end());
    }
    file_.positions_of_type_.resize(file_.type_names_.size());
    for (std::size_t i = 0; i < records.size(); ++i)
      file_.positions_of_type_[records[i].type].push_back(static_cast<std::uint32_t>(i));
    const std::size_t highest = records.empty() ? 0 : records.back().id;
    if (highest > 8 * records.size() + 1000) return;  // sparse numbers: search instead
    file_.position_of_id_.resize(highest + 1);
    for (std::size_t i = 0; i < records.size(); ++i)
      file_.position_of_id_[records[i].id] = static_cast<std::uint32_t>(i + 1);
  }

  StepFile& file_;
  const std::string& name_;
  Report& report_;
  const char* p_;
  const char* end_;
  static constexpr int kDeepest = 100;  // parentheses; the schema has at most eight
  int deepest_ = 0;                     // of the statement that was read last
  bool data_ = false;
  bool ended_ = false;
  int tolerated_ = 0;
  std::unordered_map<std::string_view, std::uint32_t> types_;  // for look-up only
};

Result<StepFile> StepFile::read(const std::filesystem::path& file, Report& report) {
  TRY_ASSIGN(auto text, readStepBytes(file));
  return parse(std::move(text), file.filename().string(), report);
}

Result<StepFile> StepFile::parse(std::string text, const std::string& name, Report& report) {
  StepFile file;
  file.text_ = std::move(text);
  TRY(Scanner(file, name, report).run());
  return file;
}

}  // namespace standpoint::ifc

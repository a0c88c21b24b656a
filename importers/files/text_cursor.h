// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include <fast_float/fast_float.h>

namespace standpoint {

// Walks through the lines and words of an OBJ, MTL, PLY or STL text, counting lines. Lines end in LF, CR LF or CR; a
// backslash before the end of a line continues it; what else is below a space counts as a space. The text must end with
// a line's end, which is what stops every inner loop.
class TextCursor {
 public:
  // The line's number is that of the first line, from 1.
  TextCursor(std::string_view text, std::size_t line)
      : at_(text.data()), end_(text.data() + text.size()), line_(line) {}

  bool done() const { return at_ >= end_; }
  std::size_t line() const { return line_; }
  const char* at() const { return at_; }
  char peek() const { return *at_; }
  void advance(std::size_t count = 1) { at_ += count; }
  bool atLineEnd() const { return *at_ == '\n' || *at_ == '\r'; }

  // Over spaces and continued line ends.
  void skipSpaces() {
    for (;;) {
      if (static_cast<unsigned char>(*at_) <= ' ' && !atLineEnd())
        ++at_;
      else if (*at_ != '\\' || !continues())
        return;
    }
  }

  // The rest of the statement is of no interest.
  void skipStatement() {
    for (;;) {
      at_ = lineEnd();
      const bool continued = at_[-1] == '\\';
      nextLine();
      if (!continued || done()) return;
    }
  }

  // A comment is not continued: a path that ends in a backslash is likelier than that.
  void skipComment() {
    at_ = lineEnd();
    nextLine();
  }

  // At the end of a statement, or at a comment after it.
  bool atStatementEnd() const { return atLineEnd() || *at_ == '#'; }
  void finishStatement() { *at_ == '#' ? skipComment() : nextLine(); }

  bool atWordEnd() const { return static_cast<unsigned char>(*at_) <= ' '; }

  std::string_view word() {
    const char* from = at_;
    while (!atWordEnd()) ++at_;
    return {from, static_cast<std::size_t>(at_ - from)};
  }

  // What is left of the statement without the spaces around it; a '#' after a space begins a comment.
  std::string rest() {
    std::string text;
    for (bool more = true; more && !done();) {
      const char* from = at_;
      at_ = lineEnd();
      more = at_ > from && at_[-1] == '\\';
      text.append(from, at_ - (more ? 1 : 0));
      if (more) text += ' ';
      nextLine();
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (static_cast<unsigned char>(text[i]) < ' ') text[i] = ' ';
      if (text[i] == '#' && (i == 0 || text[i - 1] == ' ')) text.resize(i);
    }
    const auto first = text.find_first_not_of(' ');
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
  }

  // A number up to the next space; false leaves the cursor where it was. Infinite and not-a-number count as numbers.
  bool number(double& value) {
    const char* from = *at_ == '+' && at_[1] != '-' ? at_ + 1 : at_;
    const auto [after, error] = fast_float::from_chars(from, end_, value);
    if (error == std::errc::invalid_argument ||
        (static_cast<unsigned char>(*after) > ' ' && *after != '\\' && *after != '#'))
      return false;
    at_ = after;
    return true;
  }

 private:
  bool continues() {
    if (at_[1] != '\n' && at_[1] != '\r') return false;
    ++at_;
    nextLine();
    if (done()) at_ = end_ - 1;  // the last line's end stays, whatever came before it
    return true;
  }

  const char* lineEnd() {
    if (next_lf_ < at_) next_lf_ = find('\n');
    if (next_cr_ < at_) next_cr_ = find('\r');
    return next_lf_ < next_cr_ ? next_lf_ : next_cr_;
  }

  // Remembered, so that a text with one kind of line end is searched for the other only once.
  const char* find(char c) const {
    const void* found = std::memchr(at_, c, static_cast<std::size_t>(end_ - at_));
    return found != nullptr ? static_cast<const char*>(found) : end_;
  }

  void nextLine() {
    at_ += *at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }

  const char* at_;
  const char* end_;
  std::size_t line_;
  const char* next_lf_ = nullptr;
  const char* next_cr_ = nullptr;
};

}  // namespace standpoint

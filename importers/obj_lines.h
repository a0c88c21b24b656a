// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <streambuf>
#include <string>
#include <string_view>

namespace standpoint {

// Hands a text to a stream reader one statement at a time, so that its callbacks know the line they come from: joins
// continued lines, drops comments, and lets `keep` see each statement first. What `keep` refuses is not handed on.
class ObjLines : public std::streambuf {
 public:
  ObjLines(std::string_view text, std::function<bool(std::string_view statement)> keep)
      : rest_(text), keep_(std::move(keep)) {}

  std::size_t line() const { return line_; }   // of the statement handed out last, from 1
  double share() const { return size_ == 0 ? 1 : 1 - static_cast<double>(rest_.size()) / static_cast<double>(size_); }
  void stop() { rest_ = {}; }

 protected:
  int_type underflow() override;

 private:
  std::string_view physicalLine();
  void nextStatement();

  std::string_view rest_;
  std::function<bool(std::string_view)> keep_;
  std::string statement_;
  std::size_t line_ = 0, lines_read_ = 0, size_ = rest_.size();
};

}  // namespace standpoint

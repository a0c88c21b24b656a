// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A reader of STEP physical files (ISO 10303-21). One pass finds where each record begins and what it is; arguments are
// read from the text when somebody asks for them, so a record that nobody needs costs nothing but its bytes. The text
// is never trusted: every step of a cursor is bounded by the end of the file, and nothing recurses.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/report.h"
#include "core/result.h"

namespace standpoint::ifc {

using Id = std::uint32_t;  // "#12"; 0 stands for none

// One argument: a place in the text. An argument that is missing, `$` or `*` is not present.
class Value {
 public:
  Value() = default;
  Value(const char* at, const char* end) : at_(at), end_(end) {}

  bool present() const;
  bool isList() const { return at_ && *at_ == '('; }
  bool isText() const { return at_ && *at_ == '\''; }
  bool isReference() const { return at_ && *at_ == '#'; }
  bool isSymbol() const { return at_ && *at_ == '.' && !number(); }

  Id reference() const;                  // 0 when it is none
  std::optional<double> number() const;  // also of IFCLENGTHMEASURE(2.5)
  double number(double otherwise) const { return number().value_or(otherwise); }
  std::int64_t integer(std::int64_t otherwise = 0) const;
  std::string text() const;         // decoded to UTF-8; also of IFCLABEL('a')
  std::string_view symbol() const;  // "ELEMENT" of .ELEMENT.; empty when it is none
  bool isTrue() const { return symbol() == "T"; }
  std::string_view typeName() const;  // "IFCLABEL" of IFCLABEL('a'), else empty
  Value inner() const;                // 'a' of IFCLABEL('a'), else itself
  std::string_view raw() const;       // as it stands in the file

  class Iterator {
   public:
    Iterator(const char* at, const char* end) : at_(at), end_(end) {}
    Value operator*() const { return {at_, end_}; }
    Iterator& operator++();
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const char* at_;
    const char* end_;
  };
  Iterator begin() const;  // the items of a list; of anything else there are none
  Iterator end() const { return {nullptr, nullptr}; }
  std::size_t size() const;  // counts, so do not call it in a loop

 private:
  const char* at_ = nullptr;
  const char* end_ = nullptr;
};

struct Record {
  Id id = 0;
  std::uint32_t type = 0;    // index into StepFile::typeNames
  std::uint64_t offset = 0;  // of the opening parenthesis
};

class StepFile;

// A record with its file; the null entity stands for what the file does not have and answers every question with
// nothing.
class Entity {
 public:
  Entity() = default;
  Entity(const StepFile* file, const Record* record) : file_(file), record_(record) {}
  explicit operator bool() const { return record_ != nullptr; }
  bool operator==(const Entity& other) const { return record_ == other.record_; }

  Id id() const { return record_ ? record_->id : 0; }
  std::string place() const { return "#" + std::to_string(id()); }
  std::uint32_t type() const { return record_ ? record_->type : 0; }
  std::string_view typeName() const;  // upper case; empty for the null entity
  bool is(std::string_view upper_case_name) const { return typeName() == upper_case_name; }

  Value arguments() const;                    // the list of all
  Value operator[](std::size_t index) const;  // walks over the arguments before it
  Entity ref(std::size_t index) const { return follow((*this)[index]); }
  Entity follow(const Value& value) const;            // the record that a value of the same file points to
  std::vector<Entity> refs(std::size_t index) const;  // those of a list that exist
  Value dangling(std::size_t index) const;            // the first item of that list that is there and is no record

  template <std::size_t N>
  std::array<Value, N> first() const {  // the first N arguments in one walk
    std::array<Value, N> values;
    std::size_t count = 0;
    const Value all = arguments();
    for (auto it = all.begin(); count < N && it != all.end(); ++it) values[count++] = *it;
    return values;
  }

 private:
  friend class StepFile;
  const StepFile* file_ = nullptr;
  const Record* record_ = nullptr;
};

class StepFile {
 public:
  // Reads plain, gzipped and zipped (.ifczip) text. What was tolerated is told in `report`.
  static Result<StepFile> read(const std::filesystem::path& file, Report& report);
  static Result<StepFile> parse(std::string text, const std::string& name, Report& report);

  const std::string& schema() const { return schema_; }                      // "IFC4X3_ADD2" as the header says
  const std::vector<std::string>& typeNames() const { return type_names_; }  // upper case; [0] is empty
  const std::vector<Record>& records() const { return records_; }            // sorted by id, ids are unique
  Entity entity(Id id) const;
  Entity at(std::size_t index) const { return {this, &records_[index]}; }
  // Position in records() of an entity that is not null.
  std::size_t indexOf(const Entity& entity) const { return static_cast<std::size_t>(entity.record_ - records_.data()); }
  std::vector<Entity> all(std::string_view upper_case_name) const;  // in the order of their ids
  const std::string& text() const { return text_; }
  std::size_t lineOf(std::size_t offset) const;  // 1 …

 private:
  friend class Scanner;
  std::string text_;
  std::string schema_;
  std::vector<std::string> type_names_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> position_of_id_;  // while ids are dense, else empty
  std::vector<std::vector<std::uint32_t>> positions_of_type_;
};

std::string shown(const Value& value);          // as it stands in the file, its first 40 letters, for messages
std::string notInFile(const Value& reference);  // "#12, which the file does not have"

// "Wand" of 'W\X\61nd' and the other escapes of part 21 clause 6.4.3; bytes that are not UTF-8 are taken as Latin-1.
std::string decodeText(std::string_view quoted_content);
int hexDigit(char c);  // its value, or -1

}  // namespace standpoint::ifc

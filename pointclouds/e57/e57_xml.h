// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace standpoint::e57 {

// Text of the XML section, element by element; what XML 1.0 cannot carry becomes U+FFFD.
class XmlWriter {
 public:
  void open(std::string_view name, std::string_view attributes);
  void close(std::string_view name);
  void string(std::string_view name, std::string_view value);
  void integer(std::string_view name, std::int64_t value);
  // Neither NaN, infinity nor a negative zero may stand in the file (E2807 8.3.1.2): the first two become 0.
  void real(std::string_view name, double value);
  void leaf(std::string_view name, std::string_view attributes);
  void append(std::string_view elements) { text_.append(elements); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// An element as it was read. Names keep their prefix.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  std::vector<std::unique_ptr<Element>> children;

  const Element* child(std::string_view wanted) const;
  std::string_view attribute(const std::string& wanted) const;
};

// Elements are at most 64 deep; a document type is refused, and with it every entity of the author's own.
Result<std::unique_ptr<Element>> parseXml(std::string_view xml, const std::string& source);

}  // namespace standpoint::e57

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/environment.h"
#include "importers/ifc/writer/step_writer.h"

namespace standpoint::ifc {

// "2.5" and "mm" of "2.5 mm".
struct Quantity {
  std::string number;  // empty where the text is not a number
  std::string unit;    // symbol; empty: none
};
Quantity quantityOf(std::string_view text);
// Metres of "2700 mm", "9 FOOT" or "2.7"; nothing of what is no length.
std::optional<double> metresOf(std::string_view text);

// The units of the file: metre and radian, and for each other kind of measure the one that most properties have, unless
// some have none. Other units stand with the property itself.
class UnitWriter {
 public:
  UnitWriter(const Environment& environment, StepWriter& out);
  Ref assignment() const { return assignment_; }
  Ref metre() const { return metre_; }
  // Of a value of this type; 0 where the project's unit is meant, or none.
  Ref unitOf(PropertyType type, const std::string& symbol);

 private:
  Ref write(const std::string& unit_type, const std::string& symbol);
  Ref writeSi(const std::string& unit_type, std::string_view prefix, std::string_view name);
  Ref writeDerived(const std::string& unit_type, std::string_view symbol);
  StepWriter& out_;
  std::map<std::string, std::string> symbol_of_type_;  // of the project: "MASSUNIT" → "kg"
  Ref metre_ = 0, assignment_ = 0;
};

}  // namespace standpoint::ifc

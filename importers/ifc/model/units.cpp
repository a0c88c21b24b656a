// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace standpoint::ifc {
namespace {

struct Prefix {
  const char* name;
  const char* symbol;
  double factor;
};
constexpr std::array<Prefix, 16> kPrefixes{{{"EXA", "E", 1e18},
                                            {"PETA", "P", 1e15},
                                            {"TERA", "T", 1e12},
                                            {"GIGA", "G", 1e9},
                                            {"MEGA", "M", 1e6},
                                            {"KILO", "k", 1e3},
                                            {"HECTO", "h", 1e2},
                                            {"DECA", "da", 1e1},
                                            {"DECI", "d", 1e-1},
                                            {"CENTI", "c", 1e-2},
                                            {"MILLI", "m", 1e-3},
                                            {"MICRO", "µ", 1e-6},
                                            {"NANO", "n", 1e-9},
                                            {"PICO", "p", 1e-12},
                                            {"FEMTO", "f", 1e-15},
                                            {"ATTO", "a", 1e-18}}};

struct SiUnit {
  const char* name;
  const char* symbol;
  int power;  // of the prefix: a square millimetre is (milli)² m²
};
constexpr std::array<SiUnit, 22> kSiUnits{
    {{"METRE", "m", 1},           {"SQUARE_METRE", "m²", 2}, {"CUBIC_METRE", "m³", 3}, {"RADIAN", "rad", 1},
     {"STERADIAN", "sr", 1},      {"GRAM", "g", 1},          {"SECOND", "s", 1},       {"KELVIN", "K", 1},
     {"DEGREE_CELSIUS", "°C", 1}, {"WATT", "W", 1},          {"JOULE", "J", 1},        {"NEWTON", "N", 1},
     {"PASCAL", "Pa", 1},         {"AMPERE", "A", 1},        {"VOLT", "V", 1},         {"OHM", "Ω", 1},
     {"HERTZ", "Hz", 1},          {"LUMEN", "lm", 1},        {"LUX", "lx", 1},         {"CANDELA", "cd", 1},
     {"MOLE", "mol", 1},          {"FARAD", "F", 1}}};

template <class Row, std::size_t N>
const Row* find(const std::array<Row, N>& rows, std::string_view name) {
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return name == r.name; });
  return it == rows.end() ? nullptr : &*it;
}

}  // namespace

double siFactor(const Entity& unit) {
  double factor = 1;
  Entity e = unit;
  for (int nested = 0; e && nested < 16; ++nested) {  // a unit may be stated by way of others; a circle ends here
    if (e.is("IFCSIUNIT")) {
      const Prefix* prefix = find(kPrefixes, e[2].symbol());
      const SiUnit* si = find(kSiUnits, e[3].symbol());
      return factor * std::pow(prefix ? prefix->factor : 1.0, si ? si->power : 1);
    }
    if (e.is("IFCCONVERSIONBASEDUNIT") || e.is("IFCCONVERSIONBASEDUNITWITHOFFSET"))
      e = e.ref(3);
    else if (e.is("IFCMEASUREWITHUNIT"))
      factor *= e[0].number(1), e = e.ref(1);
    else
      return 0;
  }
  return 0;
}

namespace {

std::string power(std::int64_t exponent) {
  if (exponent == 1) return {};
  constexpr std::array kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  return exponent >= 0 && exponent < 10 ? kDigits[static_cast<std::size_t>(exponent)] : "^" + std::to_string(exponent);
}

// "W/(m²·K)".
std::string derivedSymbol(const Entity& unit) {
  std::string above, below;
  int divisors = 0;
  for (const Entity& element : unit.refs(0)) {
    const Entity of = element.ref(0);
    const auto exponent = element[1].integer(1);
    if (of.is("IFCDERIVEDUNIT") || exponent == 0) continue;
    const std::string symbol = unitSymbol(of);
    if (symbol.empty()) return {};
    std::string& side = exponent > 0 ? above : below;
    if (exponent < 0) ++divisors;
    side += (side.empty() ? "" : "·") + symbol + power(exponent > 0 ? exponent : -exponent);
  }
  if (above.empty() && below.empty()) return {};
  if (below.empty()) return above;
  return (above.empty() ? "1" : above) + "/" + (divisors > 1 ? "(" + below + ")" : below);
}

// Whether arcs are trimmed by numbers that no radian has: more than a whole turn.
bool arcsCountDegrees(const StepFile& file) {
  constexpr double kTurn = 6.2832;
  for (const Entity& trimmed : file.all("IFCTRIMMEDCURVE")) {
    const Entity basis = trimmed.ref(0);
    if (!basis.is("IFCCIRCLE") && !basis.is("IFCELLIPSE")) continue;
    for (const std::size_t end : {1U, 2U})
      for (const Value v : trimmed[end])
        if (const auto t = v.number(); t && std::abs(*t) > kTurn + 0.01) return true;
  }
  return false;
}

}  // namespace

std::string unitSymbol(const Entity& unit) {
  if (unit.is("IFCDERIVEDUNIT")) return derivedSymbol(unit);
  if (unit.is("IFCSIUNIT")) {
    const Prefix* prefix = find(kPrefixes, unit[2].symbol());
    const SiUnit* si = find(kSiUnits, unit[3].symbol());
    return si ? std::string(prefix ? prefix->symbol : "") + si->symbol : std::string();
  }
  if (unit.is("IFCCONVERSIONBASEDUNIT") || unit.is("IFCCONVERSIONBASEDUNITWITHOFFSET") ||
      unit.is("IFCCONTEXTDEPENDENTUNIT"))
    return unit[2].text();
  if (unit.is("IFCMONETARYUNIT")) return unit[0].isText() ? unit[0].text() : std::string(unit[0].symbol());
  return {};
}

std::string unitTypeOf(std::string_view measure) {
  // The schema names measures and units alike but for these.
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kOdd{
      {{"IFCQUANTITYWEIGHT", "MASSUNIT"},
       {"IFCMONETARYMEASURE", "MONETARYUNIT"},
       {"IFCQUANTITYCOUNT", ""},
       {"IFCQUANTITYNUMBER", ""},
       {"IFCTHERMALCONDUCTIVITYMEASURE", "THERMALCONDUCTANCEUNIT"},
       {"IFCSECTIONALAREAINTEGRALMEASURE", "SECTIONAREAINTEGRALUNIT"}}};
  for (const auto& [name, unit] : kOdd)
    if (measure == name) return unit;
  if (measure.starts_with("IFCQUANTITY")) return std::string(measure.substr(11)) + "UNIT";
  if (!measure.starts_with("IFC") || !measure.ends_with("MEASURE")) return {};
  std::string_view core = measure.substr(3, measure.size() - 10);
  for (const std::string_view sign : {"POSITIVE", "NONNEGATIVE"})
    if (core.starts_with(sign)) core.remove_prefix(sign.size());
  return std::string(core) + "UNIT";
}

std::optional<SiUnitName> siUnitOf(std::string_view symbol) {
  for (const SiUnit& unit : kSiUnits)
    if (symbol == unit.symbol) return SiUnitName{{}, unit.name, 1};
  for (const SiUnit& unit : kSiUnits)
    for (const Prefix& prefix : kPrefixes)
      if (symbol == std::string(prefix.symbol) + unit.symbol)
        return SiUnitName{prefix.name, unit.name, std::pow(prefix.factor, unit.power)};
  return {};
}

Units readUnits(const StepFile& file, double given_m, Report& report) {
  Units units;
  Entity assignment;
  for (const Entity& project : file.all("IFCPROJECT"))
    if (!assignment) assignment = project.ref(8);
  if (!assignment)
    for (const Entity& any : file.all("IFCUNITASSIGNMENT"))
      if (!assignment) assignment = any;
  bool length = false, angle = false;
  for (const Entity& unit : assignment.refs(0)) {
    const std::string type(unit.is("IFCMONETARYUNIT") ? std::string_view("MONETARYUNIT") : unit[1].symbol());
    const double factor = siFactor(unit);
    if (const std::string symbol = unitSymbol(unit); !symbol.empty()) units.symbol_of_type.emplace(type, symbol);
    const bool usable = factor > 0 && std::isfinite(factor);
    if (type == "LENGTHUNIT" && usable) units.length_m = factor, length = true;
    if (type == "PLANEANGLEUNIT" && usable) units.angle_rad = factor, angle = true;
  }
  if (!angle && arcsCountDegrees(file)) {
    units.angle_rad = std::numbers::pi / 180;
    report.warn(assignment ? assignment.place() : "header",
                "angle unit not specified and arcs exceed a full turn in radians; degrees assumed");
  }
  if (given_m > 0) {
    if (length && units.length_m != given_m)
      report.note(assignment.place(), "the length unit of the file was overridden by the specified unit");
    units.length_m = given_m;
  } else if (!length) {
    report.warn(assignment ? assignment.place() : "header",
                "the file has no valid length unit; metres assumed; specify the length unit if it is another");
  }
  return units;
}

}  // namespace standpoint::ifc

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "core/one_of.h"
#include "importers/ifc/model/units.h"

namespace standpoint::ifc {
namespace {

// Enumerations IfcUnitEnum and IfcDerivedUnitEnum.
constexpr std::array<std::string_view, 29> kNamedTypes{"ABSORBEDDOSEUNIT",
                                                       "AMOUNTOFSUBSTANCEUNIT",
                                                       "AREAUNIT",
                                                       "DOSEEQUIVALENTUNIT",
                                                       "ELECTRICCAPACITANCEUNIT",
                                                       "ELECTRICCHARGEUNIT",
                                                       "ELECTRICCONDUCTANCEUNIT",
                                                       "ELECTRICCURRENTUNIT",
                                                       "ELECTRICRESISTANCEUNIT",
                                                       "ELECTRICVOLTAGEUNIT",
                                                       "ENERGYUNIT",
                                                       "FORCEUNIT",
                                                       "FREQUENCYUNIT",
                                                       "ILLUMINANCEUNIT",
                                                       "INDUCTANCEUNIT",
                                                       "LENGTHUNIT",
                                                       "LUMINOUSFLUXUNIT",
                                                       "LUMINOUSINTENSITYUNIT",
                                                       "MAGNETICFLUXDENSITYUNIT",
                                                       "MAGNETICFLUXUNIT",
                                                       "MASSUNIT",
                                                       "PLANEANGLEUNIT",
                                                       "POWERUNIT",
                                                       "PRESSUREUNIT",
                                                       "RADIOACTIVITYUNIT",
                                                       "SOLIDANGLEUNIT",
                                                       "THERMODYNAMICTEMPERATUREUNIT",
                                                       "TIMEUNIT",
                                                       "VOLUMEUNIT"};
constexpr std::array<std::string_view, 51> kDerivedTypes{"ACCELERATIONUNIT",
                                                         "ANGULARVELOCITYUNIT",
                                                         "AREADENSITYUNIT",
                                                         "COMPOUNDPLANEANGLEUNIT",
                                                         "CURVATUREUNIT",
                                                         "DYNAMICVISCOSITYUNIT",
                                                         "HEATFLUXDENSITYUNIT",
                                                         "HEATINGVALUEUNIT",
                                                         "INTEGERCOUNTRATEUNIT",
                                                         "IONCONCENTRATIONUNIT",
                                                         "ISOTHERMALMOISTURECAPACITYUNIT",
                                                         "KINEMATICVISCOSITYUNIT",
                                                         "LINEARFORCEUNIT",
                                                         "LINEARMOMENTUNIT",
                                                         "LINEARSTIFFNESSUNIT",
                                                         "LINEARVELOCITYUNIT",
                                                         "LUMINOUSINTENSITYDISTRIBUTIONUNIT",
                                                         "MASSDENSITYUNIT",
                                                         "MASSFLOWRATEUNIT",
                                                         "MASSPERLENGTHUNIT",
                                                         "MODULUSOFELASTICITYUNIT",
                                                         "MODULUSOFLINEARSUBGRADEREACTIONUNIT",
                                                         "MODULUSOFROTATIONALSUBGRADEREACTIONUNIT",
                                                         "MODULUSOFSUBGRADEREACTIONUNIT",
                                                         "MOISTUREDIFFUSIVITYUNIT",
                                                         "MOLECULARWEIGHTUNIT",
                                                         "MOMENTOFINERTIAUNIT",
                                                         "PHUNIT",
                                                         "PLANARFORCEUNIT",
                                                         "ROTATIONALFREQUENCYUNIT",
                                                         "ROTATIONALMASSUNIT",
                                                         "ROTATIONALSTIFFNESSUNIT",
                                                         "SECTIONAREAINTEGRALUNIT",
                                                         "SECTIONMODULUSUNIT",
                                                         "SHEARMODULUSUNIT",
                                                         "SOUNDPOWERLEVELUNIT",
                                                         "SOUNDPOWERUNIT",
                                                         "SOUNDPRESSURELEVELUNIT",
                                                         "SOUNDPRESSUREUNIT",
                                                         "SPECIFICHEATCAPACITYUNIT",
                                                         "TEMPERATUREGRADIENTUNIT",
                                                         "TEMPERATURERATEOFCHANGEUNIT",
                                                         "THERMALADMITTANCEUNIT",
                                                         "THERMALCONDUCTANCEUNIT",
                                                         "THERMALEXPANSIONCOEFFICIENTUNIT",
                                                         "THERMALRESISTANCEUNIT",
                                                         "THERMALTRANSMITTANCEUNIT",
                                                         "TORQUEUNIT",
                                                         "VAPORPERMEABILITYUNIT",
                                                         "VOLUMETRICFLOWRATEUNIT",
                                                         "WARPINGCONSTANTUNIT"};

// What each SI unit measures.
constexpr std::array<std::pair<std::string_view, std::string_view>, 22> kTypeOfSi{
    {{"METRE", "LENGTHUNIT"},
     {"SQUARE_METRE", "AREAUNIT"},
     {"CUBIC_METRE", "VOLUMEUNIT"},
     {"RADIAN", "PLANEANGLEUNIT"},
     {"STERADIAN", "SOLIDANGLEUNIT"},
     {"GRAM", "MASSUNIT"},
     {"SECOND", "TIMEUNIT"},
     {"KELVIN", "THERMODYNAMICTEMPERATUREUNIT"},
     {"DEGREE_CELSIUS", "THERMODYNAMICTEMPERATUREUNIT"},
     {"WATT", "POWERUNIT"},
     {"JOULE", "ENERGYUNIT"},
     {"NEWTON", "FORCEUNIT"},
     {"PASCAL", "PRESSUREUNIT"},
     {"AMPERE", "ELECTRICCURRENTUNIT"},
     {"VOLT", "ELECTRICVOLTAGEUNIT"},
     {"OHM", "ELECTRICRESISTANCEUNIT"},
     {"HERTZ", "FREQUENCYUNIT"},
     {"LUMEN", "LUMINOUSFLUXUNIT"},
     {"LUX", "ILLUMINANCEUNIT"},
     {"CANDELA", "LUMINOUSINTENSITYUNIT"},
     {"MOLE", "AMOUNTOFSUBSTANCEUNIT"},
     {"FARAD", "ELECTRICCAPACITANCEUNIT"}}};

// Units that are stated by others: name, exponents of length, mass and time, type, measure, how much of which.
struct Converted {
  std::string_view name;
  int length, time;
  std::string_view type, measure;
  double factor;
  std::string_view si;
};
constexpr std::array<Converted, 11> kConverted{
    {{"DEGREE", 0, 0, "PLANEANGLEUNIT", "IFCPLANEANGLEMEASURE", 0.017453292519943295, "RADIAN"},
     {"INCH", 1, 0, "LENGTHUNIT", "IFCLENGTHMEASURE", 0.0254, "METRE"},
     {"FOOT", 1, 0, "LENGTHUNIT", "IFCLENGTHMEASURE", 0.3048, "METRE"},
     {"SQUARE INCH", 2, 0, "AREAUNIT", "IFCAREAMEASURE", 0.00064516, "SQUARE_METRE"},
     {"SQUARE FOOT", 2, 0, "AREAUNIT", "IFCAREAMEASURE", 0.09290304, "SQUARE_METRE"},
     {"CUBIC INCH", 3, 0, "VOLUMEUNIT", "IFCVOLUMEMEASURE", 0.000016387064, "CUBIC_METRE"},
     {"CUBIC FOOT", 3, 0, "VOLUMEUNIT", "IFCVOLUMEMEASURE", 0.028316846592, "CUBIC_METRE"},
     {"LITRE", 3, 0, "VOLUMEUNIT", "IFCVOLUMEMEASURE", 0.001, "CUBIC_METRE"},
     {"MINUTE", 0, 1, "TIMEUNIT", "IFCTIMEMEASURE", 60, "SECOND"},
     {"HOUR", 0, 1, "TIMEUNIT", "IFCTIMEMEASURE", 3600, "SECOND"},
     {"DAY", 0, 1, "TIMEUNIT", "IFCTIMEMEASURE", 86400, "SECOND"}}};

std::string_view typeOfSi(std::string_view name) {
  for (const auto& [si, type] : kTypeOfSi)
    if (si == name) return type;
  return {};
}

// A factor of a derived unit: "m" and 2 of "m²"; nothing where it is no SI unit.
struct Factor {
  SiUnitName unit;
  int exponent = 1;
};

std::optional<Factor> factorOf(std::string_view text) {
  if (const auto whole = siUnitOf(text)) return Factor{*whole, 1};
  constexpr std::array<std::string_view, 8> kPowers{"²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  for (std::size_t i = 0; i < kPowers.size(); ++i)
    if (text.ends_with(kPowers[i]))
      if (const auto unit = siUnitOf(text.substr(0, text.size() - kPowers[i].size())))
        return Factor{*unit, static_cast<int>(i) + 2};
  return {};
}

// "W·m" or "(m²·K)"; false where one is no SI unit.
bool addFactors(std::string_view side, int sign, std::vector<Factor>& out) {
  if (side.starts_with('(') && side.ends_with(')')) side = side.substr(1, side.size() - 2);
  if (side == "1") return true;
  constexpr std::string_view kDot = "·";
  while (!side.empty()) {
    const auto end = side.find(kDot);
    auto factor = factorOf(side.substr(0, end));
    if (!factor) return false;
    factor->exponent *= sign;
    out.push_back(*factor);
    side = end == std::string_view::npos ? std::string_view() : side.substr(end + kDot.size());
  }
  return true;
}

}  // namespace

Quantity quantityOf(std::string_view text) {
  double ignored = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  const auto size = static_cast<std::size_t>(end - text.data());
  if (wrong != std::errc() || (size < text.size() && text[size] != ' ') || text.find_first_of("nN") < size) return {};
  return {std::string(text.substr(0, size)), size < text.size() ? std::string(text.substr(size + 1)) : std::string()};
}

std::optional<double> metresOf(std::string_view text) {
  const auto [number, unit] = quantityOf(text);
  double value = 0;
  if (number.empty() || std::from_chars(number.data(), number.data() + number.size(), value).ec != std::errc())
    return {};
  if (unit.empty()) return value;
  if (const auto si = siUnitOf(unit)) return si->name == "METRE" ? std::optional(value * si->factor) : std::nullopt;
  for (const Converted& c : kConverted)
    if (unit == c.name && c.si == "METRE") return value * c.factor;
  return {};
}

UnitWriter::UnitWriter(const Environment& environment, StepWriter& out) : out_(out) {
  std::map<std::string, std::map<std::string, std::size_t>> symbols;
  const auto look = [&](const std::vector<Property>& properties) {
    for (const Property& p : properties)
      if (const std::string type = unitTypeOf(keywordOf(p.type)); !type.empty() && !p.value.empty())
        ++symbols[type][quantityOf(p.value).unit];
  };
  for (const Product& product : environment.products) look(product.properties);
  for (const SpatialNode& node : environment.spatial) look(node.properties);
  symbols["LENGTHUNIT"] = {{"m", 1}};
  symbols["PLANEANGLEUNIT"] = {{"rad", 1}};
  std::vector<Ref> units;
  for (const auto& [type, counts] : symbols) {
    const bool named = isOneOf(type, kNamedTypes) || isOneOf(type, kDerivedTypes) || type == "MONETARYUNIT";
    if (!named || counts.contains("")) continue;
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    symbol_of_type_[type] = most->first;
    units.push_back(write(type, most->first));
  }
  metre_ = write("LENGTHUNIT", "m");
  assignment_ = out_.add(StepRecord("IFCUNITASSIGNMENT").refs(units));
}

Ref UnitWriter::unitOf(PropertyType type, const std::string& symbol) {
  if (symbol.empty()) return 0;
  const std::string unit_type = unitTypeOf(keywordOf(type));
  const auto project = symbol_of_type_.find(unit_type);
  return project != symbol_of_type_.end() && project->second == symbol ? 0 : write(unit_type, symbol);
}

Ref UnitWriter::writeSi(const std::string& unit_type, std::string_view prefix, std::string_view name) {
  return out_.shared(StepRecord("IFCSIUNIT").raw("*").symbol(unit_type).symbol(prefix).symbol(name));
}

// 0 where it is not made of SI units.
Ref UnitWriter::writeDerived(const std::string& unit_type, std::string_view symbol) {
  const auto slash = symbol.find('/');
  std::vector<Factor> factors;
  if (!addFactors(symbol.substr(0, slash), 1, factors)) return 0;
  if (slash != std::string_view::npos && !addFactors(symbol.substr(slash + 1), -1, factors)) return 0;
  std::vector<Ref> elements;
  for (const Factor& f : factors) {
    const Ref unit = writeSi(std::string(typeOfSi(f.unit.name)), f.unit.prefix, f.unit.name);
    elements.push_back(out_.shared(StepRecord("IFCDERIVEDUNITELEMENT").ref(unit).integer(f.exponent)));
  }
  const bool known = isOneOf(unit_type, kDerivedTypes);
  return out_.shared(StepRecord("IFCDERIVEDUNIT")
                         .refs(elements)
                         .symbol(known ? unit_type : "USERDEFINED")
                         .text(known ? std::string() : unit_type));
}

Ref UnitWriter::write(const std::string& unit_type, const std::string& symbol) {
  if (unit_type == "MONETARYUNIT") return out_.shared(StepRecord("IFCMONETARYUNIT").text(symbol));
  if (isOneOf(unit_type, kDerivedTypes) || unit_type.empty())
    if (const Ref derived = writeDerived(unit_type.empty() ? "" : unit_type, symbol)) return derived;
  if (const auto si = siUnitOf(symbol)) return writeSi(std::string(typeOfSi(si->name)), si->prefix, si->name);
  for (const Converted& c : kConverted) {
    if (c.name != symbol || c.type != unit_type) continue;
    const Ref of = writeSi(std::string(c.type), {}, c.si);
    const Ref amount = out_.shared(
        StepRecord("IFCMEASUREWITHUNIT").raw(std::string(c.measure) + "(" + stepReal(c.factor) + ")").ref(of));
    const Ref dimensions =
        out_.shared(StepRecord("IFCDIMENSIONALEXPONENTS").integer(c.length).integer(0).integer(c.time).raw("0,0,0,0"));
    return out_.shared(StepRecord("IFCCONVERSIONBASEDUNIT").ref(dimensions).symbol(unit_type).text(c.name).ref(amount));
  }
  // Only its name is known.
  const Ref dimensions = out_.shared(StepRecord("IFCDIMENSIONALEXPONENTS").raw("0,0,0,0,0,0,0"));
  return out_.shared(StepRecord("IFCCONTEXTDEPENDENTUNIT")
                         .ref(dimensions)
                         .symbol(isOneOf(unit_type, kNamedTypes) ? unit_type : "USERDEFINED")
                         .text(symbol));
}

}  // namespace standpoint::ifc

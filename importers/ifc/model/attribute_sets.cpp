// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/attribute_sets.h"

#include <algorithm>

namespace standpoint::ifc {
namespace {

constexpr const char* kLength = "IFCLENGTHMEASURE";

constexpr SetAttribute kDoorLining[] = {
    {4, "LiningDepth", kLength},        {5, "LiningThickness", kLength},       {6, "ThresholdDepth", kLength},
    {7, "ThresholdThickness", kLength}, {8, "TransomThickness", kLength},      {9, "TransomOffset", kLength},
    {10, "LiningOffset", kLength},      {11, "ThresholdOffset", kLength},      {12, "CasingThickness", kLength},
    {13, "CasingDepth", kLength},       {15, "LiningToPanelOffsetX", kLength}, {16, "LiningToPanelOffsetY", kLength}};
constexpr SetAttribute kDoorPanel[] = {
    {4, "PanelDepth", kLength}, {5, "PanelOperation"}, {6, "PanelWidth"}, {7, "PanelPosition"}};
constexpr SetAttribute kWindowLining[] = {{4, "LiningDepth", kLength},
                                          {5, "LiningThickness", kLength},
                                          {6, "TransomThickness", kLength},
                                          {7, "MullionThickness", kLength},
                                          {8, "FirstTransomOffset"},
                                          {9, "SecondTransomOffset"},
                                          {10, "FirstMullionOffset"},
                                          {11, "SecondMullionOffset"},
                                          {13, "LiningOffset", kLength},
                                          {14, "LiningToPanelOffsetX", kLength},
                                          {15, "LiningToPanelOffsetY", kLength}};
constexpr SetAttribute kPanel[] = {
    {4, "OperationType"}, {5, "PanelPosition"}, {6, "FrameDepth", kLength}, {7, "FrameThickness", kLength}};
constexpr SetAttribute kReinforcement[] = {{4, "DefinitionType"}};

// IFC2X3: the material is attribute 0.
constexpr SetAttribute kGeneral[] = {
    {1, "MolecularWeight", "IFCMOLECULARWEIGHTMEASURE"}, {2, "Porosity"}, {3, "MassDensity", "IFCMASSDENSITYMEASURE"}};
constexpr SetAttribute kThermal[] = {{1, "SpecificHeatCapacity", "IFCSPECIFICHEATCAPACITYMEASURE"},
                                     {2, "BoilingPoint", "IFCTHERMODYNAMICTEMPERATUREMEASURE"},
                                     {3, "FreezingPoint", "IFCTHERMODYNAMICTEMPERATUREMEASURE"},
                                     {4, "ThermalConductivity", "IFCTHERMALCONDUCTIVITYMEASURE"}};
constexpr SetAttribute kMechanical[] = {{1, "DynamicViscosity", "IFCDYNAMICVISCOSITYMEASURE"},
                                        {2, "YoungModulus", "IFCMODULUSOFELASTICITYMEASURE"},
                                        {3, "ShearModulus", "IFCMODULUSOFELASTICITYMEASURE"},
                                        {4, "PoissonRatio"},
                                        {5, "ThermalExpansionCoefficient", "IFCTHERMALEXPANSIONCOEFFICIENTMEASURE"}};
constexpr SetAttribute kOptical[] = {
    {1, "VisibleTransmittance"},    {2, "SolarTransmittance"},       {3, "ThermalIrTransmittance"},
    {4, "ThermalIrEmissivityBack"}, {5, "ThermalIrEmissivityFront"}, {6, "VisibleReflectanceBack"},
    {7, "VisibleReflectanceFront"}, {8, "SolarReflectanceFront"},    {9, "SolarReflectanceBack"}};

constexpr AttributeSet kSets[] = {
    {"IFCDOORLININGPROPERTIES", kDoorLining},
    {"IFCDOORPANELPROPERTIES", kDoorPanel},
    {"IFCWINDOWLININGPROPERTIES", kWindowLining},
    {"IFCWINDOWPANELPROPERTIES", kPanel},
    {"IFCPERMEABLECOVERINGPROPERTIES", kPanel},
    {"IFCREINFORCEMENTDEFINITIONPROPERTIES", kReinforcement},
    {"IFCGENERALMATERIALPROPERTIES", kGeneral},
    {"IFCTHERMALMATERIALPROPERTIES", kThermal},
    {"IFCMECHANICALMATERIALPROPERTIES", kMechanical},
    {"IFCMECHANICALSTEELMATERIALPROPERTIES", kMechanical},
    {"IFCMECHANICALCONCRETEMATERIALPROPERTIES", kMechanical},
    {"IFCOPTICALMATERIALPROPERTIES", kOptical},
};

}  // namespace

const AttributeSet* attributeSet(std::string_view upper) {
  const auto it =
      std::find_if(std::begin(kSets), std::end(kSets), [&](const AttributeSet& s) { return upper == s.entity; });
  return it == std::end(kSets) ? nullptr : &*it;
}

}  // namespace standpoint::ifc

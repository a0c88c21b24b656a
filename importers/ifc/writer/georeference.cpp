// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/georeference.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "importers/ifc/writer/shapes.h"

namespace standpoint::ifc {

bool needsScaledConversion(const Georeference& georeference) {
  return georeference.map_from_file && georeference.map_from_file->factors != Eigen::Vector3d::Ones();
}

Ref writeContext(const Georeference& georeference, StepWriter& out) {
  constexpr double kPrecision_m = 1e-5;
  Ref north = 0;
  if (georeference.true_north_rad) {
    const double angle = *georeference.true_north_rad;
    north = out.add(StepRecord("IFCDIRECTION").reals(std::array{std::sin(angle), std::cos(angle)}));
  }
  return out.add(StepRecord("IFCGEOMETRICREPRESENTATIONCONTEXT")
                     .none()
                     .text("Model")
                     .integer(3)
                     .real(kPrecision_m)
                     .ref(axisPlacement(Eigen::Isometry3d::Identity(), out))
                     .ref(north));
}

void writeMapConversion(const Georeference& georeference, Ref context, StepWriter& out) {
  if (!georeference.map_from_file && georeference.crs.empty()) return;
  const Ref crs = out.add(StepRecord("IFCPROJECTEDCRS").raw(stepText(georeference.crs)).none(6));
  if (!georeference.map_from_file) return;
  const MapConversion& c = *georeference.map_from_file;
  const bool scaled = needsScaledConversion(georeference);
  StepRecord record(scaled ? "IFCMAPCONVERSIONSCALED" : "IFCMAPCONVERSION");
  record.ref(context).ref(crs).real(c.eastings_m).real(c.northings_m).real(c.orthogonal_height_m);
  record.real(c.x_axis_abscissa).real(c.x_axis_ordinate).real(c.scale);
  if (scaled)
    for (const double factor : c.factors) record.real(factor);
  out.add(record);
}

std::string compoundAngleText(double degrees) {
  constexpr std::int64_t kPartsOfDegree = 3'600'000'000;  // millionths of a second
  const auto sign = std::signbit(degrees) ? -1 : 1;
  const auto all = static_cast<std::int64_t>(std::llround(std::abs(degrees) * static_cast<double>(kPartsOfDegree)));
  return fmt::format("({},{},{},{})", sign * (all / kPartsOfDegree), sign * (all / 60'000'000 % 60),
                     sign * (all / 1'000'000 % 60), sign * (all % 1'000'000));
}

}  // namespace standpoint::ifc

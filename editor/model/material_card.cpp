// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/material_card.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace standpoint {

std::vector<CardRow> reportedOf(const PhysicalMaterial& material, const std::vector<Instrument>& instruments,
                                double incidence_rad) {
  std::vector<CardRow> rows;
  for (const auto* id : kCardInstruments) {
    const auto found =
        std::find_if(instruments.begin(), instruments.end(), [&](const Instrument& i) { return i.id == id; });
    const auto settings = found == instruments.end()
                              ? Result<ScanSettings>(failure(ErrorKind::usage, "unknown instrument"))
                              : resolveSettings(*found, {});
    if (!settings) continue;
    const ReturnLaw law(*found, *settings);
    const auto optics = opticsOf(material, found->wavelength_nm);
    CardRow row{found->model, found->wavelength_nm, {}};
    for (std::size_t i = 0; i < kCardRanges_m.size(); ++i)
      row.at[i] = law.of(optics, kCardRanges_m[i], std::cos(incidence_rad));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::array<float, 81> angularResponse(const PhysicalMaterial& material, double wavelength_nm) {
  const auto optics = opticsOf(material, wavelength_nm);
  std::array<float, 81> response{};
  for (std::size_t degrees = 0; degrees < response.size(); ++degrees)
    response[degrees] =
        100 * lambertEquivalent(optics, static_cast<float>(std::cos(static_cast<double>(degrees) * kRadPerDeg)));
  return response;
}

}  // namespace standpoint

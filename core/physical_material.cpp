// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/physical_material.h"

#include <algorithm>

#include "core/assigned.h"

namespace standpoint {

namespace {

double normalReflectance(double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); }

}  // namespace

double atWavelength(const Spectrum& table, double wavelength_nm) {
  if (table.empty()) return 0;
  if (wavelength_nm <= table.front().first) return table.front().second;
  if (wavelength_nm >= table.back().first) return table.back().second;
  const auto next = std::upper_bound(table.begin(), table.end(), wavelength_nm,
                                     [](double w, const auto& entry) { return w < entry.first; });
  const auto& [w0, r0] = *(next - 1);
  const auto& [w1, r1] = *next;
  return r0 + (r1 - r0) * (wavelength_nm - w0) / (w1 - w0);
}

// Between the tabulated wavelengths the reflectance is taken as linear, not n and k: it is what is sent back.
double specularAtNormal(const PhysicalMaterial& material, double wavelength_nm) {
  if (material.complex_index.empty())
    return material.index_of_refraction > 0 ? normalReflectance(material.index_of_refraction, 0) : 0;
  Spectrum table;
  for (const auto& [wavelength, n, k] : material.complex_index) table.emplace_back(wavelength, normalReflectance(n, k));
  return atWavelength(table, wavelength_nm);
}

ComplexIndex indexAt(const PhysicalMaterial& material, double wavelength_nm) {
  if (material.complex_index.empty()) return {wavelength_nm, material.index_of_refraction, 0};
  Spectrum n, k;
  for (const auto& row : material.complex_index) {
    n.emplace_back(row.wavelength_nm, row.n);
    k.emplace_back(row.wavelength_nm, row.k);
  }
  return {wavelength_nm, atWavelength(n, wavelength_nm), atWavelength(k, wavelength_nm)};
}

double buildUpThickness(const PhysicalMaterial& material) {
  return material.panes * material.thickness_m + (material.panes - 1) * material.gap_m;
}

std::int32_t materialOf(const MaterialAssignment& assignment, std::uint32_t product, std::uint32_t surface) {
  const auto* assigned = assignedSurface(assignment, product, surface);
  return assigned == nullptr ? -1 : assigned->material;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
// As HELIOS++ 2.2 reads it (its MaterialsFileReader and SpectralLibrary): names end at a space; a spectrum is a text
// file with 26 lines of header, then micrometres and per cent with a tab between; below the first line it interpolates
// from 0, and `helios_reflectance` is not in per cent, so spectra are the one consistent way.
#include "importers/helios/helios_writer.h"

#include <cctype>

#include <fmt/format.h>

#include "core/part_file.h"
#include "core/visible_colour.h"
#include "importers/obj/obj_writer.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr int kHeaderLines = 26;
constexpr double kFirst_nm = 300, kLast_nm = 2600;  // the figures at both ends are held constant up to here

std::string spectrumText(const PhysicalMaterial& m) {
  std::string text = "Name: " + m.label + "\nType: " + m.id +
                     "\nX Units: Wavelength (micrometers)\nY Units: Diffuse reflectance (percent)\n";
  for (int line = 4; line < kHeaderLines; ++line) text += '\n';
  auto table = m.reflectance;
  if (table.front().first > kFirst_nm) table.insert(table.begin(), {kFirst_nm, table.front().second});
  if (table.back().first < kLast_nm) table.emplace_back(kLast_nm, table.back().second);
  for (const auto& [wavelength_nm, fraction] : table)
    text += fmt::format("{:g}\t{:g}\n", wavelength_nm / 1000, fraction * 100);
  return text;
}

std::string materialText(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical) {
  std::string text;
  for (std::size_t i = 0; i < physical.size(); ++i) {
    const Colour c = physical[i] != nullptr ? visibleColour(*physical[i]) : environment.surfaces[i].colour;
    text += fmt::format("newmtl {}\nKa 0 0 0\nKd {:.4f} {:.4f} {:.4f}\nKs 0 0 0\nhelios_classification {}\n",
                        environment.surfaces[i].name, c.r, c.g, c.b, i);
    if (physical[i] != nullptr && !physical[i]->reflectance.empty()) text += "helios_spectra " + physical[i]->id + "\n";
    text += '\n';
  }
  return text;
}

std::string sceneText(const std::string& name, const std::string& obj) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document>\n  <scene id=\"{}\" name=\"{}\">\n    <part id=\"0\">\n  "
      "    <filter type=\"objloader\">\n"
      "        <param type=\"string\" key=\"filepath\" value=\"{}\"/>\n        <param type=\"string\" key=\"up\" "
      "value=\"z\"/>\n      </filter>\n    </part>\n  </scene>\n</document>\n",
      name, name, obj);
}

void tellLosses(const std::vector<const PhysicalMaterial*>& physical, Report& report) {
  std::size_t without = 0, panes = 0, glossy = 0;
  for (const auto* m : physical) {
    without += m == nullptr ? 1 : 0;
    panes += m != nullptr && !m->transmittance.empty() ? 1 : 0;
    glossy += m != nullptr && m->transmittance.empty() && m->gloss_slope > 0 ? 1 : 0;
  }
  if (without > 0)
    report.warn("materials", fmt::format("no material assigned: HELIOS++ uses 50 % ({} surfaces)", without));
  if (panes > 0)
    report.warn("materials",
                fmt::format("panes are opaque in HELIOS++: beams end at the first surface ({} materials)", panes));
  if (glossy > 0)
    report.note(
        "materials",
        fmt::format(
            "gloss was not exported: the Phong lobe of HELIOS++ returns light at grazing incidence ({} materials)",
            glossy));
}

}  // namespace

Result<void> writeHeliosScene(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
                              const Georeference& georeference, const fs::path& file, Report& report,
                              Progress& progress) {
  Environment named = environment;
  for (std::size_t i = 0; i < physical.size(); ++i)
    named.surfaces[i].name = physical[i] != nullptr ? physical[i]->id : fmt::format("unassigned_{}", i);
  auto name = file.stem().string();
  for (auto& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';  // stands in XML and in paths
  const auto obj = file.parent_path() / (name + ".obj");
  TRY(writeEnvironmentObj(named, georeference, obj, progress, materialText(named, physical)));
  const auto spectra = file.parent_path() / "spectra";
  std::error_code error;
  fs::create_directories(spectra, error);
  if (error) return failure(ErrorKind::file_system, error.message(), spectra.string());
  for (const auto* m : physical)
    if (m != nullptr && !m->reflectance.empty()) TRY(writeWholeText(spectra / (m->id + ".txt"), spectrumText(*m)));
  tellLosses(physical, report);
  return writeWholeText(file, sceneText(name, obj.filename().string()));
}

}  // namespace standpoint

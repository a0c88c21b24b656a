// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/materials_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/part_file.h"
#include "core/report_html.h"
#include "project/materials/material_findings.h"

namespace standpoint {

namespace {

constexpr double kColumns_nm[] = {532, 660, 905, 1064, 1550};

const PhysicalMaterial* materialOfUse(const MaterialResult& result, const MaterialUse& use) {
  for (const auto& m : result.assignment.materials)
    if (m.id == use.material) return &m;
  return nullptr;
}

// The diffuse reflectance from 500 to 1600 nm, 0 to 1.
std::string spectrumSvg(const PhysicalMaterial& m) {
  std::string points;
  for (double nm = 500; nm <= 1600; nm += 20)
    points += fmt::format("{:.1f},{:.1f} ", (nm - 500) / 11, 30 - 30 * atWavelength(m.reflectance, nm));
  return fmt::format(
      "<svg width=\"100\" height=\"32\" viewBox=\"0 0 100 31\"><polyline points=\"{}\" fill=\"none\" stroke=\"#246\" "
      "stroke-width=\"1.5\"/>"
      "<path d=\"M0 0V30.5H100\" fill=\"none\" stroke=\"#999\" stroke-width=\"0.5\"/></svg>",
      points);
}

std::string coverageTable(const char* title, const char* head, const std::vector<CoverageRow>& rows) {
  std::string text =
      reportHeading(title) + reportTable({head, "Area, m²", "Assigned", "Assigned by low-confidence rule"});
  for (const auto& r : rows)
    text += fmt::format("<tr><td>{}<td>{:.1f}<td>{:.1f} %<td>{:.1f} %</tr>\n", r.name.empty() ? "–" : htmlText(r.name),
                        r.area_m2, r.area_m2 > 0 ? 100 * r.assigned_m2 / r.area_m2 : 0,
                        r.assigned_m2 > 0 ? 100 * r.weak_m2 / r.assigned_m2 : 0);
  return text + "</table>\n";
}

std::string materialRow(const MaterialUse& use, const PhysicalMaterial* m) {
  if (m == nullptr)
    return fmt::format("<tr><td>{}<td>{:.1f}<td colspan=9></tr>\n", htmlText(printed("no material")), use.area_m2);
  std::string text = fmt::format("<tr><td>{}<br><code>{}</code><td>{:.1f}<td>{}", htmlText(printed(m->label)), m->id,
                                 use.area_m2, spectrumSvg(*m));
  for (const double nm : kColumns_nm) text += fmt::format("<td>{:.2f}", atWavelength(m->reflectance, nm));
  text += fmt::format("<td>{:.2f}<td>{}<td>", specularAtNormal(*m, 905),
                      transmits(*m) ? fmt::format("{} × {:.2f}", m->panes, atWavelength(m->transmittance, 905)) : "–");
  for (const auto& c : m->sources)
    text += fmt::format("<b>{}</b>: {}{}<br>", htmlText(c.figure), htmlText(c.text),
                        c.licence.empty() ? "" : " [" + htmlText(c.licence) + "]");
  for (const auto& gap : gapsOf(*m)) text += "<i>" + htmlText(printedf("gap: {}", printed(gap))) + "</i><br>";
  return text + "</tr>\n";
}

std::string htmlReport(const Document& document) {
  const auto& result = document.materials->result;
  const auto& report = result.report;
  const auto title =
      htmlText(document.name.empty() ? printed("Materials of a model") : printedf("Materials of {}", document.name));
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{0}\"><head><meta charset=\"utf-8\"><title>{1}</title>\n"
      "<style>body{{font:11pt "
      "sans-serif;margin:2em}}table{{border-collapse:collapse;margin-bottom:1.5em}}td,th{{border:1px solid "
      "#bbb;padding:3px 6px;"
      "text-align:left;vertical-align:top}}th{{background:#eee}}td:last-child{{font-size:9pt}}@media "
      "print{{body{{margin:0}}tr{{page-break-inside:avoid}}}}</style></head><body>\n<h1>{1}</h1>\n<p>{2}</p>\n",
      reportLanguage(), title,
      htmlText(printedf("{} % of {} m² have a physical material.", fmt::format("{:.1f}", 100 * report.coverage),
                        fmt::format("{:.1f}", report.area_m2))));
  text += coverageTable("Coverage by class", "Class", report.by_class) +
          coverageTable("Coverage by storey", "Storey", report.by_storey);
  text += reportHeading("Materials in use") + reportTable({"Material", "Area, m²", "Spectrum", "532 nm", "660", "905",
                                                           "1064", "1550", "F0 905", "T 905", "Sources and gaps"});
  for (const auto& use : report.uses) text += materialRow(use, materialOfUse(result, use));
  text +=
      "</table>\n<p>" +
      htmlText(printed("Diffuse reflectance at normal incidence; F0: specular reflectance; T: panes × transmittance "
                       "of one.")) +
      "</p>\n";
  text += reportHeading("Findings") + reportTable({"Kind", "Finding", "Why", "State"});
  for (const auto& f : materialFindings(document)) {
    const auto state =
        f.because.empty() ? printedf("open ({})", printed(f.severity)) : printedf("accepted: {}", f.because);
    text += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}</tr>\n", htmlText(printed(f.kind)), htmlText(printed(f.message)),
                        htmlText(printed(f.why)), htmlText(state));
  }
  return text + "</table>\n</body></html>\n";
}

std::string csvCell(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csvReport(const Document& document) {
  const auto& result = document.materials->result;
  std::string text =
      "material,label,area_m2,products,reflectance_532,reflectance_660,reflectance_905,reflectance_1064,reflectance_"
      "1550,specular_905,panes,transmittance_905,sources,gaps\n";
  for (const auto& use : result.report.uses) {
    const auto* m = materialOfUse(result, use);
    if (m == nullptr) {
      text += fmt::format(",,{:.3f},{},,,,,,,,,,\n", use.area_m2, use.products.size());
      continue;
    }
    text += fmt::format("{},{},{:.3f},{}", m->id, csvCell(m->label), use.area_m2, use.products.size());
    for (const double nm : kColumns_nm) text += fmt::format(",{:.4f}", atWavelength(m->reflectance, nm));
    text += fmt::format(",{:.4f}", specularAtNormal(*m, 905));
    text += transmits(*m) ? fmt::format(",{},{:.4f}", m->panes, atWavelength(m->transmittance, 905)) : ",,";
    std::vector<std::string> sources;
    for (const auto& c : m->sources) sources.push_back(c.figure + ": " + c.text);
    text += fmt::format(",{},{}\n", csvCell(fmt::format("{}", fmt::join(sources, "; "))),
                        csvCell(fmt::format("{}", fmt::join(gapsOf(*m), "; "))));
  }
  return text;
}

}  // namespace

Result<void> writeMaterialReport(const Document& document, const std::filesystem::path& file) {
  const auto ending = file.extension().string();
  if (ending != ".html" && ending != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .html or .csv", file.string());
  return writeWholeText(file, ending == ".html" ? htmlReport(document) : csvReport(document));
}

}  // namespace standpoint

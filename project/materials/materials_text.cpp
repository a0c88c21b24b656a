// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/materials/materials_text.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace standpoint {

namespace {

constexpr std::size_t kMostClasses = 5;
constexpr std::size_t kMostProducts = 20;

// 100.0 % is all of it: a rest that rounds away shows as 99.9.
std::string percent(double fraction) {
  const double rounded = fraction < 1 ? std::min(fraction * 100, 99.9) : 100.0;
  return fraction > 0 && rounded < 0.05 ? "< 0.1 %" : fmt::format("{:.1f} %", rounded);
}

// As a shell takes it: selectors hold #, & and *.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

void appendUses(std::string& text, const MaterialReport& report) {
  std::size_t width = 8;
  for (const auto& use : report.uses) width = std::max(width, use.material.size());
  text += fmt::format("\n  {:<{}}  {:>11}  {:>7}  {:>8}\n", "material", width, "area", "share", "products");
  for (const auto& use : report.uses)
    text +=
        fmt::format("  {:<{}}  {:>8.1f} m²  {:>7}  {:>8}\n", use.material.empty() ? "(none)" : use.material, width,
                    use.area_m2, percent(report.area_m2 > 0 ? use.area_m2 / report.area_m2 : 0), use.products.size());
}

// The classes that lack most.
void appendClasses(std::string& text, const MaterialReport& report) {
  auto rows = report.by_class;
  std::erase_if(rows, [](const CoverageRow& r) { return !(r.area_m2 - r.assigned_m2 > 1e-9 * r.area_m2); });
  std::stable_sort(rows.begin(), rows.end(), [](const CoverageRow& a, const CoverageRow& b) {
    return a.area_m2 - a.assigned_m2 > b.area_m2 - b.assigned_m2;
  });
  if (rows.empty()) return;
  text += "\n  unassigned area by class\n";
  for (std::size_t i = 0; i < std::min(rows.size(), kMostClasses); ++i)
    text += fmt::format("  {:.1f} m² of {:.1f} m² of {}\n", rows[i].area_m2 - rows[i].assigned_m2, rows[i].area_m2,
                        rows[i].name.empty() ? "no class" : rows[i].name);
  if (rows.size() > kMostClasses) text += fmt::format("  … and of {} more classes\n", rows.size() - kMostClasses);
}

struct Kind {
  const MaterialFinding* first = nullptr;
  std::size_t open = 0;
};

// In the order of the list: the heaviest first.
std::vector<Kind> openKinds(const MaterialReport& report) {
  std::vector<Kind> kinds;
  for (const auto& f : report.findings) {
    if (!f.because.empty()) continue;
    auto known = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.first->kind == f.kind; });
    if (known == kinds.end()) known = kinds.insert(kinds.end(), {&f, 0});
    ++known->open;
  }
  return kinds;
}

std::string assignOption(const Remedy& remedy) {
  return "--assign " + quoted(remedy.selector + "=" + (remedy.material.empty() ? "MATERIAL" : remedy.material));
}

void appendFindings(std::string& text, const MaterialReport& report, const std::vector<Kind>& kinds) {
  std::size_t open = 0;
  for (const auto& kind : kinds) open += kind.open;
  text += fmt::format("\n  findings: {} open, {} accepted\n", open, report.findings.size() - open);
  for (const auto& kind : kinds) {
    const auto& f = *kind.first;
    text +=
        fmt::format("  {:>5} {:<15} {}{}{}\n", kind.open, f.kind, f.source, f.source.empty() ? "" : ": ", f.message);
    text += fmt::format("  {:21} {}\n", "", f.id);
    for (const auto& remedy : f.remedies)
      text += fmt::format("  {:21} {}: {}\n", "", remedy.text, assignOption(remedy));
  }
}

void appendSteps(std::string& text, const std::vector<Kind>& kinds) {
  text += "\n  to go on\n";
  if (!kinds.empty()) {
    const auto& first = *kinds.front().first;
    const Remedy any = first.remedies.empty() ? Remedy{"", "SELECTOR", ""} : first.remedies.front();
    text += fmt::format("  standpoint materials PROJECT {}\n", assignOption(any));
    text += fmt::format("  standpoint materials PROJECT --accept {} --because 'REASON'\n", first.id);
  }
  text +=
      "  standpoint materials PROJECT --report materials.html    printable report of all findings and surfaces; use "
      "--json for scripts\n";
}

}  // namespace

std::string materialsText(const Environment& environment, const MaterialReport& report) {
  double weak_m2 = 0;
  for (const auto& row : report.by_class) weak_m2 += row.weak_m2;
  std::string text = fmt::format("  {:.1f} m² on {} products", report.area_m2,
                                 std::count_if(environment.products.begin(), environment.products.end(),
                                               [](const Product& p) { return p.inScene(); }));
  if (report.area_m2 <= 0) return text + ": no surfaces\n";
  text += fmt::format(": {} assigned, {} by low-confidence rules\n", percent(report.coverage),
                      percent(weak_m2 / report.area_m2));
  const auto kinds = openKinds(report);
  appendUses(text, report);
  appendClasses(text, report);
  appendFindings(text, report, kinds);
  appendSteps(text, kinds);
  return text;
}

std::string libraryText(const std::vector<LibraryRow>& libraries) {
  std::string text;
  for (const auto& library : libraries) {
    text += fmt::format("\n  {}: {} added, {} changed\n", library.file, library.added.size(), library.changed.size());
    for (const auto& used : library.used)
      text += fmt::format("  {} is on {:.1f} m² of {} products\n", used.material, used.area_m2, used.products.size());
  }
  return text;
}

std::string whereText(const MaterialPlaces& where) {
  const auto& products = where.products;
  std::string text =
      fmt::format("  {} is on {:.1f} m² of {} products\n", where.material, where.area_m2, products.size());
  for (std::size_t i = 0; i < std::min(products.size(), kMostProducts); ++i)
    text += fmt::format("  {} {} '{}'\n", products[i].id, products[i].ifc_class, products[i].name);
  if (products.size() > kMostProducts)
    text += fmt::format("  … and {} more; use --json for the full list\n", products.size() - kMostProducts);
  return text;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/linking.h"
#include "emulated-ui/device/picking.h"
#include "emulated-ui/device/picture.h"

namespace standpoint {

namespace {

std::string entry(const Device& device, const char* id) {
  const auto found = device.state().entries.find(id);
  return found == device.state().entries.end() ? std::string() : found->second;
}

std::optional<int> wholeNumber(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

DeviceProject* named(Device& device, const std::string& name) {
  for (auto& p : device.change().projects)
    if (p.name == name) return &p;
  return nullptr;
}

// The fields of a new project begin with what the device proposes.
Result<void> proposeProject(Device& device, const std::string&) {
  auto& s = device.change();
  for (std::size_t n = s.projects.size() + 1;; ++n) {
    const auto name = device.word("project") + fmt::format(" {:03d}", n);
    if (named(device, name) == nullptr) {
      s.entries["name"] = name;
      break;
    }
  }
  s.entries["first"] = "1";
  s.entries["base"] = "Scan_";
  s.entries["note"] = "";
  return {};
}

std::string forWhom(const Device& device) {
  const auto customer = device.value("customer"), facility = device.value("facility");
  return customer.empty() || facility.empty() ? customer + facility : customer + ", " + facility;
}

Result<void> createProject(Device& device, const std::string&) {
  const auto name = entry(device, "name");
  if (auto ok = checkName(device, name); !ok) return ok;
  if (named(device, name) != nullptr) return failure(ErrorKind::usage, device.word("name_taken"));
  const auto first_text = entry(device, "first");
  const auto first = first_text.empty() ? std::optional<int>(1) : wholeNumber(first_text);
  if (!first || *first < 1 || *first > 999999) return failure(ErrorKind::usage, device.word("first_wrong"));
  auto& s = device.change();
  DeviceProject project;
  project.name = name;
  project.first = *first;
  project.base = entry(device, "base");
  project.note = entry(device, "note");
  if (project.note.empty()) project.note = forWhom(device);
  s.projects.push_back(std::move(project));
  s.project = static_cast<int>(s.projects.size()) - 1;
  s.shown = -1;
  device.note("project_created", name);
  return {};
}

Result<void> openProject(Device& device, const std::string& row) {
  auto& s = device.change();
  const auto at = wholeNumber(row);
  if (!at || *at < 0 || *at >= static_cast<int>(s.projects.size())) return failure(ErrorKind::usage, "no such row");
  s.project = *at;
  s.shown = -1;
  device.note("project_opened", s.projects[s.project].name);
  return {};
}

Result<void> renameProject(Device& device, const std::string&) {
  auto* project = device.project();
  if (project == nullptr) return failure(ErrorKind::usage, device.word("no_project"));
  const auto name = entry(device, "name");
  if (auto ok = checkName(device, name); !ok) return ok;
  if (named(device, name) != nullptr) return failure(ErrorKind::usage, device.word("name_taken"));
  if (!project->setups.empty()) return failure(ErrorKind::usage, device.word("rename_full"));
  project->name = name;
  device.note("project_renamed", name);
  return {};
}

Result<void> setCluster(Device& device, const std::string&) {
  auto* project = device.project();
  if (project == nullptr) return failure(ErrorKind::usage, device.word("no_project"));
  const auto name = entry(device, "cluster");
  if (!name.empty())
    if (auto ok = checkName(device, name); !ok) return ok;
  project->cluster = name;
  device.note("cluster", name);
  return {};
}

void forgetMeasured(Device& device) {
  for (const char* of : {"measured", "measured_horizontal", "measured_vertical"}) device.change().entries.erase(of);
}

Result<void> showSetup(Device& device, const std::string& row) {
  const auto* project = device.project();
  const auto at = wholeNumber(row);
  if (project == nullptr || !at || *at < 0 || *at >= static_cast<int>(project->setups.size()))
    return failure(ErrorKind::usage, "no such row");
  device.change().shown = *at;
  forgetMeasured(device);
  device.change().entries.erase("measured_from");
  device.change().entries.erase("tapped");
  return {};
}

Result<void> lookAtSetup(Device& device, const std::string&) {
  auto* setup = device.shownSetup();
  if (setup == nullptr) return failure(ErrorKind::usage, device.word("no_setup"));
  if (!setup->preview) {
    device.give(PreviewOrder{setup->file});  // it is looked at when there is a picture: previewDone
    return {};
  }
  setup->looked_at = true;
  device.note("looked_at", setup->name);
  return {};
}

Result<void> viewSetup(Device& device, const std::string&) {
  auto* setup = device.shownSetup();
  if (setup == nullptr) return failure(ErrorKind::usage, device.word("no_setup"));
  setup->looked_at = true;
  device.note("looked_at", setup->name);
  device.view(*setup);
  return {};
}

// "u,v", shares of the preview's width and height from the upper left: the second pick gives the distance to the first.
Result<void> measure(Device& device, const std::string& at) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->preview) return failure(ErrorKind::usage, device.word("no_preview"));
  if (!placeIn(at)) return failure(ErrorKind::usage, "u,v required: fractions of the image from its upper left corner");
  const auto spot = spotIn(*setup->preview, at);
  if (!spot) return failure(ErrorKind::usage, device.word("no_point"));
  auto& entries = device.change().entries;
  const auto place = fmt::format("{} {} {}", spot->x(), spot->y(), spot->z());
  const auto from = entries.find("measured_from");
  if (from == entries.end()) {
    entries["measured_from"] = place;
    entries["tapped"] = at;
    forgetMeasured(device);
    return {};
  }
  double x = 0, y = 0, z = 0;
  if (std::sscanf(from->second.c_str(), "%lf %lf %lf", &x, &y, &z) == 3) {
    const double plan = std::hypot(spot->x() - x, spot->y() - y), up = spot->z() - z;
    entries["measured"] = fmt::format("{:.4f}", std::hypot(plan, up));
    entries["measured_horizontal"] = fmt::format("{:.4f}", plan);
    entries["measured_vertical"] = fmt::format("{:.4f}", up);
  }
  entries.erase("measured_from");
  entries["tapped"] += ";" + at;
  device.note("measured", entries["measured"]);
  return {};
}

Result<void> measureTargets(Device& device, const std::string&) {
  const auto* setup = device.shownSetup() != nullptr ? device.shownSetup() : device.newestSetup();
  if (setup == nullptr) return failure(ErrorKind::usage, device.word("no_setup"));
  if (!device.state().around.targets_visible) {
    device.note("targets", "0");
    return failure(ErrorKind::usage, device.word("target_not_found"));
  }
  device.give(TargetOrder{setup->file});
  return {};
}

Result<void> linkNewest(Device& device, const std::string&) {
  const auto* project = device.project();
  if (project == nullptr || project->setups.size() < 2) return failure(ErrorKind::usage, device.word("link_needs_two"));
  orderLink(device);
  return {};
}

// Of the formats that a device offers, those that are not the scans' own and can be written.
std::string extensionOf(const std::string& format) { return format == "LAS" ? ".las" : format == "PTX" ? ".ptx" : ""; }

Result<void> transferBy(Device& device, const char* by) {
  TransferOrder order{{}, by, extensionOf(device.value("export_format"))};
  for (const auto& p : device.state().projects)
    for (const auto& setup : p.setups)
      if (!setup.transferred) order.files.push_back(setup.file);
  if (order.files.empty()) return failure(ErrorKind::usage, device.word("nothing_to_transfer"));
  device.give(std::move(order));
  return {};
}
Result<void> transferByCable(Device& device, const std::string&) { return transferBy(device, "cable"); }
Result<void> transferByWlan(Device& device, const std::string&) {
  if (!device.state().around.wlan) return failure(ErrorKind::usage, device.word("wlan_lost"));
  return transferBy(device, "wlan");
}

std::string projectText(const Device& device, const DeviceProject& project) {
  const auto text = fmt::format("{}  ({})", project.name, project.setups.size());
  return project.photo.empty() ? text : text + "  " + device.word("with_photo");
}

// Settings as the data sheet has them.
Result<void> standardSettings(Device& device, const std::string&) { return device.setSettings({}); }

Result<void> standardArea(Device& device, const std::string&) {
  SettingValues wanted;
  for (const auto& [key, value] : device.state().settings)
    if (!key.starts_with("horizontal_") && !key.starts_with("vertical_")) wanted.emplace_back(key, value);
  return device.setSettings(wanted);
}

}  // namespace

void openSomeProject(Device& device) {
  if (device.project() != nullptr) return;
  const auto& projects = device.state().projects;
  if (!projects.empty())
    (void)openProject(device, std::to_string(projects.size() - 1));
  else if (proposeProject(device, ""))
    (void)createProject(device, "");
}

const std::vector<DeviceAction>& sharedActions() {
  static const std::vector<DeviceAction> actions = {
      {"propose_project", proposeProject},
      {"create_project", createProject},
      {"open_project", openProject},
      {"rename_project", renameProject},
      {"set_cluster", setCluster},
      {"show_setup", showSetup},
      {"look_at_setup", lookAtSetup},
      {"view_setup", viewSetup},
      {"measure", measure},
      {"measure_targets", measureTargets},
      {"begin_picking", beginPicking},
      {"aim", aim},
      {"pick_aimed", pickAimed},
      {"link_newest", linkNewest},
      {"link_setups", linkSetups},
      {"lay_cloud", layCloud},
      {"lay_back", layBack},
      {"transfer_by_cable", transferByCable},
      {"transfer_by_wlan", transferByWlan},
      {"standard_settings", standardSettings},
      {"standard_area", standardArea},
  };
  return actions;
}

const std::vector<ListRow>& sharedLists() {
  static const std::vector<ListRow> lists = {
      {"projects",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (std::size_t i = 0; i < d.state().projects.size(); ++i)
           rows.push_back({std::to_string(i), projectText(d, d.state().projects[i]), true, {}});
         return rows;
       }},
      {"setups",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         if (const auto* p = d.project())
           for (std::size_t i = 0; i < p->setups.size(); ++i) {
             const auto& s = p->setups[i];
             std::string marks = s.moved ? "  !" : s.unlevelled ? "  ~" : "";
             if (s.link) marks += s.link->joined ? "  ↔" : "  ×";
             rows.push_back(
                 {std::to_string(i),
                  fmt::format("{}  {}  {:.1f} M{}", s.name, s.station, static_cast<double>(s.points) / 1e6, marks),
                  true,
                  {},
                  static_cast<int>(i)});
           }
         return rows;
       }},
      {"record",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         if (const auto* setup = d.shownSetup())
           for (const auto& [key, text] : setup->notes)
             rows.push_back({key, d.word("note." + key) + "  " + text, true, {}});
         return rows;
       }},
      {"targets",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         const auto* setup = d.shownSetup() != nullptr ? d.shownSetup() : d.newestSetup();
         if (setup != nullptr)
           for (const auto& t : setup->targets)
             rows.push_back({t.name,
                             t.found ? fmt::format("{}  {}  {} pts  {}", t.name, lengthText(t.range_m, d.showsFeet()),
                                                   t.points, smallLengthText(t.residual_m, d.showsFeet()))
                                     : fmt::format("{}  {}", t.name, d.word(t.why_not)),
                             true,
                             {}});
         return rows;
       }},
  };
  return lists;
}

}  // namespace standpoint

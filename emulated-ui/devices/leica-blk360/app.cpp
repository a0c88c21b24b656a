// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/leica-blk360/app.h"

#include <fmt/format.h>

#include "emulated-ui/device/settings.h"

namespace standpoint::leica_blk360 {

bool isG1(const Device& d) { return d.type().instrument.id == "leica-blk360-g1"; }

std::string button(const Device& d) {
  const auto stored = d.entry("button");
  return stored.empty() ? settingsText(resolveSettings(d.type().instrument, {})->values) : stored;
}

Result<void> storeButton(Device& d, const std::string&) {
  d.change().entries["button"] = settingsText(d.state().settings);
  d.change().values["self_timer"] = d.value("timer");
  d.note("button_stored", d.value("timer"));
  return {};
}

Result<void> addTag(Device& d, const std::string&) {
  const auto* setup = d.shownSetup();
  const auto text = d.entry("tag");
  if (setup == nullptr) return failure(ErrorKind::usage, d.word("no_setup"));
  if (text.empty()) return failure(ErrorKind::usage, d.word("tag_empty"));
  const auto at = d.entry("measured_from");
  d.change().values["tag." + d.project()->name + "/" + setup->name + "." + text] = at;
  d.note("tagged", text);
  return {};
}

std::vector<WidgetOption> tagRows(const Device& d) {
  std::vector<WidgetOption> rows;
  const auto* setup = d.shownSetup();
  if (setup == nullptr) return rows;
  const auto stem = "tag." + d.project()->name + "/" + setup->name + ".";
  for (const auto& [id, at] : d.state().values)
    if (id.starts_with(stem))
      rows.push_back({id.substr(stem.size()), id.substr(stem.size()) + (at.empty() ? "" : "  (" + at + ")"), true, {}});
  return rows;
}

std::string accuracyOf(const StoredSetup& s) {
  if (!s.link) return "Unset";
  return s.link->joined && s.link->error_m < 0.01 ? "Accurate" : "Inaccurate";
}

std::vector<WidgetOption> linkRows(const Device& d) {
  std::vector<WidgetOption> rows;
  if (const auto* p = d.project())
    for (std::size_t i = 1; i < p->setups.size(); ++i) {
      const auto& s = p->setups[i];
      const double quality = s.link && s.link->joined ? s.link->overlap * 100 : 0;
      rows.push_back({std::to_string(i),
                      fmt::format("{} – {}  {}  {:.0f} %", p->setups[i - 1].name, s.name, accuracyOf(s), quality),
                      true,
                      {}});
    }
  return rows;
}

// Everything hangs together when each setup but the first has its link.
Result<void> optimise(Device& d, const std::string&) {
  const auto* p = d.project();
  if (p == nullptr || p->setups.size() < 2) return failure(ErrorKind::usage, d.word("link_needs_two"));
  for (std::size_t i = 1; i < p->setups.size(); ++i)
    if (!p->setups[i].link || !p->setups[i].link->joined)
      return failure(ErrorKind::usage, p->setups[i].name + ": " + d.word("link_missing"));
  d.change().entries["bundle"] = p->name;
  d.note("optimised", std::to_string(p->setups.size()));
  return {};
}

Result<void> send(Device& d, const std::string&) {
  if (d.value("server").empty()) return failure(ErrorKind::usage, d.word("no_server"));
  for (const char* id : {"server", "port"})  // the office's listens where the file says
    if (d.value(id) != findValue(d.type().definition, id)->default_value)
      return failure(ErrorKind::usage, d.word("no_answer"));
  if (!d.state().around.wlan) return failure(ErrorKind::usage, d.word("wlan_lost"));
  TransferOrder order{{}, "wlan"};
  for (const auto& p : d.state().projects)
    for (const auto& s : p.setups)
      if (!s.transferred) order.files.push_back(s.file);
  if (order.files.empty()) return failure(ErrorKind::usage, d.word("nothing_to_transfer"));
  d.give(std::move(order));
  return {};
}

}  // namespace standpoint::leica_blk360

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/linking.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

constexpr std::array kLaid = {"shift_x", "shift_y", "turn"};  // values of the device

int rowOf(const Device& device, const StoredSetup& setup) {
  const auto& setups = device.project()->setups;
  return static_cast<int>(&setup - setups.data());
}

}  // namespace

const StoredSetup* setupWithFile(const std::vector<StoredSetup>& setups, const std::string& file) {
  const auto found = std::find_if(setups.begin(), setups.end(), [&](const StoredSetup& s) { return s.file == file; });
  return found == setups.end() ? nullptr : &*found;
}

Pose movedByLinks(const std::vector<StoredSetup>& setups, const StoredSetup& setup) {
  Pose moved;
  const auto* s = &setup;
  for (std::size_t i = 0; s != nullptr && s->link && s->link->joined && i < setups.size(); ++i) {
    moved = s->link->error * moved;
    s = setupWithFile(setups, s->link->to);
  }
  return moved;
}

const StoredSetup* setupOfFile(const Device& device, const std::string& file) {
  for (const auto& p : device.state().projects)
    if (const auto* setup = setupWithFile(p.setups, file)) return setup;
  return nullptr;
}

const StoredSetup* partnerOf(const Device& device, const StoredSetup& setup) {
  const auto* project = device.project();
  if (project == nullptr) return nullptr;
  const auto& joined = !setup.joined_with.empty() || !setup.link ? setup.joined_with : setup.link->to;
  const StoredSetup* before = nullptr;
  for (const auto& other : project->setups) {
    if (other.file == setup.file) return before;
    if (other.file == joined) return &other;
    before = &other;
  }
  return nullptr;
}

Result<std::pair<StoredSetup*, StoredSetup*>> pairIn(Device& device, const std::string& rows) {
  auto* project = device.project();
  const auto pair = numbersIn(rows);
  const auto valid = [&](double row) {
    return row >= 0 && row == std::floor(row) && row < static_cast<double>(project->setups.size());
  };
  if (project == nullptr || !pair || pair->size() != 2 || !valid(pair->front()) || !valid(pair->back()))
    return failure(ErrorKind::usage, "two setups are needed, such as \"1,0\"");
  const auto [a, b] = std::minmax(pair->front(), pair->back());
  const auto newer = static_cast<std::size_t>(b), older = static_cast<std::size_t>(a);
  if (newer == older) return failure(ErrorKind::usage, device.word("link_needs_two"));
  return std::pair(&project->setups[newer], &project->setups[older]);
}

std::optional<LaidCloud> laidCloud(const Device& device, const StoredSetup* setup) {
  const auto* partner = setup == nullptr ? nullptr : partnerOf(device, *setup);
  if (partner == nullptr) return std::nullopt;
  const auto value = [&](int i) { return device.number(std::string("value.") + kLaid[i]); };
  return LaidCloud{rowOf(device, *setup),
                   rowOf(device, *partner),
                   value(0),
                   value(1),
                   value(2),
                   falseStart(device, *setup, *partner)};
}

void forgetLaid(Device& device) {
  for (const char* value : kLaid) device.change().values[value] = std::string(1, '0');
}

void orderLaidLink(Device& device, const StoredSetup& setup) {
  const auto laid = laidCloud(device, &setup);
  if (!laid) return;
  LinkOrder order{.from_file = setup.file,
                  .to_file = device.project()->setups[laid->onto].file,
                  .shift_x_m = laid->shift_x_m,
                  .shift_y_m = laid->shift_y_m,
                  .turn_deg = laid->start_turn_deg + laid->turn_deg};
  mislay(device, order);
  device.give(std::move(order));
}

void removeLink(Device& device) {
  auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->link) return;
  setup->link.reset();
  setup->joined_with.clear();
  device.note("unlinked", setup->name);
}

Result<void> linkSetups(Device& device, const std::string& rows) {
  TRY_ASSIGN(const auto pair, pairIn(device, rows));
  pair.first->joined_with = pair.second->file;
  orderLinkTo(device, *pair.first, *pair.second);
  return {};
}

// Within what the three values allow, which a typed number keeps to as well.
Result<void> layCloud(Device& device, const std::string& laid) {
  const auto numbers = numbersIn(laid);
  if (!numbers || numbers->size() != kLaid.size())
    return failure(ErrorKind::usage, "x, y and turn are needed, in metres and degrees");
  for (std::size_t i = 0; i < kLaid.size(); ++i) {
    const auto* row = findValue(device.type().definition, kLaid[i]);
    const double value = (*numbers)[i];
    if (row == nullptr || !(value >= row->minimum && value <= row->maximum))
      return failure(ErrorKind::usage, fmt::format("{}: outside its limits", device.word(kLaid[i])));
  }
  for (std::size_t i = 0; i < kLaid.size(); ++i)
    device.change().values[kLaid[i]] = fmt::format("{:.6g}", (*numbers)[i]);
  device.note("laid", laid);
  return {};
}

Result<void> layBack(Device& device, const std::string&) {
  forgetLaid(device);
  return {};
}

}  // namespace standpoint

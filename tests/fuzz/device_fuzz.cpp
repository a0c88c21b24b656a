// SPDX-License-Identifier: GPL-3.0-or-later
#include <fuzzer/FuzzedDataProvider.h>

#include "core/data_folder.h"
#include "core/json_file.h"
#include "emulated-ui/device/check.h"
#include "emulated-ui/menus.h"
#include "project/verb.h"
#include "tests/fuzz/fuzz_file.h"

// A shipped device whose definition and words somebody has edited carelessly: rows are gone, doubled or take the place
// of others, names and texts are mixed up. It is refused with its place, or bears whatever is pressed.
namespace standpoint::fuzz {
namespace {

using nlohmann::json;

struct Shipped {
  const EmulatedDevice* device;
  json definition, shared_words, own_words;
  Instrument instrument;
};

template <class T>
T needed(Result<T> read) {
  if (read) return *std::move(read);
  std::fprintf(stderr, "%s\n", describe(read.error()).c_str());
  std::abort();
}

const std::vector<Shipped>& shipped() {
  static const auto all = [] {
    std::vector<Shipped> devices;
    const auto folder = dataFolder() / "emulated-ui";
    for (const auto& device : emulatedDevices())
      devices.push_back({&device, needed(readJsonFile(device.folder() / "device.json")),
                         needed(readJsonFile(folder / "words" / "common.json")),
                         needed(readJsonFile(device.folder() / "words.json")), needed(loadDevice(device))->instrument});
    return devices;
  }();
  return all;
}

// A place somewhere in the tree, and what holds it.
struct Spot {
  json* parent = nullptr;
  json* node = nullptr;
};
Spot spotIn(json& root, FuzzedDataProvider& data) {
  Spot spot{nullptr, &root};
  while (spot.node->is_structured() && !spot.node->empty() &&
         (spot.parent == nullptr || data.ConsumeIntegralInRange(0, 3) != 0)) {
    spot.parent = spot.node;
    spot.node = &*std::next(spot.node->begin(), data.ConsumeIntegralInRange<std::ptrdiff_t>(
                                                    0, static_cast<std::ptrdiff_t>(spot.node->size()) - 1));
  }
  return spot;
}

void edit(json& root, FuzzedDataProvider& data) {
  const Spot at = spotIn(root, data);
  if (at.parent == nullptr) return;
  switch (data.ConsumeIntegralInRange(0, 5)) {
    case 0: {
      const auto found =
          std::find_if(at.parent->begin(), at.parent->end(), [&](const json& j) { return &j == at.node; });
      at.parent->erase(found);
      break;
    }
    case 1: *at.node = json(*spotIn(root, data).node); break;
    case 2:
      if (at.parent->is_array()) at.parent->push_back(json(*at.node));
      break;
    case 3: *at.node = data.ConsumeFloatingPointInRange(-1e4, 1e4); break;
    case 4:
      if (at.node->is_string()) *at.node = at.node->get<std::string>() + data.ConsumeRandomLengthString(12);
      break;
    default: *at.node = data.ConsumeRandomLengthString(40); break;
  }
}

std::string textOf(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

std::filesystem::path wordsFolder(const json& shared) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("standpoint-fuzz-" + std::to_string(getpid()) + "-words");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "common.json", std::ios::binary) << textOf(shared);
  return folder;
}

[[noreturn]] void wrong(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}
void refused(const Error& error) {
  if (error.source.empty() || error.message.empty()) wrong("an error names no place: " + describe(error));
}

void press(Device& device, FuzzedDataProvider& data) {
  const auto screen = device.screen();
  std::vector<const Widget*> all;
  for (const auto* widgets : {&screen.widgets, &screen.body, &screen.dialog.buttons})
    for (const auto& w : *widgets) all.push_back(&w);
  if (all.empty()) return;
  const auto& w = *all[data.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
  std::string value = data.ConsumeBool() ? "7" : data.ConsumeRandomLengthString(8);
  if (!w.options.empty()) value = w.options[data.ConsumeIntegralInRange<std::size_t>(0, w.options.size() - 1)].value;
  (void)device.help(w.id);
  (void)device.act(w.id, value);
}

void play(Device& device, FuzzedDataProvider& data) {
  for (int turn = 0; turn < 40 && data.remaining_bytes() > 0; ++turn) {
    switch (data.ConsumeIntegralInRange(0, 7)) {
      case 0: device.tick(data.ConsumeIntegralInRange(1, 4000)); break;
      case 1:
        (void)device.trouble(
            data.PickValueInArray({"battery_low", "card_missing", "tripod_moved", "too_hot", "tilted", "wlan_lost"}));
        break;
      case 2: (void)device.hand("stand_at", "S1"); break;
      case 3:
        if (const auto order = device.takeOrder(); order && std::holds_alternative<ScanOrder>(*order)) {
          StoredSetup setup;
          setup.project = std::get<ScanOrder>(*order).project;
          setup.name = setup.file = std::get<ScanOrder>(*order).name;
          device.scanDone(std::move(setup));
        }
        break;
      default: press(device, data); break;
    }
    if (findPhase(device.type().definition, device.state().phase) == nullptr) wrong("an unknown phase");
  }
}

void run(FuzzedDataProvider& data) {
  Shipped edited = shipped()[data.ConsumeIntegralInRange<std::size_t>(0, shipped().size() - 1)];
  for (int edits = data.ConsumeIntegralInRange(0, 6); edits > 0; --edits) {
    json& which = *std::array{&edited.definition, &edited.definition, &edited.shared_words,
                              &edited.own_words}[data.ConsumeIntegralInRange<std::size_t>(0, 3)];
    edit(which, data);
  }
  const auto text = textOf(edited.definition);
  auto definition = readDefinition(fileOf(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), ".json"));
  if (!definition) return refused(definition.error());
  auto words = Words::read(wordsFolder(edited.shared_words));
  if (!words) return refused(words.error());
  const auto own = textOf(edited.own_words);
  const auto own_file = fileOf(reinterpret_cast<const std::uint8_t*>(own.data()), own.size(), ".json");
  if (const auto added = words->add(own_file, edited.device->id); !added) return refused(added.error());
  auto type = makeDeviceType(*std::move(definition), edited.device->program(), edited.instrument,
                             std::make_shared<const Words>(*std::move(words)));
  if (!type) return refused(type.error());
  const auto faults = checkDevice(**type);
  for (const auto& fault : faults) refused(fault);
  if (!faults.empty()) return;
  Device device(*type);
  play(device, data);
}

}  // namespace
}  // namespace standpoint::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  standpoint::fuzz::run(data);
  return 0;
}

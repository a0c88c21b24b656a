// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/instruments.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/part_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

Result<void> addFrom(std::vector<KnownInstrument>& known, const fs::path& folder, bool own) {
  auto instruments = readInstruments(folder);
  if (!instruments) {
    Error error = instruments.error();
    if (own) error.message += fmt::format(" (in your custom instruments, {})", folder.string());
    return failure(std::move(error));
  }
  for (auto& i : *instruments) {
    const fs::path file = folder / (i.id + ".json");
    for (const auto& k : known)
      if (k.instrument.id == i.id)
        return failure(ErrorKind::unusable,
                       fmt::format("duplicate id '{}', also used by {}: change one of them", i.id, k.file.string()),
                       file.string());
    known.push_back({std::move(i), file, own});
  }
  return {};
}

// A file's name on every system, and a word on the command line.
bool isId(const std::string& id) {
  constexpr std::string_view kFit = "abcdefghijklmnopqrstuvwxyz0123456789-_";
  return !id.empty() && id.size() <= 64 && id.front() != '-' && id.find_first_not_of(kFit) == id.npos && id != "schema";
}

// The value of the first "id" is the instrument's own: its other groups have none.
bool exchangeId(std::string& text, const std::string& id, const std::string& new_id) {
  const auto key = text.find("\"id\"");
  const auto value = key == text.npos ? text.npos : text.find('"' + id + '"', key + 4);
  if (value == text.npos) return false;
  text.replace(value + 1, id.size(), new_id);
  return true;
}

Result<void> writeNew(const fs::path& file, const std::string& text) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  if (code) return failure(ErrorKind::file_system, "cannot create: " + code.message(), file.parent_path().string());
  if (fs::exists(file, code)) return failure(ErrorKind::usage, "the file already exists", file.string());
  return writeWholeText(file, text);
}

}  // namespace

fs::path shippedInstrumentsFolder() { return dataFolder() / "scanners" / "instruments"; }

fs::path tripodStandFile() { return dataFolder() / "scanners" / "stands" / "tripod.json"; }

fs::path ownInstrumentsFolder() { return ownPath("STANDPOINT_INSTRUMENTS", "instruments"); }

Result<std::vector<KnownInstrument>> instrumentsWithFiles() {
  std::vector<KnownInstrument> known;
  TRY(addFrom(known, shippedInstrumentsFolder(), false));
  std::error_code code;
  if (const auto own = ownInstrumentsFolder(); !own.empty() && fs::is_directory(own, code))
    TRY(addFrom(known, own, true));
  return known;
}

Result<std::vector<Instrument>> knownInstruments() {
  TRY_ASSIGN(auto known, instrumentsWithFiles());
  std::vector<Instrument> instruments;
  for (auto& k : known) instruments.push_back(std::move(k.instrument));
  return instruments;
}

std::string idsOf(const std::vector<Instrument>& instruments) {
  std::string ids;
  for (const auto& i : instruments) ids += (ids.empty() ? "" : ", ") + i.id;
  return ids;
}

Result<Instrument> instrumentById(const std::string& id) {
  TRY_ASSIGN(auto all, knownInstruments());
  for (auto& i : all)
    if (i.id == id) return std::move(i);
  return failure(ErrorKind::usage,
                 fmt::format("unknown instrument '{}'; available: {}; or specify a file", id, idsOf(all)),
                 "--instrument");
}

bool isInstrumentFile(const std::string& id_or_file) {
  return id_or_file.find('/') != std::string::npos || id_or_file.ends_with(".json");
}

Result<Instrument> instrumentNamed(const std::string& id_or_file) {
  if (!isInstrumentFile(id_or_file)) return instrumentById(id_or_file);
  auto instrument = readInstrument(id_or_file);
  if (instrument) return instrument;
  Error error = instrument.error();
  if (error.kind == ErrorKind::file_system)
    error.message += "; specify a file or an id that `standpoint instruments` lists";
  else
    error.message += fmt::format(" (in the instrument's file, {})", id_or_file);
  return failure(std::move(error));
}

Result<fs::path> copyInstrument(const std::string& id, const std::string& new_id) {
  TRY_ASSIGN(const auto known, instrumentsWithFiles());
  const auto named = [&](const std::string& wanted) {
    const auto is = [&](const KnownInstrument& k) { return k.instrument.id == wanted; };
    return std::find_if(known.begin(), known.end(), is);
  };
  const auto original = named(id);
  if (original == known.end()) return failure(ErrorKind::usage, fmt::format("unknown instrument '{}'", id), "--copy");
  if (!isId(new_id))
    return failure(ErrorKind::usage, "an id can contain lowercase letters, digits, - and _, up to 64 characters",
                   "--as");
  if (const auto taken = named(new_id); taken != known.end())
    return failure(ErrorKind::usage, fmt::format("id '{}' is already used by {}", new_id, taken->file.string()),
                   "--as");
  const fs::path folder = ownInstrumentsFolder();
  if (folder.empty())
    return failure(ErrorKind::usage, "no folder for custom instruments: set STANDPOINT_INSTRUMENTS", "--copy");
  std::ifstream stream(original->file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!exchangeId(text, id, new_id))
    return failure(ErrorKind::internal, "the id was not found in the file", original->file.string());
  const fs::path file = folder / (new_id + ".json");
  TRY(writeNew(file, text));
  return file;
}

}  // namespace standpoint

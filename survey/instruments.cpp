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

// The user's own: each by itself, so that a mistake in one blocks no other.
void addOwn(InstrumentFiles& files, const fs::path& folder) {
  const auto own = instrumentFiles(folder);
  if (!own) return files.broken.push_back({"", folder, own.error()});
  const auto shipped = static_cast<std::ptrdiff_t>(files.usable.size());
  for (const auto& file : *own) {
    const std::string id = file.stem().string();
    const auto same = std::find_if(files.usable.begin(), files.usable.begin() + shipped,
                                   [&](const KnownInstrument& k) { return k.instrument.id == id; });
    if (same != files.usable.begin() + shipped) {
      auto message = fmt::format("duplicate id '{}', also used by {}: give yours another id and file name", id,
                                 same->file.string());
      files.broken.push_back({id, file, {ErrorKind::unusable, std::move(message), file.string()}});
    } else if (auto instrument = readInstrument(file)) {
      files.usable.push_back({std::move(*instrument), file, true});
    } else {
      Error error = instrument.error();
      error.message +=
          fmt::format(" (in your custom instruments, {}: correct the file or move it away)", folder.string());
      files.broken.push_back({id, file, std::move(error)});
    }
  }
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

Result<InstrumentFiles> instrumentsWithFiles() {
  InstrumentFiles files;
  const fs::path folder = shippedInstrumentsFolder();
  TRY_ASSIGN(auto shipped, readInstruments(folder));
  for (auto& i : shipped) {
    const fs::path file = folder / (i.id + ".json");
    files.usable.push_back({std::move(i), file, false});
  }
  std::error_code code;
  if (const auto own = ownInstrumentsFolder(); !own.empty() && fs::is_directory(own, code)) addOwn(files, own);
  return files;
}

Result<std::vector<Instrument>> knownInstruments() {
  TRY_ASSIGN(auto files, instrumentsWithFiles());
  std::vector<Instrument> instruments;
  for (auto& k : files.usable) instruments.push_back(std::move(k.instrument));
  return instruments;
}

std::string idsOf(const std::vector<Instrument>& instruments) {
  std::string ids;
  for (const auto& i : instruments) ids += (ids.empty() ? "" : ", ") + i.id;
  return ids;
}

Result<Instrument> instrumentById(const std::string& id) {
  TRY_ASSIGN(auto files, instrumentsWithFiles());
  for (const auto& b : files.broken)
    if (b.id == id) return failure(b.error);
  std::vector<Instrument> all;
  for (auto& k : files.usable) {
    if (k.instrument.id == id) return std::move(k.instrument);
    all.push_back(std::move(k.instrument));
  }
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
  TRY_ASSIGN(const auto files, instrumentsWithFiles());
  const auto named = [&](const std::string& wanted) {
    const auto is = [&](const KnownInstrument& k) { return k.instrument.id == wanted; };
    return std::find_if(files.usable.begin(), files.usable.end(), is);
  };
  const auto taken_by = [&](const std::string& wanted) {
    const auto taken = named(wanted);
    if (taken != files.usable.end()) return taken->file;
    const auto is = [&](const BrokenInstrument& b) { return b.id == wanted; };
    const auto broken = std::find_if(files.broken.begin(), files.broken.end(), is);
    return broken == files.broken.end() ? fs::path() : broken->file;
  };
  const auto original = named(id);
  if (original == files.usable.end()) {
    for (const auto& b : files.broken)
      if (b.id == id) return failure(b.error);
    return failure(ErrorKind::usage, fmt::format("unknown instrument '{}'", id), "--copy");
  }
  if (!isId(new_id))
    return failure(ErrorKind::usage, "an id can contain lowercase letters, digits, - and _, up to 64 characters",
                   "--as");
  if (const auto taken = taken_by(new_id); !taken.empty())
    return failure(ErrorKind::usage, fmt::format("id '{}' is already used by {}", new_id, taken.string()), "--as");
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

std::filesystem::path shippedInstrumentsFolder();
// Where the user's own lie: STANDPOINT_INSTRUMENTS, else XDG_CONFIG_HOME/standpoint/instruments. It need not be there.
std::filesystem::path ownInstrumentsFolder();
std::filesystem::path tripodStandFile();  // what readTripodStand reads

struct KnownInstrument {
  Instrument instrument;
  std::filesystem::path file;
  bool own = false;
};
// The shipped ones, then the user's own. An id in both folders is an error that names both files.
Result<std::vector<KnownInstrument>> instrumentsWithFiles();
Result<std::vector<Instrument>> knownInstruments();
// "leica-p40, leica-rtc360, …": what an error offers.
std::string idsOf(const std::vector<Instrument>& instruments);
// By id; an unknown one is an error of --instrument that lists those there are.
Result<Instrument> instrumentById(const std::string& id);
// As --instrument names it: by id, or by the path of a file, which has a slash or ends in .json.
bool isInstrumentFile(const std::string& id_or_file);
Result<Instrument> instrumentNamed(const std::string& id_or_file);
// Writes the file of an instrument under another id into the user's folder; gives the new file.
Result<std::filesystem::path> copyInstrument(const std::string& id, const std::string& new_id);

}  // namespace standpoint

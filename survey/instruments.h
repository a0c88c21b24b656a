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
// What the user's own folder holds beside usable instruments: a file with a mistake, one with the id of a shipped
// instrument. It is listed, and only who asks for that id gets the error, which says file, place and remedy.
struct BrokenInstrument {
  std::string id;  // the file's name without .json; empty where it is the folder that cannot be read
  std::filesystem::path file;
  Error error;
};
struct InstrumentFiles {
  std::vector<KnownInstrument> usable;  // the shipped ones, then the user's own
  std::vector<BrokenInstrument> broken;
};
// A shipped file that is wrong is an error.
Result<InstrumentFiles> instrumentsWithFiles();
Result<std::vector<Instrument>> knownInstruments();
// "leica-p40, leica-rtc360, …": what an error offers.
std::string idsOf(const std::vector<Instrument>& instruments);
// By id; an unknown one is an error of --instrument that lists those there are, a broken one is its own error.
Result<Instrument> instrumentById(const std::string& id);
// As --instrument names it: by id, or by the path of a file, which has a slash or ends in .json.
bool isInstrumentFile(const std::string& id_or_file);
Result<Instrument> instrumentNamed(const std::string& id_or_file);
// Writes the file of an instrument under another id into the user's folder; gives the new file.
Result<std::filesystem::path> copyInstrument(const std::string& id, const std::string& new_id);

}  // namespace standpoint

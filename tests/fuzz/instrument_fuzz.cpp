// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/instrument.h"
#include "tests/fuzz/fuzz_file.h"

// An instrument is read, or refused with its place; one for a tripod that is read can scan as it is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace standpoint;
  const auto instrument = readInstrument(fuzz::fileOf(data, size, ".json"));
  if (!instrument && instrument.error().source.empty()) std::abort();
  if (instrument && !instrument->moving && !resolveSettings(*instrument, {})) std::abort();
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/exercise.h"
#include "tests/fuzz/fuzz_file.h"

// An exercise is read, or refused with its place; so is a condition alone, and one that is read says the same when it
// is read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace standpoint;
  const auto exercise = readExercise(fuzz::fileOf(data, size, ".json"));
  if (!exercise && exercise.error().source.empty()) std::abort();
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto condition = Condition::parse(text)) {
    if (!Condition::parse(condition->text())) std::abort();
    (void)condition->holds([](const std::string&) { return std::optional<Fact>(); });
    (void)condition->check([](const std::string&) { return std::optional(FactDomain{{}, true, 0, 1}); });
  }
  return 0;
}

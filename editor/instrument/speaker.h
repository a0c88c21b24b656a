// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "emulated-ui/device/sounds.h"

namespace standpoint {

// Plays tones on the machine's standard sound output, by OpenAL. The output is opened when the first tone is played,
// and all that may take time happens in a thread of its own: whoever plays never waits. A sound takes the place of the
// one that is still heard.
class Speaker {
 public:
  // `wake` is called from that thread when problem() has changed.
  explicit Speaker(std::function<void()> wake);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  void play(std::vector<Beep> tones);
  // Why nothing is heard, for people, once: what was read is forgotten. Empty: nothing is wrong.
  std::string takeProblem();

 private:
  void loop(const std::stop_token& stop);
  void say(std::string problem);

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any due_;
  std::optional<std::vector<Beep>> next_;
  std::string problem_;
  std::jthread thread_;  // from the first tone on
};

}  // namespace standpoint

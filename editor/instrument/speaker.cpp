// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/speaker.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <chrono>
#include <memory>
#include <string_view>
#include <utility>

#include "editor/instrument/tones.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr int kRate_hz = 44100;
constexpr std::chrono::milliseconds kFades{500};  // what an output holds back of a sound
// What OpenAL Soft calls its output where there is none begins so.
constexpr std::string_view kNowhere = "No ";

// The open output with the one source that plays on it.
class Output {
 public:
  Output() : device_(alcOpenDevice(nullptr)) {
    if (device_ == nullptr) return;
    const auto* name = alcGetString(device_.get(), ALC_ALL_DEVICES_SPECIFIER);
    if (name != nullptr && std::string_view(name).starts_with(kNowhere)) return;
    context_.reset(alcCreateContext(device_.get(), nullptr));
    if (context_ == nullptr || alcMakeContextCurrent(context_.get()) == ALC_FALSE) return;
    alGenSources(1, &source_);
    alGenBuffers(1, &buffer_);
    works_ = alGetError() == AL_NO_ERROR;
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (works_) {
      alDeleteSources(1, &source_);
      alDeleteBuffers(1, &buffer_);
    }
    alcMakeContextCurrent(nullptr);
  }

  bool works() const { return works_; }
  // How long it will be heard.
  std::chrono::milliseconds play(const std::vector<Beep>& tones) const {
    const auto samples = samplesOf(tones, kRate_hz);
    mix(true);
    alSourceStop(source_);
    alSourcei(source_, AL_BUFFER, 0);
    alBufferData(buffer_, AL_FORMAT_MONO16, samples.data(), static_cast<ALsizei>(samples.size() * sizeof(samples[0])),
                 kRate_hz);
    alSourcei(source_, AL_BUFFER, static_cast<ALint>(buffer_));
    alSourcePlay(source_);
    return std::chrono::milliseconds(1000 * samples.size() / kRate_hz);
  }
  // An output that rests costs no time of the processor.
  void rest() const { mix(false); }

 private:
  struct Close {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
    void operator()(ALCcontext* context) const { alcDestroyContext(context); }
  };
  void mix(bool on) const {
    if (alcIsExtensionPresent(device_.get(), "ALC_SOFT_pause_device") == ALC_FALSE) return;
    const auto* name = on ? "alcDeviceResumeSOFT" : "alcDevicePauseSOFT";
    // Of both extensions' functions the type is one; OpenAL has no other way to give it.
    const auto set = reinterpret_cast<LPALCDEVICEPAUSESOFT>(alcGetProcAddress(device_.get(), name));
    if (set != nullptr) set(device_.get());
  }

  std::unique_ptr<ALCdevice, Close> device_;
  std::unique_ptr<ALCcontext, Close> context_;
  ALuint source_ = 0, buffer_ = 0;
  bool works_ = false;
};

}  // namespace

Speaker::Speaker(std::function<void()> wake) : wake_(std::move(wake)) {}
Speaker::~Speaker() = default;

void Speaker::play(std::vector<Beep> tones) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(tones);
  }
  if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { loop(stop); });
  due_.notify_one();
}

std::string Speaker::takeProblem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

void Speaker::say(std::string problem) {
  {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(problem);
  }
  wake_();
}

void Speaker::loop(const std::stop_token& stop) {
  const Output output;
  if (!output.works()) say(tr("No sound output found: instrument sounds stay silent"));
  std::unique_lock lock(mutex_);
  const auto is_due = [this] { return next_.has_value(); };
  while (due_.wait(lock, stop, is_due)) {
    while (next_) {
      const auto tones = std::exchange(next_, std::nullopt);
      if (!output.works()) break;
      lock.unlock();
      const auto heard = output.play(*tones);
      lock.lock();
      due_.wait_for(lock, stop, heard + kFades, is_due);
    }
    if (output.works()) output.rest();
  }
}

}  // namespace standpoint

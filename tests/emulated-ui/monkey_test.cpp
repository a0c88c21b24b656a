// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "survey/instruments.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

// A seeded monkey that knows nothing: it presses what is on the screen, uses its hands, has bad luck, and the
// simulation behind the device sometimes fails. In virtual time.
class Monkey {
 public:
  Monkey(TestDevice& device, std::uint32_t seed) : d_(device), random_(seed) {}

  void play(double seconds) {
    const double until = d_->state().clock_s + seconds;
    while (d_->state().clock_s < until && !testing::Test::HasFatalFailure()) {
      turn();
      look();
    }
  }

  std::set<std::string> screens, phases;
  int stored = 0;

 private:
  std::size_t next(std::size_t n) {
    random_ = random_ * 1664525U + 1013904223U;
    return n == 0 ? 0 : (random_ >> 8U) % n;
  }

  void turn() {
    if (d_->busy() && next(3) == 0) {  // it has patience now and then
      work();
      d_->tick(60);
    }
    switch (next(20)) {
      case 0:
        (void)d_->hand(handRows()[next(handRows().size())].id,
                       next(2) == 0 ? "S" + std::to_string(next(3)) : "0.1,0.2");
        break;
      case 1:
        if (next(10) == 0) (void)d_->trouble(troubleRows()[next(troubleRows().size())].id);
        break;
      case 2: d_->tick(static_cast<double>(next(20)) + 0.5); break;
      case 3: work(); break;
      case 4: help(); break;
      default:
        press();
        d_->tick(0.2);
        break;
    }
    if (d_->takeStored()) ++stored;
    (void)d_->takeCancel();
  }

  void press() {
    const auto screen = d_->screen();
    std::vector<const Widget*> all;
    for (const auto* widgets : {&screen.widgets, &screen.body, &screen.dialog.buttons})
      for (const auto& w : *widgets) all.push_back(&w);
    ASSERT_FALSE(all.empty());
    // The big keys on the display draw it: else it would rarely start a scan on a device of many buttons.
    const bool drawn = !screen.has_dialog && next(12) == 0;
    const auto key = std::find_if(screen.widgets.begin(), screen.widgets.end(),
                                  [&](const Widget& w) { return drawn && w.kind == WidgetKind::key; });
    const auto& w = key == screen.widgets.end() ? *all[next(all.size())] : *key;
    std::string value = "n" + std::to_string(next(5));
    if (!w.options.empty())
      value = w.options[next(w.options.size())].value;
    else if (w.kind == WidgetKind::number)
      value = std::to_string(next(400));
    else if (w.kind == WidgetKind::preview)
      value = "0.5,0.5";
    if (w.kind == WidgetKind::area) value = "10,200,-20,30";
    Gesture by = Gesture::tap;
    if (!w.gestures.empty() && next(3) == 0) by = w.gestures[next(w.gestures.size())];
    if (w.kind == WidgetKind::plan) value = std::to_string(next(3));
    if (by == Gesture::join) value += "," + std::to_string(next(3));
    if (by == Gesture::lay) value = "1.5,-" + value + ",30";
    (void)d_->act(w.id, value, by);
  }

  // A careful hand mends what is wrong now and then, else nothing would ever be scanned.
  void help() {
    if (next(3) != 0) return;
    for (const char* hand :
         {"plug_in", "change_battery", "change_card", "unlock_card", "level", "wipe_optics", "go_near", "clear_view"})
      (void)d_->hand(hand);
    (void)d_->hand("stand_at", "S1");
  }

  FittedTarget sighted(const std::string& name) {
    auto t = fittedSphere(name, 80);
    t.found = next(3) != 0;
    return t;
  }

  void work() {
    auto order = d_->takeOrder();
    if (!order) return;
    if (next(15) == 0) return d_->orderFailed("disk full");
    if (const auto* scan = std::get_if<ScanOrder>(&*order))
      d_.finish(*scan);
    else if (std::holds_alternative<LinkOrder>(*order))
      d_->linkDone({next(2) == 0, 0.002, 0.5, 0, 0});
    else if (std::holds_alternative<TargetOrder>(*order))
      d_->targetsDone({});
    else if (const auto* sight = std::get_if<SightOrder>(&*order))
      d_->sightDone(sighted(sight->target));
    else if (const auto* transfer = std::get_if<TransferOrder>(&*order))
      d_->transferDone(transfer->files);
    else if (std::holds_alternative<SceneOrder>(*order))
      d_->sceneDone();
  }

  // Whatever was done: a known phase and screen, something to press, no label without a word, and no stored scan is
  // gone that was not deleted or formatted.
  void look() {
    const auto screen = d_->screen();
    const auto& definition = d_->type().definition;
    ASSERT_NE(findPhase(definition, d_.phase()), nullptr);
    phases.insert(d_.phase());
    if (d_->on()) {
      ASSERT_NE(findScreen(definition, screen.id), nullptr) << screen.id;
      screens.insert(screen.id);
      if (!d_.dialog().empty()) {
        ASSERT_NE(findDialog(definition, d_.dialog()), nullptr) << d_.dialog();
        ASSERT_FALSE(screen.dialog.text.empty());
      }
    }
    std::size_t now = 0, gone = 0;
    for (const auto& p : d_->state().projects) now += p.setups.size();
    for (; seen_ < d_->state().log.size(); ++seen_) {
      const auto& event = d_->state().log[seen_];
      if (event.what == "setup_deleted") ++gone;
      if (event.what == "card_formatted") gone = count_;
    }
    ASSERT_GE(now + gone, count_) << "a scan was lost";
    count_ = now;
  }

  TestDevice& d_;
  std::uint32_t random_;
  std::size_t seen_ = 0, count_ = 0;
};

// The device with each scanner that it drives; one that drives any, with all that stand on a tripod.
std::vector<std::shared_ptr<const DeviceType>> withEachScanner(const EmulatedDevice& device) {
  const auto first = loadDevice(device);
  EXPECT_TRUE(first) << describe(first.error());
  if (!first) return {};
  auto scanners = (*first)->definition.instruments;
  if (std::erase(scanners, "*") > 0) {
    const auto all = knownInstruments();
    EXPECT_TRUE(all) << describe(all.error());
    for (const auto& known : all ? *all : std::vector<Instrument>())
      if (!known.moving && std::find(scanners.begin(), scanners.end(), known.id) == scanners.end())
        scanners.push_back(known.id);
  }
  std::vector<std::shared_ptr<const DeviceType>> types;
  for (const auto& scanner : scanners) {
    const auto type = loadDevice(device, scanner);
    EXPECT_TRUE(type) << describe(type.error());
    if (type) types.push_back(*type);
  }
  return types;
}

class Monkeys : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(Monkeys, MashTheKeysForHoursWithEachScannerWithoutHarm) {
  constexpr std::size_t kHours = 16, kFewest = 2;  // of virtual time: in all, and with each scanner
  std::set<std::string> screens, phases;
  const auto types = withEachScanner(*GetParam());
  ASSERT_FALSE(types.empty());
  const auto hours = std::max(kFewest, kHours / types.size());
  for (const auto& type : types) {
    int stored = 0;
    for (std::uint32_t seed = 1; seed <= hours || (stored == 0 && seed <= 150); ++seed) {
      TestDevice d(type);
      Monkey monkey(d, seed);
      monkey.play(3600);
      ASSERT_FALSE(HasFatalFailure()) << type->instrument.id << " seed " << seed;
      screens.insert(monkey.screens.begin(), monkey.screens.end());
      phases.insert(monkey.phases.begin(), monkey.phases.end());
      stored += monkey.stored;
    }
    EXPECT_GT(stored, 0) << type->instrument.id;
  }
  const auto& all = types.front()->definition;
  EXPECT_GE(screens.size() * 10, all.screens.size() * 7) << "the monkeys saw too few screens to prove much";
  EXPECT_GE(phases.size() * 10, all.phases.size() * 6) << "the monkeys saw too few phases to prove much";
}

INSTANTIATE_TEST_SUITE_P(Devices, Monkeys, testing::ValuesIn(everyDevice()), deviceName);

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/memory.h"

#include <fstream>

#include "emulated-ui/host.h"
#include "tests/emulated-ui/support.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

// What a project that is opened again tells of a setup: its file, and what the names say.
std::vector<StoredSetup> heldByTheProject(const Device& device, const std::string& from, const std::string& to) {
  std::vector<StoredSetup> held;
  for (const auto& p : device.state().projects)
    for (const auto& s : p.setups) {
      StoredSetup bare;
      bare.project = p.name;
      bare.number = s.number;
      bare.name = s.name;
      bare.station = s.station;
      bare.file = to + s.file.substr(from.size());
      bare.points = s.points;
      bare.bytes = s.bytes;
      held.push_back(bare);
    }
  return held;
}

TEST(Memory, AnX7KeepsItsRegistrationsAnnotationsAndNotesThoughTheProjectWasMoved) {
  TestDevice d("trimble-x7");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(60);
  ASSERT_TRUE(d.press({"connect"}));
  d->tick(10);
  ASSERT_TRUE(
      d.press({"create_new", "name=House", "note=first floor", "first=7", "create", "scan_panel", "images=off"}));
  for (const char* station : {"S1", "S2"}) {
    ASSERT_TRUE(d->hand("stand_at", station));
    ASSERT_TRUE(d.press({"start_scan"}));
    d->tick(30);
    d.scanned();
    d->tick(200);
    if (std::string(station) == "S2") continue;
    ASSERT_TRUE(d.press({"annotation=cracked", "add_annotation", "map", "scan_panel"}));
  }
  d->linkDone({true, 0.002, 0.8, 0.001, 0.01});
  d->tick(20);
  ASSERT_TRUE(d.press({"registration"}));
  ASSERT_EQ(d.fact("registration"), "registered");
  ASSERT_TRUE(d.press({"apply", "back", "menu", "options", "operator=Ada", "language=de"}));

  const auto memory = deviceMemory(*d, "scans");
  EXPECT_EQ(memory.dump().find("scans/"), std::string::npos) << "no file is named by the folder it lay in";
  TestDevice again("trimble-x7");
  again->load(heldByTheProject(*d, "scans", "/moved/scans"));
  again->know({{}, {{"S1", {1, 1, 0}}, {"S2", {3, 1, 0}}}, {0, 0, 0}});
  ASSERT_TRUE(recallMemory(*again, memory, "/moved/scans"));
  EXPECT_EQ(again.fact("project"), "House");
  EXPECT_EQ(again.fact("project.first"), "7");
  EXPECT_EQ(again->project()->note, "first floor");
  EXPECT_EQ(again.fact("setups"), "2");
  EXPECT_EQ(again.fact("registration"), "applied");
  EXPECT_EQ(again.fact("link.overlap"), d.fact("link.overlap"));
  EXPECT_EQ(again.fact("value.operator"), "Ada");
  EXPECT_EQ(again->state().language, "de");
  EXPECT_EQ(again.fact("setting.images"), "off");
  EXPECT_EQ(again.phase(), "off") << "a device that was carried home is off";
  EXPECT_EQ(again->value("annotation./moved/scans/House/Station 007.e57.01"), "cracked");
  EXPECT_EQ(deviceMemory(*again, "/moved/scans"), memory) << "nothing was lost and nothing was added";
}

TEST(Memory, APSeriesKeepsItsStationWithTargetsAndCoordinates) {
  TestDevice d("leica-p-series");
  ControlList control;
  for (int i = 0; i < 4; ++i) control.targets.push_back({"T" + std::to_string(i), {i % 2 * 8.0, i / 2 * 6.0, 1.0 + i}});
  control.stations = {{"S1", {1, 2, 0}}};
  d->know(control);
  ASSERT_TRUE(d.press({"power"}));
  d->tick(70);
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press({"manage", "new_project", "name=House", "create", "scan_menu", "method=resection_6"}));
  for (const auto& place : control.targets) {
    ASSERT_TRUE(d.press({"measure_target", "view_list=" + place.name, "pick"}));
    ASSERT_TRUE(d->takeOrder());
    FittedTarget target{place.name, "checkerboard", 80, 10, 0.0005, 0, true, ""};
    target.levelled_m = place.place_m - Eigen::Vector3d(1, 2, 1.7);
    d->sightDone(target);
    d->tick(31);
    ASSERT_TRUE(d.press({"to_setup"}));
  }
  ASSERT_TRUE(d.press({"solve", "accept", "ok"}));
  ASSERT_EQ(d.fact("orientation.accepted"), "yes");

  const auto memory = deviceMemory(*d, "scans");
  TestDevice again("leica-p-series");
  again->know(control);
  ASSERT_TRUE(recallMemory(*again, memory, "scans"));
  EXPECT_EQ(again.fact("station"), "S1");
  EXPECT_EQ(again.fact("orientation.accepted"), "yes");
  EXPECT_EQ(again.fact("orientation.place"), d.fact("orientation.place"));
  EXPECT_EQ(again.fact("targets.sighted"), "4");
  EXPECT_EQ(again->project()->carried.size(), 4U) << "the traverse goes on from them";
  EXPECT_EQ(again.fact("project"), "House") << "though nothing was scanned in it";

  TestDevice elsewhere("leica-p-series");  // its station is gone from the project
  ASSERT_TRUE(recallMemory(*elsewhere, memory, "scans"));
  EXPECT_EQ(elsewhere.fact("station"), "");
  EXPECT_EQ(elsewhere.fact("orientation.solved"), "no");
}

TEST(Memory, KeepsNoTroubleAndNoConnection) {
  TestDevice d("leica-blk360");
  ASSERT_TRUE(d->trouble("symmetrical_room"));
  d->change().values["connection"] = "OK";
  const auto memory = deviceMemory(*d, "scans");
  TestDevice again("leica-blk360");
  ASSERT_TRUE(recallMemory(*again, memory, "scans"));
  EXPECT_EQ(again->value("connection"), "Disconnected");
  EXPECT_EQ(again->value("false_start"), "");
}

TEST(Memory, KeepsWhatItDoesNotKnowAndLeavesOutWhatTheProjectDoesNotHold) {
  TestDevice d("leica-rtc360");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(60);
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press({"job", "new_job", "name=House", "create", "scan"}));
  d.scanned();
  d.settle();
  const auto memory = deviceMemory(*d, "scans");
  auto held = heldByTheProject(*d, "scans", "scans");
  held[0].file = "scans/House/Setup 002.e57";
  held[0].number = 2;
  TestDevice again("leica-rtc360");
  again->load(held);
  ASSERT_TRUE(recallMemory(*again, memory, "scans"));
  ASSERT_EQ(again->project()->setups.size(), 1U);
  EXPECT_EQ(again->project()->setups[0].number, 2) << "scanned by the verb, say; the first was undone";
}

TEST(Memory, AFileThatIsNoMemoryIsRefusedAndChangesNothing) {
  TestDevice d("leica-rtc360");
  auto memory = deviceMemory(*d, "scans");
  for (const char* missing : {"version", "values", "projects", "settings", "open"}) {
    auto broken = memory;
    broken.erase(missing);
    broken["values"]["units"] = "feet";
    if (std::string(missing) == "values") broken["values"] = "feet";
    EXPECT_FALSE(recallMemory(*d, broken, "scans")) << missing;
    EXPECT_EQ(d->value("units"), "metres") << missing;
  }
  memory["version"] = 2;
  EXPECT_FALSE(recallMemory(*d, memory, "scans"));
}

TEST(Memory, AHostReadsItOnceAndWritesItAfterEachPress) {
  const TemporaryFolder folder;
  const auto scans = folder.path() / "scans";
  const Document document =
      run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document;
  const auto type = *loadDevice(*findDevice("faro-focus"));
  const auto file = memoryFile(scans, *type);
  DeviceHost first(type, document, nullptr);
  ASSERT_TRUE(first.remember(scans));
  (void)first.update(document, scans, 0.01);
  EXPECT_FALSE(std::filesystem::exists(file)) << "nobody has touched it";
  ASSERT_TRUE(first.device().act("power"));
  (void)first.update(document, scans, 150 / first.time_factor);
  for (const auto& [widget, value] : {std::pair{"manage", ""}, {"operators", ""}, {"operator", "Ada"}})
    ASSERT_TRUE(first.device().act(widget, value));
  (void)first.update(document, scans, 0.01);
  EXPECT_TRUE(std::filesystem::exists(file));
  DeviceHost second(type, document, nullptr);
  ASSERT_TRUE(second.remember(scans));
  EXPECT_EQ(second.device().value("operator"), "Ada");
  std::ofstream(file) << "{";
  DeviceHost third(type, document, nullptr);
  EXPECT_FALSE(third.remember(scans));
  ASSERT_TRUE(third.device().act("power"));
  (void)third.update(document, scans, 1);
  std::ifstream in(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "{") << "what could not be read is not written over";
}

}  // namespace
}  // namespace standpoint

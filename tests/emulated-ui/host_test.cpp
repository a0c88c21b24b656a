// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/host.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "emulated-ui/sighting.h"
#include "pointclouds/formats.h"
#include "tests/emulated-ui/support.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

std::string bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Host : public testing::Test {
 protected:
  Host()
      : document_(run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document),
        host_(*loadDevice(*findDevice("leica-rtc360")), document_, nullptr) {
    press({"power"});
    device().tick(60);
    (void)device().hand("stand_at", "S1");
    press({"job", "new_job", "name=House", "create", "settings", "resolution=12mm", "images=off", "back"});
  }

  Device& device() { return host_.device(); }
  void press(const std::vector<std::string>& widgets) {
    for (const auto& text : widgets) {
      const auto equals = text.find('=');
      const auto done =
          device().act(text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1));
      EXPECT_TRUE(done) << text << ": " << describe(done.error());
    }
  }
  std::optional<Outcome> runUntilIdle(double seconds_a_step) {
    for (int i = 0; i < kPatience; ++i) {
      if (auto stored = host_.update(document_, folder_.path() / "scans", seconds_a_step)) return stored;
      if (!host_.busy()) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }
  void runOrder() {
    for (int i = 0; i < kPatience; ++i) {
      (void)host_.update(document_, folder_.path() / "scans", 0.001);
      if (host_.task() == nullptr) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  TemporaryFolder folder_;
  Document document_;
  DeviceHost host_;
};

TEST_F(Host, AScanThroughTheDeviceGivesTheSameBytesAsTheVerb) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  const auto& scan = stored->document.job->stations[0].scans.at(0);
  EXPECT_EQ(fs::path(scan.file), folder_.path() / "scans" / "House" / "Setup 001.e57");
  EXPECT_EQ(stored->description, "Scanned 'Setup 001' at S1 with Leica RTC360");
  const auto direct = folder_.path() / "direct.e57";
  nlohmann::json notes = nlohmann::json::array();
  for (const auto& [key, text] : device().newestSetup()->notes) notes.push_back(key + "=" + text);
  EXPECT_EQ(notes.size(), 3U) << "compass, altimeter, GPS";
  ASSERT_TRUE(run("scan", document_,
                  {{"instrument", "leica-rtc360"},
                   {"set", {"resolution=12mm", "images=off"}},
                   {"seed", 1},
                   {"note", notes},
                   {"output", direct.string()}}));
  EXPECT_TRUE(bytes(scan.file) == bytes(direct));
}

TEST_F(Host, ShowsMeasuresAndHandsOverTheScanAtOnce) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  document_ = stored->document;
  press({"look"});
  runOrder();
  ASSERT_NE(device().shownSetup()->preview, nullptr);
  EXPECT_EQ(device().shownSetup()->preview->columns, 509U);
  // Opposite directions, level: the room's inner length, 6 - 2 x 0.2 m, between two of its walls.
  press({"preview=0.001,0.42", "preview=0.501,0.42"});
  const double along = device().fact("measured")->number.value();
  EXPECT_GT(along, 3.5);
  EXPECT_LT(along, 7.5);
  press({"home", "tools", "transfer", "by_cable"});
  runOrder();
  EXPECT_EQ(device().state().dialog, "transferred");
  EXPECT_TRUE(bytes(folder_.path() / "office" / "House - Setup 001.e57") ==
              bytes(device().state().projects[0].setups[0].file));
}

TEST_F(Host, ACopyInAnotherFormatHoldsTheSamePoints) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  document_ = stored->document;
  const auto& setup = *device().newestSetup();
  device().give(TransferOrder{{setup.file}, "cable", ".las"});
  runOrder();
  const auto copy = folder_.path() / "office" / "House - Setup 001.las";
  const auto info = cloudFormatFor(copy)->info(copy);
  ASSERT_TRUE(info) << describe(info.error());
  EXPECT_EQ(info->scans.at(0).points, setup.points);
  EXPECT_EQ(device().fact("setups.transferred")->number, 1);
}

TEST_F(Host, ASlowComputerDoesNotEmptyTheBattery) {
  press({"scan"});
  const double takes_s = device().fact("expected.seconds")->number.value();
  ASSERT_TRUE(runUntilIdle(1));  // 20 s of the device's time in each step of 5 ms
  const double used_s = (1 - device().fact("battery")->number.value()) * device().type().definition.body.battery_s;
  EXPECT_LT(used_s, 60 + takes_s + 100);
}

TEST_F(Host, TheClockStandsWhileWhatWasScannedIsOnlyRead) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  document_ = stored->document;
  const double battery = device().state().around.battery, clock_s = device().state().clock_s;
  press({"look"});
  (void)host_.update(document_, folder_.path() / "scans", 60);
  ASSERT_NE(host_.task(), nullptr) << "the preview is read";
  EXPECT_TRUE(host_.clockStands());
  EXPECT_EQ(device().state().clock_s, clock_s);
  EXPECT_EQ(device().state().around.battery, battery);
  runOrder();
  EXPECT_FALSE(host_.clockStands());
  (void)host_.update(document_, folder_.path() / "scans", 60);
  EXPECT_NEAR(device().state().clock_s, clock_s + 60 * host_.time_factor, 1);
}

// The fixture's end destroys the host while its task runs: the task is joined before what it would write is gone.
TEST_F(Host, GoesWhileItsTaskRuns) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  document_ = stored->document;
  press({"look"});
  (void)host_.update(document_, folder_.path() / "scans", 0.01);
  EXPECT_NE(host_.task(), nullptr);
}

TEST_F(Host, AStoppedScanLeavesNoFileAndNoSetup) {
  press({"scan"});
  host_.time_factor = 0.001;
  (void)host_.update(document_, folder_.path() / "scans", 0.01);
  press({"stop", "yes"});
  EXPECT_FALSE(runUntilIdle(0.01));
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
    EXPECT_FALSE(entry.is_regular_file()) << entry.path();
}

TEST_F(Host, WithoutAProjectFolderTheDeviceSaysWhatToDo) {
  press({"scan"});
  EXPECT_FALSE(host_.update(document_, {}, 0.1));
  EXPECT_NE(device().screen().dialog.text.find("Save the project"), std::string::npos);
}

TEST_F(Host, TheDevicesMemoryIsFilledFromTheProject) {
  press({"scan"});
  const auto stored = runUntilIdle(1);
  ASSERT_TRUE(stored);
  const auto setups = storedSetups(stored->document, device().type());
  ASSERT_EQ(setups.size(), 1U);
  EXPECT_EQ(setups[0].project, "House");
  EXPECT_EQ(setups[0].number, 1);
  EXPECT_EQ(setups[0].station, "S1");
}

// Three spheres stand in the room; what is under the cross is picked under the name that is typed.
class PickingHost : public Host {
 protected:
  PickingHost() {
    Job job = *document_.job;
    const Eigen::Vector3d eye{2.5, 2, 1.6};
    job.targets = {{"T1", TargetKind::sphere, {1, 0.8, 1.2}, Eigen::Vector3d::UnitX(), 0.145},
                   {"T2", TargetKind::sphere, {5.2, 1, 2}, Eigen::Vector3d::UnitX(), 0.145},
                   {"T3", TargetKind::sphere, {1.2, 3.4, 1.9}, Eigen::Vector3d::UnitX(), 0.145}};
    for (const auto& t : job.targets) towards_.push_back((t.centre - eye).normalized());
    document_.job = std::make_shared<const Job>(std::move(job));
    press({"resolution=6mm", "scan"});
    const auto stored = runUntilIdle(1);
    EXPECT_TRUE(stored);
    if (stored) document_ = stored->document;
    press({"look"});
    runOrder();
    press({"targets", "pick_targets"});
  }
  // The cell of the picture that looks that way.
  std::string place(const Eigen::Vector3d& towards) {
    const auto& p = *device().shownSetup()->preview;
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < p.x_m.size(); ++i) {
      if (!std::isfinite(p.x_m[i])) continue;
      const double along = Eigen::Vector3d(p.x_m[i], p.y_m[i], p.z_m[i]).normalized().dot(towards);
      if (along > most) most = along, best = i;
    }
    return fmt::format("{:.5f},{:.5f}", (static_cast<double>(best % p.columns) + 0.5) / p.columns,
                       1 - (static_cast<double>(best / p.columns) + 0.5) / p.rows);
  }
  const std::vector<FittedTarget>& picked() { return device().shownSetup()->targets; }

  std::vector<Eigen::Vector3d> towards_;
};

TEST_F(PickingHost, WhatIsUnderTheCrossIsPickedUnderTheNameThatIsTyped) {
  EXPECT_EQ(device().state().screen, "pick_target");
  press({"pick_view=" + place(towards_[1]), "target_name=Door", "pick_type=sphere", "pick"});
  runOrder();
  ASSERT_EQ(picked().size(), 1U) << device().state().dialog_detail;
  EXPECT_EQ(picked()[0].name, "Door");
  EXPECT_GT(picked()[0].centre_m.normalized().dot(towards_[1]), std::cos(0.002));
  press({"pick_view=" + place(towards_[0]), "pick"});
  runOrder();
  ASSERT_EQ(picked().size(), 1U) << "the name has a new place";
  EXPECT_GT(picked()[0].centre_m.normalized().dot(towards_[0]), std::cos(0.002));
}

TEST_F(PickingHost, AWallAndAnotherKindAreNotPicked) {
  const Eigen::Vector3d between = (towards_[0] + towards_[2]).normalized();
  press({"pick_view=" + place(between), "pick_type=sphere", "pick"});
  runOrder();
  EXPECT_EQ(device().state().dialog, "refused") << "there is only the wall";
  press({"ok", "pick_view=" + place(towards_[0]), "pick_type=checkerboard", "pick"});
  runOrder();
  EXPECT_EQ(device().state().dialog, "refused") << "it is a sphere";
  EXPECT_TRUE(picked().empty());
}

TEST_F(PickingHost, WhatStandsBeforeATargetIsNotTheTarget) {
  const auto pick = [&](double share) {
    const auto& job = *document_.job;
    const Eigen::Vector3d centre = job.stations[0].true_pose.rotation.conjugate() *
                                   (job.targets[1].centre - job.stations[0].true_pose.translation);
    Progress progress;
    auto picked =
        pickedTarget(document_, {device().shownSetup()->file, share * centre, 0.005, "sphere", "Door"}, 1, progress);
    return picked && picked->found;
  };
  EXPECT_TRUE(pick(0.97)) << "its own surface";
  EXPECT_TRUE(pick(1.3)) << "a coarse cell has seen the wall beside it";
  EXPECT_FALSE(pick(0.6)) << "a post before it";
}

// A P40 in the lower room with four targets on its walls and in the room: measured one after the other, solved,
// accepted.
class SurveyHost : public testing::Test {
 protected:
  SurveyHost() {
    document_ =
        run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}, {"yaw-deg", 30.0}})
            ->document;
    Job job = *document_.job;
    job.targets = {{"T1", TargetKind::sphere, {1, 0.8, 1.2}, Eigen::Vector3d::UnitX(), 0.145},
                   {"T2", TargetKind::sphere, {5.2, 1, 2}, Eigen::Vector3d::UnitX(), 0.145},
                   {"T3", TargetKind::sphere, {1.2, 3.4, 1.9}, Eigen::Vector3d::UnitX(), 0.145}};
    document_.job = std::make_shared<const Job>(std::move(job));
    host_ = std::make_unique<DeviceHost>(*loadDevice(*findDevice("leica-p-series")), document_, nullptr);
    press({"power"});
    device().tick(70);
    (void)device().hand("stand_at", "S1");
    press({"manage", "new_project", "name=House", "create"});
  }
  Device& device() { return host_->device(); }
  void press(const std::vector<std::string>& widgets) {
    for (const auto& text : widgets) {
      const auto equals = text.find('=');
      const auto done =
          device().act(text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1));
      EXPECT_TRUE(done) << text << ": " << describe(done.error());
    }
  }
  std::optional<Outcome> runUntilIdle() {
    for (int i = 0; i < kPatience; ++i) {
      if (auto stored = host_->update(document_, folder_.path() / "scans", 1)) return stored;
      if (!host_->busy()) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return std::nullopt;
  }

  TemporaryFolder folder_;
  Document document_;
  std::unique_ptr<DeviceHost> host_;
};

TEST_F(SurveyHost, AnAcceptedResectionOverScannedTargetsIsTheStationsSolvedPose) {
  press({"scan_menu", "method=resection_4", "measure_target", "target_type=sphere", "view_list=T1", "pick"});
  EXPECT_FALSE(runUntilIdle());
  EXPECT_EQ(device().state().screen, "target_result") << device().state().dialog_detail;
  press({"measure_target", "view_list=T2", "pick"});
  (void)runUntilIdle();
  press({"measure_target", "view_list=T3", "pick"});
  (void)runUntilIdle();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "scans")) << "the windows are not kept";
  ASSERT_EQ(device().state().sighted.size(), 3U);
  press({"to_setup", "solve"});
  EXPECT_LT(device().fact("orientation.rms")->number.value(), 3);
  press({"accept", "ok"});
  const auto outcome = runUntilIdle();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->description, "Oriented S1 with Leica ScanStation P-series");
  const auto& station = outcome->document.job->stations[0];
  ASSERT_TRUE(station.solved_pose);
  EXPECT_LT((station.solved_pose->translation - station.true_pose.translation).norm(), 0.003);
  EXPECT_LT(station.solved_pose->rotation.angularDistance(station.true_pose.rotation), 0.002);
}

TEST_F(SurveyHost, TheWrongTypeOfTargetIsNotFound) {
  press({"targets", "measure_target", "target_type=hds_6in", "view_list=T1", "pick"});
  (void)runUntilIdle();
  EXPECT_EQ(device().state().dialog, "target_not_found");
}

TEST_F(SurveyHost, WhatTheDeviceFiltersIsNotInTheFile) {
  press({"scan_page", "resolution_page", "resolution=50mm", "back", "image_page", "images=off", "back", "scan",
         "continue"});
  const auto whole = runUntilIdle();
  ASSERT_TRUE(whole);
  document_ = whole->document;
  press({"main_menu", "scan_page", "filter_page", "max_range=2", "back", "scan", "continue"});
  const auto filtered = runUntilIdle();
  ASSERT_TRUE(filtered);
  const auto& scans = filtered->document.job->stations[0].scans;
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_GT(scans[1].points, 0U);
  EXPECT_LT(scans[1].points, scans[0].points) << "the far walls are 2 to 3.5 m away";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "scans" / "House"), fs::directory_iterator()), 2)
      << "no raw file is left";
}

TEST_F(SurveyHost, ImageOnlyIsAPictureWithoutPoints) {
  press({"scan_page", "image_page", "image_resolution=640", "images=only", "back", "scan", "continue"});
  const auto stored = runUntilIdle();
  ASSERT_TRUE(stored) << device().state().dialog_detail;
  const auto& scan = stored->document.job->stations[0].scans.at(0);
  EXPECT_EQ(scan.points, 0U);
  EXPECT_NE(bytes(scan.file).find("images2D"), std::string::npos);
}

}  // namespace
}  // namespace standpoint

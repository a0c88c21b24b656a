// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "tests/emulated-ui/support.h"

namespace standpoint {

// Transitions and rules: instrument facts, section 2.5.
class X7 : public testing::Test {
 protected:
  explicit X7(const std::string& instrument = {}) : d("trimble-x7", instrument) {}

  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(60);
    ASSERT_EQ(d.screen(), "start");
  }
  // On, connected, with a project, standing at S1, quick settings, on the scan panel.
  void ready(const std::string& project = "House") {
    start();
    ASSERT_TRUE(d.press({"connect"}));
    d->tick(10);
    ASSERT_EQ(d.phase(), "idle");
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d->hand("plug_in"));
    ASSERT_TRUE(d.press({"create_new", "name=" + project, "create", "scan_panel", "images=off"}));
  }
  // Until the laser turns.
  ScanOrder beginLaser() {
    EXPECT_TRUE(d.press({"start_scan"}));
    d->tick(30);
    EXPECT_EQ(d.phase(), "scanning");
    return d.scanned();
  }
  void scanAt(const std::string& station) {
    ASSERT_TRUE(d->hand("stand_at", station));
    const auto home = d.screen() == "station_view" ? "map" : d.screen() == "registration" ? "back" : "";
    ASSERT_TRUE(*home == '\0' || d.press({home}));
    ASSERT_TRUE(d.screen() != "map_view" || d.press({"scan_panel"}));
    beginLaser();
    d->tick(200);
  }
  // Two stations, the second of which is waiting for its link.
  LinkOrder secondStation() {
    scanAt("S1");
    EXPECT_EQ(d.phase(), "idle");
    scanAt("S2");
    EXPECT_EQ(d.phase(), "registering");
    const auto order = d->takeOrder();
    EXPECT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
    return order && std::holds_alternative<LinkOrder>(*order) ? std::get<LinkOrder>(*order) : LinkOrder{};
  }
  // Three stations in a row with links that hold.
  void threeLinked() {
    ready();
    secondStation();
    linked(0.002, 0.8);
    scanAt("S3");
    d->takeOrder();
    linked(0.002, 0.8);
  }
  void linked(double error_m, double overlap, bool joined = true) {
    d->linkDone({joined, error_m, overlap, 0, 0});
    d->tick(20);
    d->tick(1);
  }

  TestDevice d;
};

class X9 : public X7 {
 protected:
  X9() : X7("trimble-x9") {}
};

}  // namespace standpoint

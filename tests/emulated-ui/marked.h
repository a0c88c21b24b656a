// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/marks.h"

namespace standpoint {

inline Marks marked(const Rehearsal& rehearsal, const std::string& student = "", const std::string& language = "en") {
  Progress quiet;
  auto marks = marksOf(rehearsal, student, language, quiet);
  EXPECT_TRUE(marks) << describe(marks.error());
  return marks ? *std::move(marks) : Marks{};
}

}  // namespace standpoint

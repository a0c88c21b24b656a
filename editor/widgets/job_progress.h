// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

class Progress;
struct Style;

namespace ui {

// How far a job is, in a bar of this width; stripes move over it while that is not known.
void jobBar(const Style& style, const Progress& progress, float width);
// "Stage  42 %  12 s left", of that what is known.
std::string jobText(const Progress& progress, double seconds_so_far);
void cancelButton(const Style& style, const char* label, Progress& progress, float width);

}  // namespace ui
}  // namespace standpoint

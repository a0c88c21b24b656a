// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace standpoint {

struct Editor;
enum class GraphicsChoice;

// From the next picture on, and says so: much of a level shows only while the view is at rest.
void chooseGraphics(Editor& editor, GraphicsChoice choice);
// The levels of graphics to choose from, each with a line that says what it has and what it costs here.
void drawGraphicsChoices(Editor& editor, float width_pt);
// The line of the command that chooses a level; "" of any other command.
std::string aboutGraphics(const Editor& editor, std::string_view command);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

// What lies over one another, the topmost first: Esc ends one of these and nothing below it.
enum class EscapeLayer { text, drag, popup, modal, preview, proof, play, tool, walk, selection, none };

// The layer that Esc would end now.
EscapeLayer escapeLayer(const Editor& editor);

// The one place that Esc leads to; a click beside a modal asks that to go, too. Once a frame, before anything is drawn,
// so that every layer is seen as it was when the key was pressed.
void closeTopmost(Editor& editor);

// The layers tool, walk and selection, as the menu has them.
void leaveTool(Editor& editor);

}  // namespace standpoint

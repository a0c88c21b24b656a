// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;
struct InstrumentDesk;

// Gives the editor its emulated device: the panel that draws it, its clock, and the way its scans take into the
// document. What it works with lives as long as the editor.
InstrumentDesk& attachInstrument(Editor& editor);

}  // namespace standpoint

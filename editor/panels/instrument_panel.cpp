// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/icons.h"
#include "editor/shell/widgets.h"

namespace standpoint {

// The emulated device draws itself; whoever starts the editor says which.
void drawInstrumentPanel(Editor& editor) {
  if (editor.draw_instrument)
    editor.draw_instrument(editor);
  else
    ui::emptyState(editor, ICON_TABLET, "No device",
                   "This build has no emulated devices. To scan without one, use the Survey workspace.");
}

}  // namespace standpoint

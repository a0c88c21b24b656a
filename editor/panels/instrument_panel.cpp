// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

// The emulated device draws itself; whoever starts the editor says which.
void drawInstrumentPanel(const Model& model, PanelStates&, Actions& actions) {
  if (!actions.drawInstrument())
    ui::emptyState(model, ICON_TABLET, "No device",
                   "This build has no emulated devices. To scan without one, use the Survey workspace.");
}

}  // namespace standpoint

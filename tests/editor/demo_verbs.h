// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "demo_document.h"
#include "project/verb.h"

namespace standpoint {

// The program's verbs and one that makes the demo house, so that a session comes to a document as it always does.
inline std::vector<Verb> verbsWithDemo() {
  std::vector<Verb> table(verbs().begin(), verbs().end());
  table.push_back({"demo",
                   "Make the demo house",
                   VerbScope::creates,
                   {},
                   [](const Document&, const nlohmann::json&, Progress&) -> Result<Outcome> {
                     Outcome outcome;
                     outcome.document = demoHouse();
                     outcome.report = *outcome.document.import_report;
                     outcome.description = "Made the demo house";
                     return outcome;
                   }});
  return table;
}

}  // namespace standpoint

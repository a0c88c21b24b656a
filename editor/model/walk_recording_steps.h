// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

struct Model;
struct Instrument;

// Recording a walk: while somebody walks, their way becomes a trajectory of the job; it ends when they stop walking, or
// jump. What was recorded waits until the document is free.
std::string whyNotRecordWalk(const Model& model);
void recordWalk(Model& model);    // begins, or ends and adds it
void followRecord(Model& model);  // once a frame
void finishRecord(Model& model);  // ends it and waits until it is in the document, if that is free
void forgetRecord(Model& model);  // of a document that is no longer there

// Scanning while one walks: the same, and what the chosen carried instrument would see is shown as it comes, without
// noise and errors. Its trajectory keeps every turn and tilt.
std::string whyNotScanWalk(const Model& model);
void scanWalk(Model& model);         // begins, or ends
bool scansWalk(const Model& model);  // or is about to
// That is carried next; null where there is none that somebody could carry on foot.
const Instrument* carriedOnFoot(const Model& model);

// The real scan along what was scanned live last, into the project's own scans. "" or why not.
std::string whyNotScanWalked(const Model& model);
void scanWalked(Model& model);
std::string whyNoLivePoints(const Model& model);
void dropLivePoints(Model& model);

}  // namespace standpoint

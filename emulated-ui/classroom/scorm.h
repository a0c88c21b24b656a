// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/result.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/class_list.h"

namespace standpoint {

// The bytes of a SCORM 1.2 package (ZIP) for a learning management system. Its page takes a file from the student,
// checks seals, chain, student, variant and deadline, and reports the mark.
// `graded` false: the file is the student's signed result. Nothing on a student's computer proves a mark, so this is
// for exercises that are not graded. True: it is the mark that the lecturer signed after verifying it.
// The same order gives the same bytes.
Result<std::string> scormPackage(const Assignment& assignment, const ClassList& list, bool graded);

}  // namespace standpoint

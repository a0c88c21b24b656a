// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/recovery_keeper.h"

#include <algorithm>
#include <string_view>
#include <thread>

#include "editor/model/session.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kYoung{60};
constexpr std::chrono::seconds kLastCopy{30};
constexpr Seconds kBetweenMarks{2};  // while only a percentage moves: each mark is synced to the disk

std::vector<LeftJob> jobsOf(const Session& session) {
  std::vector<LeftJob> jobs;
  for (const auto& task : session.running()) {
    const std::string_view verb = task->verb().name;
    if (verb.ends_with("-recovery") || verb.ends_with("-project")) continue;
    jobs.push_back({task->title(), task->progress().stageName(),
                    std::min(99, static_cast<int>(100 * task->progress().fraction())), std::string(verb),
                    task->options()});
  }
  if (session.runs_elsewhere)
    for (auto& job : session.runs_elsewhere()) jobs.push_back(std::move(job));
  return jobs;
}

// Apart from how far its jobs are.
bool saysTheSame(SessionMark a, const SessionMark& b) {
  if (a.jobs.size() != b.jobs.size()) return false;
  for (std::size_t i = 0; i < a.jobs.size(); ++i) a.jobs[i].percent = b.jobs[i].percent;
  return a == b;
}

}  // namespace

void RecoveryKeeper::keep(Session& session, bool copies) {
  if (copies) keepCopy(session);
  keepMark(session);
}

void RecoveryKeeper::keepLast(Session& session) {
  display_lost_ = true;
  const auto until = Clock::now() + kLastCopy;
  do {
    keep(session);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    session.poll();
  } while (!upToDate(session) && (session.keepsRecovery() || tried_revision_ != session.revision()) &&
           Clock::now() < until);
  keep(session);
}

void RecoveryKeeper::keepCopy(Session& session) {
  if (!session.modified() || !session.document().imported) {
    if (there_ && !session.keepsRecovery()) {
      removeRecovery(folder_);
      there_ = false;
      written_.reset();
      tried_revision_ = 0;
    }
    return;
  }
  if (upToDate(session) || tried_revision_ == session.revision() || session.keepsRecovery()) return;
  tried_revision_ = session.revision();
  keepMark(session);  // first: a copy without its mark would have no name
  there_ = session.saveRecovery(folder_ / "copy");
}

void RecoveryKeeper::keepMark(const Session& session) {
  const SessionMark mark{session.name(),
                         session.folder().string(),
                         session.history().unsavedChanges(),
                         jobsOf(session),
                         untilGrown_s() >= 0,
                         after_crash_,
                         display_lost_,
                         session.shown_as ? session.shown_as() : nlohmann::json::object()};
  const auto now = Clock::now();
  if (written_ && (*written_ == mark || (saysTheSame(*written_, mark) && now - marked_ < kBetweenMarks))) return;
  marked_ = now;
  written_ = mark;
  const auto written = writeSessionMark(folder_, mark);
  problem_ = written ? std::string() : trError(written.error());
}

double RecoveryKeeper::untilGrown_s() const {
  const Seconds left = kYoung - (Clock::now() - begun_);
  return left.count() > 0 ? left.count() : -1;
}

bool RecoveryKeeper::upToDate(const Session& session) const {
  return !session.modified() || !session.document().imported ||
         (there_ && session.keptRevision() == session.revision());
}

}  // namespace standpoint

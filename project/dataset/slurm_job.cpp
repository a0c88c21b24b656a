// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/slurm_job.h"

#include <fmt/format.h>

#include "core/part_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// What both scripts begin with. STANDPOINT stands for another program, such as
// "apptainer exec --bind /data standpoint.sif standpoint". TERM comes a minute before a time limit, and at once where
// a task is cancelled or given to another node.
std::string beginningOf(const Recipe& recipe, const char* name, int threads, const char* log) {
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name={}-{}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n"
      "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:TERM@60\n#SBATCH --output={}\n\n",
      recipe.name, name, threads, log);
}

}  // namespace

std::string shellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

Result<std::vector<std::string>> writeSlurmJob(const SlurmJob& job, const Recipe& recipe) {
  const auto folder = job.set / "slurm";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create: " + error.message(), folder.string());
  const auto program = fmt::format("${{STANDPOINT:-{}}}", shellWord(job.program.string()));
  // `exec`, so that the signal of a task that ends reaches the program: it stops between two points and what is
  // finished stays.
  const auto array =
      beginningOf(recipe, "scans", job.threads, "%x-%A-%a.log") +
      fmt::format(
          "exec {} dataset run {} -o {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads \"${{SLURM_CPUS_PER_TASK:-{}}}\" "
          "--resume\n",
          program, shellWord(job.recipe.string()), shellWord(job.set.string()), job.shards, job.threads);
  const auto manifest = beginningOf(recipe, "manifest", 1, "%x-%j.log") +
                        fmt::format("exec {} dataset manifest {}\n", program, shellWord(job.set.string()));
  // What is given to `submit` goes to both: a partition, an account, a time limit.
  const std::string submit = fmt::format(
      "#!/bin/sh\nset -e\ncd {}\nscans=$(sbatch --parsable --array=1-{} \"$@\" array.sbatch)\n"
      "manifest=$(sbatch --parsable --dependency=afterok:\"${{scans%%;*}}\" --kill-on-invalid-dep=yes \"$@\" "
      "manifest.sbatch)\necho \"scans $scans, manifest $manifest\"\n",
      shellWord(folder.string()), job.shards);
  std::vector<std::string> written;
  for (const auto& [name, text] : {std::pair<const char*, const std::string&>{"array.sbatch", array},
                                   {"manifest.sbatch", manifest},
                                   {"submit", submit}}) {
    TRY(writeWholeText(folder / name, text));
    written.push_back(std::string("slurm/") + name);
  }
  fs::permissions(folder / "submit", fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, error);
  return written;
}

}  // namespace standpoint

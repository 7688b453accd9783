// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/slurm_jobs.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/replaced.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJobsFile = "slurm/jobs";

[[noreturn]] void refuse(const std::string& message, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

/// As one word of a shell.
std::string shell_word(const std::string& text) { return '\'' + io::replaced(text, "'", "'\\''") + '\''; }

/// As the value of an option in a script for sbatch, in which % begins a pattern.
std::string script_path(const fs::path& path) {
  const std::string text = path.string();
  if (text.find_first_of("\"\\\n") != std::string::npos)
    refuse(path.string() + " cannot stand in a script for sbatch", "choose a folder without quotes and backslashes");
  return '"' + io::replaced(text, "%", "%%") + '"';
}

std::string script_head(const SlurmRequest& request, const std::string& name, const std::string& log) {
  std::string text = fmt::format("#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n",
                                 name, script_path(request.folder / "slurm" / "LOG"));
  text = io::replaced(text, "LOG\"", log + '"');
  for (const std::string& option : request.options) {
    if (!option.starts_with('-') || option.find('\n') != std::string::npos)
      refuse(fmt::format("'{}' is no option of sbatch", option), "for example --slurm-option=--partition=short");
    text += "#SBATCH " + option + '\n';
  }
  return text;
}

std::string sweep_call(const SlurmRequest& request, const std::string& own) {
  std::string text = fmt::format("exec {} --quiet --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" sweep {} -o {} {}",
                                 shell_word(request.program.string()), shell_word(request.study.string()),
                                 shell_word(request.folder.string()), own);
  for (const auto& [plugin, hash] : loaded_plugins()) text += " --plugin " + shell_word(plugin);
  for (const std::string& setting : request.settings) text += " --set " + shell_word(setting);
  return text + '\n';
}

/// "0-3,7" of increasing numbers.
std::string index_ranges(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[i]);
    if (end > i) text += fmt::format("-{}", numbers[end]);
    i = end + 1;
  }
  return text;
}

/// Gives the jobs to Slurm unless earlier ones of the folder still wait or run.
constexpr const char* kSubmit = R"sh(#!/bin/sh
# Submits the jobs beside this file, and writes their numbers into the file jobs.
set -e
cd "$(dirname "$0")"
if [ -f jobs ] && [ -n "$(squeue -h -j "$(paste -sd, jobs)" 2>/dev/null)" ]; then
  echo "jobs $(paste -sd' ' jobs) of this study still wait or run: scancel $(paste -sd' ' jobs) ends them" >&2
  exit 1
fi
)sh";
constexpr const char* kSubmitBoth = R"sh(array=$(sbatch --parsable array.sh)
array=${array%%;*}
# Also behind tasks that fail: what they left unsolved is told by the job itself.
merge=$(sbatch --parsable --dependency=afterany:"$array" merge.sh)
printf '%s\n' "$array" "${merge%%;*}" >jobs
echo "job $array: the runs; job ${merge%%;*}: gathers them"
)sh";
constexpr const char* kSubmitMerge = R"sh(merge=$(sbatch --parsable merge.sh)
printf '%s\n' "${merge%%;*}" >jobs
echo "job ${merge%%;*}: gathers the runs, all of which are finished"
)sh";

}  // namespace

SlurmScripts write_slurm_scripts(const io::StudyFile& study, const SlurmRequest& request) {
  const std::vector<int> finished = study_state(study, request.folder).finished;
  const std::size_t runs = study.runs.size(), most = static_cast<std::size_t>(std::max(1, request.tasks));
  const std::size_t share = (runs + most - 1) / most;
  std::vector<std::size_t> done((runs + share - 1) / share, 0), open;
  for (const int run : finished) ++done[static_cast<std::size_t>(run - 1) / share];
  for (std::size_t task = 0; task < done.size(); ++task)
    if (done[task] < std::min(share, runs - task * share)) open.push_back(task);

  const fs::path folder = request.folder / "slurm";
  make_folder(folder);
  SlurmScripts scripts{folder / "submit.sh", open.size()};
  if (!open.empty())
    write_file(folder / "array.sh",
               script_head(request, "treadmark", "task_%a.log") +
                   fmt::format("#SBATCH --array={}\n#SBATCH --requeue\n", index_ranges(open)) +
                   fmt::format("first=$((SLURM_ARRAY_TASK_ID * {} + 1))\n", share) +
                   sweep_call(request, fmt::format("--runs \"$first-$((first + {}))\"", share - 1)));
  std::string merge = "--merge";
  if (!request.report.empty()) merge += " --report " + shell_word(request.report.string());
  write_file(folder / "merge.sh",
             script_head(request, "treadmark-merge", "merge.log") + "#SBATCH --requeue\n" + sweep_call(request, merge));
  write_file(scripts.submit, std::string(kSubmit) + (open.empty() ? kSubmitMerge : kSubmitBoth));
  return scripts;
}

std::vector<std::string> slurm_jobs(const fs::path& folder) {
  std::vector<std::string> jobs;
  if (!fs::exists(folder / kJobsFile)) return jobs;
  std::istringstream text(io::profiles::read_text(folder / kJobsFile, "jobs", {}));
  for (std::string job; text >> job;)
    if (ranges::all_of(job, [](char c) { return c >= '0' && c <= '9'; })) jobs.push_back(job);
  return jobs;
}

}  // namespace treadmark::app

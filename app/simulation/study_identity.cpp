// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/study_identity.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "treadmark/app/simulation/result_head.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::app {

std::vector<std::pair<std::string, std::string>> swept_of(const io::StudyFile& study, const io::StudyRun& run) {
  std::vector<std::pair<std::string, std::string>> swept;
  for (std::size_t i = 0; i < study.variations.size(); ++i) {
    const io::Variation& v = study.variations[i];
    const std::string& key = !v.key.empty() ? v.key : v.label;
    swept.emplace_back(key.empty() ? fmt::format("vary.{}", i) : key, v.values[run.values[i]].label);
  }
  return swept;
}

std::string label_of(const io::StudyFile& study, const io::StudyRun& run) {
  std::string label;
  for (std::size_t i = 0; i < study.variations.size(); ++i)
    label += (i > 0 ? ", " : "") + study.variations[i].values[run.values[i]].label;
  return label;
}

std::string study_identity(const io::StudyFile& study, const io::RunRange& runs) {
  std::string text = fmt::format("treadmark {} {}\nbase {}\n", version(), git_revision(), io::sha256_file(study.base));
  for (const io::StudyRun& run : study.runs) {
    if (!runs.has(run)) continue;
    text += fmt::format("run {}\n", run.number);
    for (const auto& [key, value] : swept_of(study, run)) text += fmt::format("  swept {}: {}\n", key, value);
    for (const std::string& setting : run.overrides) text += fmt::format("  set {}\n", setting);
    const auto input = io::read_study_run(study, run);
    for (const auto& [name, hash] : std::visit([](const auto& file) { return input_hashes(file); }, input))
      text += fmt::format("  file {} {}\n", name, hash);
  }
  return text;
}

bool same_study(const std::string& all, const std::string& some, const io::RunRange& runs) {
  if (runs.whole()) return all == some;
  // The runs stand one behind the other in both.
  const std::size_t first = std::min(some.find("\nrun "), some.size());
  const std::string own = some.substr(first);
  const std::size_t at = all.find(own), behind = at == std::string::npos ? at : at + own.size();
  return all.compare(0, first, some, 0, first) == 0 && behind != std::string::npos &&
         (behind == all.size() || all.compare(behind, 4, "run ") == 0);
}

}  // namespace treadmark::app

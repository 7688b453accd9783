// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/study_folder.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/histories/study_store.hpp"

namespace treadmark::app::report {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw Error(ErrorKind::input_data, "the file cannot be read", {file.string()});
  return text.str();
}

/// Numbers of all runs of the study, from its identity: lines "run 12".
std::vector<int> runs_of(const fs::path& file) {
  std::istringstream lines(text_of(file));
  std::vector<int> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("run ")) continue;
    int number = 0;
    const char* end = line.data() + line.size();
    const auto [at, error] = std::from_chars(line.data() + 4, end, number);
    if (error != std::errc() || at != end || number < 1)
      throw Error(ErrorKind::input_data, fmt::format("\"{}\" names no run", line), {file.string()},
                  "give a folder that treadmark sweep wrote");
    numbers.push_back(number);
  }
  return numbers;
}

std::string label_of(const std::vector<std::pair<std::string, std::string>>& swept) {
  std::string label;
  for (const auto& [key, value] : swept) label += (label.empty() ? "" : ", ") + value;
  return label;
}

}  // namespace

StudyOnDisk read_study_folder(const fs::path& folder) {
  StudyOnDisk out;
  const fs::path whole = folder / "sweep.h5";  // written when all runs are finished
  if (fs::exists(whole)) out.study = io::read_study_head(whole);
  if (out.study.input_file.empty())
    out.study.input_file =
        folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  for (const int number : runs_of(folder / "study.id")) {
    const fs::path store = folder / "runs" / fmt::format("run_{:04}", number) / "simulation.h5";
    if (!fs::exists(store)) {
      out.unfinished.push_back(static_cast<std::size_t>(number));
      continue;
    }
    io::SimulationResult run = io::read_simulation_head(store);
    if (out.study.version.empty()) {
      out.study.version = run.version;
      out.study.git = run.git;
      out.study.input_sha256 = run.input_sha256;
      out.study.title = run.title;
    }
    out.study.runs.push_back({number, run.swept, label_of(run.swept), run.status, run.message, run.summary, store});
  }
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".svg") pictures.push_back(entry.path());
  std::ranges::sort(pictures);
  for (const fs::path& picture : pictures) out.pictures.emplace_back(picture.filename().string(), text_of(picture));
  return out;
}

}  // namespace treadmark::app::report

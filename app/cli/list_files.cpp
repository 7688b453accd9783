// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/list_files.hpp"

#include <fmt/format.h>

#include <iostream>

#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::cli {
namespace {

/// Where rows are kept while a list is made: beside the first file that is asked for; empty: nowhere.
std::filesystem::path kept_rows(const ListFiles& files) {
  for (const std::string& file : files.all())
    if (!file.empty() && file != "-" && !is_stream(file)) return file + ".unfinished";
  return {};
}

}  // namespace

void add_hdf5_file(CLI::App& verb, std::string& file) {
  add_output(verb, "--hdf5", file, "Write the table here (HDF5), a dataset a column", "FILE")
      ->each([](const std::string&) { require_part("hdf5", "--hdf5"); });
}

std::optional<app::ResultList> make_list(
    const ListFiles& files, const CommonOptions& common,
    const std::function<app::ResultList(const std::filesystem::path& kept, const Progress& progress)>& make) {
  const ThreadLimit limit(common.threads);
  const std::filesystem::path kept = kept_rows(files);
  try {
    return with_progress(common.quiet, [&](const Progress& progress) {
      const CancellationScope scope(&interrupted());
      return make(kept, progress);
    });
  } catch (const Cancelled&) {
    std::cerr << (std::filesystem::exists(kept)
                      ? fmt::format("stopped: finished rows are in {}; the same command goes on\n", kept.string())
                      : std::string("stopped before a row was kept\n"));
    return std::nullopt;
  }
}

void write_list(const ListFiles& files, const app::ResultList& list, bool shown) {
  if (files.csv == "-")
    std::cout << app::list_csv(list);
  else if (!files.csv.empty())
    write_file(files.csv, app::list_csv(list));
  if (!files.hdf5.empty()) app::write_list_store(files.hdf5, list);
  write_report_file(files.report, [&] { return app::list_page(list); });
  if (shown && files.csv != "-") print(app::list_text(list));
  if (list.failed() > 0)
    std::cerr << fmt::format("{} of {} {} failed{}\n", list.failed(), list.rows.size(), list.things,
                             files.csv.empty() ? "" : ": see the column error");
  if (const std::filesystem::path kept = kept_rows(files); !kept.empty()) remove_file(kept);
}

}  // namespace treadmark::cli

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::app {

void write_bench_folder(const std::filesystem::path& folder, const BenchReport& report) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::configuration, "cannot create the output folder: " + failure.message(), {folder.string()});
  // The file of an earlier run must not pass for this one if writing fails half way.
  std::filesystem::remove(folder / "bench.json", failure);
  io::write_text_file(folder / "bench.svg", bench_svg(report));
  io::write_text_file(folder / "bench.csv", bench_csv(report));
  io::write_text_file(folder / "bench.json", bench_json(report));
}

}  // namespace treadmark::app

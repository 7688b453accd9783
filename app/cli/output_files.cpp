// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/output_files.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/picture_svg.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/results/write_vtk.hpp"

namespace treadmark::cli {

void write_result_folder(const std::filesystem::path& folder, const io::RunResult& result) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ErrorKind::configuration, "cannot create the output folder: " + failure.message(), {folder.string()});
  // A result of an earlier run must not pass for this one if writing fails half way.
  std::filesystem::remove(folder / "result.json", failure);
  io::write_hdf5(folder / "fields.h5", result);
  io::write_vtk(folder / "vtk", result);
  io::write_pressure_svg(folder / "pressure.svg", result);
  io::write_json(folder / "result.json", result);
}

}  // namespace treadmark::cli

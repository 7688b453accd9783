// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A file of results with any content: see stored_edits.hpp.
#include "stored_edits.hpp"

#include <cstdlib>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"

TREADMARK_FUZZ_TARGET(fuzz_stored_result) {
  using namespace treadmark;
  static const fuzz::TemporaryFile sound("fuzz_stored_result_sound", ".h5"), file("fuzz_stored_result", ".h5");
  static const bool written = (io::write_hdf5(sound.path(), testing::sample_run()), true);
  if (!written) return 0;
  std::filesystem::copy_file(sound.path(), file.path(), std::filesystem::copy_options::overwrite_existing);
  fuzz::edit_stored(file.path(), std::string(fuzz::as_text(data, size)));
  try {
    for (const io::CaseResult& c : io::read_hdf5(file.path()).cases)
      for (const io::PatchResult& p : c.patches) {
        const auto& fields = p.fields;
        if (!fields.pressure.empty() && fields.pressure.size() != fields.grid.size()) std::abort();
      }
  } catch (const Error&) {
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A file of a simulation or of its checkpoint with any content: see stored_edits.hpp.
#include "treadmark/tests/fuzz/results/stored_edits.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/histories/study_store.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"

TREADMARK_FUZZ_TARGET(fuzz_stored_simulation) {
  using namespace treadmark;
  static const fuzz::TemporaryFile sound("fuzz_stored_simulation_sound", ".h5"), file("fuzz_stored_simulation", ".h5");
  static const bool written = (io::write_simulation(sound.path(), testing::sample_simulation(30.0, 40)), true);
  if (!written) return 0;
  std::filesystem::copy_file(sound.path(), file.path(), std::filesystem::copy_options::overwrite_existing);
  fuzz::edit_stored(file.path(), std::string(fuzz::as_text(data, size)));
  const auto read = [](auto reader) {
    try {
      reader(file.path());
    } catch (const Error&) {
    }
  };
  read(io::read_simulation);
  read(io::read_simulation_head);
  read(io::read_snapshots);
  read(io::read_checkpoint);
  read(io::read_study_head);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/file.hpp"
#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/any_answers.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/offset/sound_offsets.hpp"

/// The program that holds OpenVDB gone mad.
TREADMARK_FUZZ_TARGET(fuzz_vdb_messages) {
  static constexpr treadmark::offset::VdbWords kWords{"the offsets", "write them again"};
  try {
    treadmark::offset::VdbFile vdb(std::make_unique<treadmark::fuzz::AnyAnswers>(data, size, size), "a.vdb", size,
                                   kWords);
    treadmark::fuzz::require_sound(treadmark::offset::from_sheet(read_sheet(std::move(vdb)), "a.vdb"));
  } catch (const treadmark::Error&) {
  }
  return 0;
}

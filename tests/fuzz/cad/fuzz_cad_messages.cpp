// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <memory>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cad/cad_process.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/tests/fuzz/any_answers.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

// The first byte says what the name of the file ends in, and the body, the second one where answers begin again.
TREADMARK_FUZZ_TARGET(fuzz_cad_messages) {
  if (size < 2) return 0;
  constexpr const char* kNames[] = {"a.step", "a.STP", "a.igs", "a.iges", "a", "a.step.txt", "", ".stp"};
  const std::filesystem::path file = kNames[data[0] / 2 % 8];
  const treadmark::Body body = data[0] % 2 == 0 ? treadmark::Body::rail : treadmark::Body::wheel;
  const bool step = treadmark::io::is_step_file(file);
  if (step && !treadmark::io::is_cad_file(file)) __builtin_trap();
  try {
    const treadmark::io::cad::CadShape shape(std::make_unique<treadmark::fuzz::AnyAnswers>(data + 2, size - 2, data[1]),
                                             file, !step);
    treadmark::io::cad::running_surface(shape, body, 0.46, file);
  } catch (const treadmark::Error&) {
  }
  return 0;
}

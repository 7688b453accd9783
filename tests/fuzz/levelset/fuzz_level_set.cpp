// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/backends/levelset/read_level_set.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

/// Any bytes as a level set, and the surface that it makes, looked at once.
TREADMARK_FUZZ_TARGET(fuzz_level_set) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_level_set", ".vdb");
  try {
    treadmark::SolidShape shape;
    shape.solids.emplace_back().shape =
        treadmark::levelset::read_level_set(file.hold(treadmark::fuzz::as_text(data, size)), 1e-3);
    const auto rail = treadmark::levelset::make_level_set_surface(shape, treadmark::Body::rail, 0.0, "level-set");
    treadmark::height_at(*rail, {}, {0.0, 0.0});
  } catch (const treadmark::Error&) {
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/backends/levelset/read_level_set.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/any_answers.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

/// A level set of the program that holds OpenVDB gone mad, and the surface that it makes, looked at once.
TREADMARK_FUZZ_TARGET(fuzz_level_set) {
  static constexpr treadmark::offset::VdbWords kWords{"the distances", "write them again"};
  try {
    treadmark::offset::VdbFile vdb(std::make_unique<treadmark::fuzz::AnyAnswers>(data, size, size), "a.vdb", size,
                                   kWords);
    treadmark::SolidShape shape;
    shape.solids.emplace_back().shape = treadmark::levelset::read_level_set(std::move(vdb), "a.vdb", 1e-3);
    const auto rail = treadmark::levelset::make_level_set_surface(shape, treadmark::Body::rail, 0.0, "level-set");
    treadmark::height_at(*rail, {}, {0.0, 0.0});
  } catch (const treadmark::Error&) {
  }
  return 0;
}

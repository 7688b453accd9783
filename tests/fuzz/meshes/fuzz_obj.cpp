// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_mesh.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_obj) {
  treadmark::fuzz::parse_mesh(data, size, treadmark::io::meshes::parse_obj);
  return 0;
}

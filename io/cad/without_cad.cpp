// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cad/read_cad.hpp"

namespace treadmark::io {

CadSurface read_cad(const std::filesystem::path&, Body, double, const SourcePosition& asked_by) {
  throw Error(ErrorKind::configuration, left_out_message("cad", "files of CAD (.step, .iges)"), asked_by,
              left_out_advice("cad"));
}

void write_cad(const std::filesystem::path&, const CadContent&) { left_out("cad", "files of CAD (.step)"); }

}  // namespace treadmark::io

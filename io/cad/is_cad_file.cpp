// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/shape_extension.hpp"

namespace treadmark::io {

bool is_step_file(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".step" || extension == ".stp";
}

bool is_cad_file(const std::filesystem::path& file) { return can_hold(file, kCadFile); }

}  // namespace treadmark::io

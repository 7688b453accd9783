// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a file of settings and as one setting; what is read is written and reads back.
#include <cstdlib>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/io/imports/import_settings.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

TREADMARK_FUZZ_TARGET(fuzz_import_settings) {
  using namespace treadmark;
  static const fuzz::TemporaryFile file("fuzz_import_settings", ".toml");
  const std::string text(fuzz::as_text(data, size));
  io::ImportSettings settings;
  try {
    io::set_import_setting(settings, text);
  } catch (const Error&) {
  }
  settings = {};
  try {
    io::read_import_settings(file.hold(text), settings);
  } catch (const Error&) {
    return 0;
  }
  const std::string written = io::import_settings_toml(settings);
  io::ImportSettings again;
  io::read_import_settings(file.hold(written), again);  // an Error is a find
  if (io::import_settings_toml(again) != written) std::abort();
  return 0;
}

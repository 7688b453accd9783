// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/histories/store_names.hpp"
#include "treadmark/io/histories/study_store.hpp"

namespace treadmark::io {

StudyResult read_study_head(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  if (const std::string format = root.text("format"); format != kStudyFormat)
    throw Error(ErrorKind::input_data,
                fmt::format("the store of a study holds \"{}\" where \"{}\" is read", format, kStudyFormat),
                {path.string(), 0, 0}, "give a file that treadmark sweep wrote");
  StudyResult study;
  study.version = root.text("version");
  study.git = root.text("git");
  study.input_file = root.text("input");
  study.input_sha256 = root.text("sha256");
  study.title = root.text("title");
  study.settings = root.texts("settings");
  return study;
}

}  // namespace treadmark::io

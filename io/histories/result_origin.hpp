// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"

namespace treadmark::io {

/// What the stores of studies and of evolutions say at their top: format, and what the result comes from.
template <class Result>
std::vector<Attribute> origin_attributes(const char* format, const Result& result) {
  return {{"format", std::string(format)}, {"units", "SI"},
          {"version", result.version},     {"git", result.git},
          {"input", result.input_file},    {"sha256", result.input_sha256},
          {"title", result.title},         {"settings", result.settings}};
}

template <class Result>
void read_origin(const Hdf5GroupReader& root, Result& result) {
  result.version = root.text("version");
  result.git = root.text("git");
  result.input_file = root.text("input");
  result.input_sha256 = root.text("sha256");
  result.title = root.text("title");
  result.settings = root.texts("settings");
}

}  // namespace treadmark::io

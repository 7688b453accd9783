// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/model/origin.hpp"

namespace treadmark::io {

/// What stores say at their top: format, and what the result comes from, but its other files.
inline std::vector<Attribute> origin_attributes(const char* format, const Origin& origin) {
  return {{"format", std::string(format)}, {"units", "SI"},
          {"version", origin.version},     {"git", origin.git},
          {"input", origin.input_file},    {"sha256", origin.input_sha256},
          {"title", origin.title},         {"settings", origin.settings}};
}

/// With its other files, where they are named.
inline void read_origin(const Hdf5GroupReader& root, Origin& origin) {
  origin.version = root.text("version");
  origin.git = root.text("git");
  origin.input_file = root.text("input");
  origin.input_sha256 = root.text("sha256");
  if (root.has_attribute("title")) origin.title = root.text("title");
  origin.settings = root.texts("settings");
  if (!root.has_attribute("geometry_files")) return;
  const std::vector<std::string> files = root.texts("geometry_files"), hashes = root.texts("geometry_sha256");
  if (files.size() != hashes.size())
    throw Error(ErrorKind::input_data, "there is another number of geometry files than of their hashes",
                {root.file(), 0, 0});
  for (std::size_t i = 0; i < files.size(); ++i) origin.geometry_sha256.emplace_back(files[i], hashes[i]);
}

}  // namespace treadmark::io

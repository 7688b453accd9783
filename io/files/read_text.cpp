// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/read_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace treadmark::io::profiles {

namespace fs = std::filesystem;

fs::path portable_path(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

std::string read_text(const fs::path& file, const std::string& what, const SourcePosition& referenced_from) {
  const SourcePosition where = referenced_from.file.empty() ? SourcePosition{file.string(), 0, 0} : referenced_from;
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    std::string name = file.string();
    for (char& c : name)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    throw Error(ErrorKind::input_data, fmt::format("the {} file '{}' {}", what, name, why), where, advice);
  };

  std::error_code code;
  fs::path actual = file;
  if (!fs::exists(actual, code)) actual = portable_path(file.string());
  const fs::file_status status = fs::status(actual, code);
  if (status.type() == fs::file_type::not_found)
    refuse("does not exist", "names are relative to the folder of the file that mentions them");
  if (status.type() == fs::file_type::none) refuse("cannot be looked up: " + code.message(), "check its name");
  if (!fs::is_regular_file(status)) refuse("is not a regular file", "name a text file");
  const std::uintmax_t size = fs::file_size(actual, code);
  if (code) refuse("cannot be read: " + code.message(), "check its permissions");
  if (size > kMaxBytes) refuse("is larger than 1 GB", "thin out the points");

  std::ifstream stream(actual, std::ios::binary);
  if (!stream) refuse("cannot be opened", "check its permissions");
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.bad()) refuse("cannot be read to its end", "check the disk");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace treadmark::io::profiles

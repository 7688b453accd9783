// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/folder_files.hpp"

#include <iterator>

#include <fmt/format.h>

#include "treadmark/io/files/read_text.hpp"

namespace treadmark::app::report {

bool OptionalFiles::has(const std::string& file, const std::string& what) {
  std::error_code code;
  if (std::filesystem::is_regular_file(path(file), code)) return true;
  missing_.push_back(fmt::format("{} ({})", file, what));
  return false;
}

std::vector<Block> OptionalFiles::picture(const std::string& file, const std::string& id, const std::string& title,
                                          const std::string& note) {
  if (!has(file, "a picture")) return {};
  return {Figure{id, title, PictureView{io::profiles::read_text(path(file), "picture", {})}, note}};
}

std::string OptionalFiles::text(const std::string& file, const std::string& what) {
  return has(file, what) ? io::profiles::read_text(path(file), "text", {}) : std::string();
}

std::vector<Block> OptionalFiles::note() const {
  if (missing_.empty()) return {};
  std::string files;
  for (const std::string& file : missing_) files += (files.empty() ? "" : ", ") + file;
  return {Banner{Banner::Kind::note,
                 "Files that are not in the folder:", fmt::format("{}. The page shows what is left.", files)}};
}

void append(std::vector<Block>& to, std::vector<Block> blocks) {
  to.insert(to.end(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end()));
}

}  // namespace treadmark::app::report

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::io {
namespace {

constexpr const char* kPart = ".part";

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::configuration, fmt::format("cannot write {}: {}", path.string(), why), {},
              "choose another output path or make the folder writable");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  if (!target_.has_filename()) fail(target_, "not a file name");
  std::error_code error;
  if (target_.has_parent_path()) std::filesystem::create_directories(target_.parent_path(), error);
  if (error) fail(target_, error.message());
  if (std::filesystem::is_directory(target_, error)) fail(target_, "it is a folder");

  static std::atomic<unsigned> count{0};
  temporary_ = target_;
  temporary_.replace_filename(fmt::format(".{}{}{}-{}", target_.filename().string(), kPart, ::getpid(), count++));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail(target_, error.message());
  committed_ = true;
}

void remove_leftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.find(kPart) != std::string::npos) std::filesystem::remove(entry.path(), ignored);
  }
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail(path, "the file could not be opened or written to the end");
  file.commit();
}

}  // namespace treadmark::io

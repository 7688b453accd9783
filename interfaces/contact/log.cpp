// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/contact/log.hpp"

#include <cstdio>
#include <memory>
#include <mutex>

namespace treadmark::contact {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

struct Log {
  std::mutex mutex;
  std::unique_ptr<std::FILE, CloseFile> file;
  bool screen = false;
  int detail = 0;
};

Log& the_log() {
  static Log& one = *new Log;  // lives as long as threads that may still call
  return one;
}

}  // namespace

void open_log(const std::string& file, bool screen) {
  Log& l = the_log();
  bool opened = false;
  {
    const std::lock_guard lock(l.mutex);
    l.screen = screen;
    l.file.reset(std::fopen(file.c_str(), "w"));
    opened = l.file != nullptr;
  }
  if (!opened) warn("WARNING: cannot write the file " + file);
}

void close_log() {
  Log& l = the_log();
  const std::lock_guard lock(l.mutex);
  l.file.reset();
  l.screen = false;
  l.detail = 0;
}

void set_log_detail(int detail) {
  Log& l = the_log();
  const std::lock_guard lock(l.mutex);
  l.detail = detail;
}

void log(Detail detail, const std::string& line) noexcept {
  try {
    Log& l = the_log();
    const std::lock_guard lock(l.mutex);
    if (l.detail < static_cast<int>(detail)) return;
    for (std::FILE* out : {l.file.get(), l.screen ? stdout : nullptr})
      if (out != nullptr) {
        std::fprintf(out, "%s\n", line.c_str());
        std::fflush(out);
      }
  } catch (...) {
    // A log that cannot be written is no reason to fail.
  }
}

}  // namespace treadmark::contact

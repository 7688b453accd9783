// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/page_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <initializer_list>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/text.hpp"

extern "C" char** environ;

namespace treadmark::cli {
namespace {

namespace fs = std::filesystem;

/// The first of these programs on the path; empty: there is none.
fs::path on_path(std::initializer_list<const char*> names) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    for (const char* name : names)
      if (fs::path file = fs::path(folder) / name; !folder.empty() && ::access(file.c_str(), X_OK) == 0) return file;
  return {};
}

fs::path find_browser() { return on_path({"chromium", "chromium-browser", "google-chrome"}); }

/// A file's address (RFC 8089): what is neither a letter nor a digit is written by its code.
std::string url_of(const fs::path& file) {
  std::string out = "file://";
  for (const char c : file.string())
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("/-._~").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

bool is_print(const fs::path& file) { return io::extension_of(file) == ".pdf"; }

/// A program with its arguments, which reads and prints nothing; 0: it could not be started.
pid_t started(std::span<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  if (::posix_spawn(&process, arguments.front(), &quiet, nullptr, arguments.data(), environ) != 0) process = 0;
  posix_spawn_file_actions_destroy(&quiet);
  return process;
}

std::string printed(const fs::path& file, const std::string& html) {
  // Never committed: gone with this object.
  const OutputFolder stage(fs::absolute(file).parent_path(), OutputFolder::Old::kept);
  const fs::path page = stage.path() / "page.html", pdf = stage.path() / "page.pdf";
  write_file(page, html);
  // Root gets no sandbox from it.
  std::string words[] = {find_browser().string(),
                         "--headless",
                         "--disable-gpu",
                         "--no-pdf-header-footer",
                         "--virtual-time-budget=10000",
                         ::geteuid() == 0 ? "--no-sandbox" : "--disable-extensions",
                         "--print-to-pdf=" + pdf.string(),
                         url_of(page)};
  if (const pid_t process = started(words); process != 0)
    while (::waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
  std::string bytes = fs::exists(pdf) ? io::profiles::read_text(pdf, "PDF", {}) : "";
  if (!bytes.starts_with("%PDF"))
    throw Error(ErrorKind::input_data, words[0] + " made no PDF", {file.string()},
                "write the page as .html and print it from a browser");
  return bytes;
}

}  // namespace

void check_page_name(const fs::path& file) {
  const std::string ending = io::extension_of(file);
  if (is_print(file) && find_browser().empty())
    throw Error(ErrorKind::configuration, "a page becomes a PDF by Chromium, which is not installed", {file.string()},
                "install it, or write the page as .html and print it from a browser");
  constexpr std::string_view kOthers[] = {".png", ".svg", ".jpg", ".jpeg", ".docx", ".odt", ".xlsx", ".json", ".csv"};
  if (ranges::find(kOthers, ending) != std::end(kOthers))
    throw Error(ErrorKind::configuration, "a report is a page (.html) or its print (.pdf)", {file.string()},
                "name it so; single pictures are made by treadmark plot");
}

void write_page(const fs::path& file, const std::string& html) {
  write_file(file, is_print(file) ? printed(file, html) : html);
}

void open_page(const fs::path& file) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string words[] = {on_path({"xdg-open"}).string(), fs::absolute(file).string()};
  if (!words[0].empty()) started(words);
}

}  // namespace treadmark::cli

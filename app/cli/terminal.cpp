// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace treadmark::cli {
namespace {

std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "needed inside a signal handler");

extern "C" void on_interrupt(int signal_number) {
  interrupt_flag.store(true);
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupted() { return interrupt_flag; }
void catch_interrupt() {
  if (interrupt_flag.load()) return;  // the next Ctrl-C ends the program
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

ProgressLine::ProgressLine(bool quiet)
    : visible_(!quiet && isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()), last_(start_) {}

ProgressLine::~ProgressLine() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::update(std::size_t finished, std::size_t total, const std::string& what) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (!visible_ || (drawn_ && finished < total && now - last_ < 100ms)) return;
  last_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::string line = fmt::format("\r\x1b[K{}/{} ({:.0f} %) {}", finished, total,
                                 100.0 * static_cast<double>(finished) / static_cast<double>(total), what);
  if (finished > 0)
    line +=
        fmt::format(", {:.1f} s left", elapsed / static_cast<double>(finished) * static_cast<double>(total - finished));
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace treadmark::cli

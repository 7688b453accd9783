// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "treadmark/core/channel.hpp"

namespace treadmark {

/// The main function of a program that start_helper starts. version: of its build; serve(channel): what it does.
/// Ctrl-C is for the other end, and nothing goes on without it.
template <class Serve>
int serve_as_helper(int count, char** arguments, std::string_view version, Serve serve) {
  if (count != 2 || arguments[1] != version) return kOtherVersion;
  std::signal(SIGINT, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  try {
    SocketChannel channel(kHelperSocket);
    serve(channel);
  } catch (...) {  // the other end sees that this one is gone
    return 1;
  }
  return 0;
}

/// A file may ask for anything. memory: beyond what the program has now [bytes].
inline void bound_what_a_file_takes(std::uint64_t memory) {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr rlim_t kSeconds = 3600;
  const rlim_t most = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + memory;
  const rlimit space{most, most}, time{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_AS, &space);
  ::setrlimit(RLIMIT_CPU, &time);
}

}  // namespace treadmark

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/prctl.h>
#include <sys/resource.h>

#include <csignal>
#include <string_view>

#include "treadmark/core/channel.hpp"

namespace treadmark {

/// The main function of a program that start_helper starts. version: of its build; serve(channel): what it does.
/// Ctrl-C is for the other end, and nothing goes on without it.
template <class Serve>
int serve_as_helper(int count, char** arguments, std::string_view version, Serve serve) {
  if (count != 2 || arguments[1] != version) return 2;
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

/// A file may ask for anything.
inline void bound_what_a_file_takes() {
  constexpr rlim_t kMemory = 16ULL << 30, kSeconds = 3600;
  const rlimit memory{kMemory, kMemory}, time{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CPU, &time);
}

}  // namespace treadmark

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/channel.hpp"

namespace treadmark {

/// A program of its own for another library (core/helper_program.hpp): a file may break that library, and Treadmark
/// lives on.
struct Helper {
  const char* program;        ///< its name in one of module_folders()
  const char* library;        ///< that it holds, for people
  const char* needed_by;      ///< "files of CAD"
  const char* part;           ///< key of the part whose Debian package has it
  int longest_silence = 120;  ///< [s]; then the channel is Broken
};

/// A run of the program, which ends with the channel. Waiting for it is a check point (core/cancellation.hpp). file:
/// for messages. Errors: Error(configuration) naming the places where the program was looked for. Thread-safe, the
/// channel is for the thread that made it.
std::unique_ptr<Channel> start_helper(const Helper& helper, const std::string& file);

/// Calls talk(channel); ends the channel and throws fault() where it is broken. Ended, too, in the midst of an answer.
template <class Talk, class Fault>
auto talk_to(std::unique_ptr<Channel>& channel, Talk talk, Fault fault) {
  try {
    if (channel == nullptr) throw Broken{};
    return talk(*channel);
  } catch (const Cancelled&) {
    channel.reset();
    throw;
  } catch (const Broken&) {
    channel.reset();
    throw fault();
  }
}

}  // namespace treadmark

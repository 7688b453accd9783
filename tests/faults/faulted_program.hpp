// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/faults/shim/shim_memory.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// A program under the shim: its calls for files under a folder are counted, and one of them fails.
class FaultedProgram {
 public:
  /// under: absolute, without links. fault: as TREADMARK_FAULT of shim/fault_shim.cpp, empty: none. log: where the
  /// operations go, empty: nowhere. Tables are kept beside `under`, where nothing fails, so that they are made once.
  FaultedProgram(const std::filesystem::path& under, const std::vector<std::string>& arguments,
                 const std::string& fault = {}, const std::filesystem::path& log = {});
  ~FaultedProgram();
  FaultedProgram(const FaultedProgram&) = delete;
  FaultedProgram& operator=(const FaultedProgram&) = delete;

  RunningProgram& program() { return *program_; }
  ProgramResult wait() { return program_->wait(); }
  std::uint64_t calls(faults::Class cls) const { return counts_->calls[static_cast<std::size_t>(cls)].load(); }
  /// How many faults were injected so far.
  std::uint64_t fired() const { return counts_->fired.load(); }

 private:
  faults::Counts* counts_ = nullptr;
  TemporaryFolder folder_;
  std::unique_ptr<RunningProgram> program_;
};

/// Allocations from this size on count [bytes]: what grows with the input, not the odd bytes of libraries at their end.
inline constexpr int kLeastBytes = 256;

}  // namespace treadmark::testing

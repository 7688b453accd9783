// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/faults/faulted_program.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace treadmark::testing {
namespace {

faults::Counts* mapped(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0 || ftruncate(descriptor, sizeof(faults::Counts)) != 0)
    throw std::system_error(errno, std::generic_category(), file.string());
  void* shared = mmap(nullptr, sizeof(faults::Counts), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (shared == MAP_FAILED) throw std::system_error(errno, std::generic_category(), file.string());
  return static_cast<faults::Counts*>(shared);
}

}  // namespace

FaultedProgram::FaultedProgram(const std::filesystem::path& under, const std::vector<std::string>& arguments,
                               const std::string& fault, const std::filesystem::path& log) {
  const std::filesystem::path counts = folder_.path() / "counts";
  counts_ = mapped(counts);
  std::vector<std::string> command{"env",
                                   std::string("LD_PRELOAD=") + TREADMARK_FAULT_SHIM,
                                   "TREADMARK_FAULT_UNDER=" + under.string(),
                                   "TREADMARK_FAULT_COUNTS=" + counts.string(),
                                   "TREADMARK_FAULT_BYTES=" + std::to_string(kLeastBytes),
                                   "TREADMARK_FAULT_CLOCK=1",
                                   "TREADMARK_CACHE=" + (under.parent_path() / "cache").string()};
  if (!fault.empty()) command.push_back("TREADMARK_FAULT=" + fault);
  if (!log.empty()) {
    std::ofstream(log, std::ios::binary | std::ios::trunc).flush();
    command.push_back("TREADMARK_FAULT_LOG=" + log.string());
  }
  command.insert(command.end(), {"treadmark", "--quiet", "--threads", "1"});
  command.insert(command.end(), arguments.begin(), arguments.end());
  program_ = std::make_unique<RunningProgram>(command);
}

FaultedProgram::~FaultedProgram() {
  program_.reset();
  munmap(counts_, sizeof(faults::Counts));
}

}  // namespace treadmark::testing

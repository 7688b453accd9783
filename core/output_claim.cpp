// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/output_claim.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <deque>
#include <map>
#include <mutex>
#include <system_error>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

namespace fs = std::filesystem;

/// A file that an output would replace. It is held open: its number goes to no new file.
struct Claim {
  std::string output;
  int descriptor;
  dev_t device;
  ino_t number;
  std::string input;  ///< as which it was to be read; empty: as none
};

std::mutex claims_mutex;
std::deque<Claim> claims;

[[noreturn]] void refuse(const std::string& output, const std::string& input) {
  throw Error(ErrorKind::configuration, output + " would overwrite " + input, {},
              "give every output a name of its own");
}

/// Also of what is not there.
fs::path place_of(const std::string& name) {
  std::error_code failed;
  const fs::path whole = fs::absolute(name, failed).lexically_normal();
  const fs::path found = fs::weakly_canonical(whole, failed);
  return failed ? whole : found;
}

Claim* claim_of(const fs::path& file) {
  struct stat there {};
  if (claims.empty() || ::stat(file.c_str(), &there) != 0) return nullptr;
  for (Claim& claim : claims)
    if (claim.device == there.st_dev && claim.number == there.st_ino) return &claim;
  return nullptr;
}

}  // namespace

OutputClaim::OutputClaim(const std::vector<std::string>& outputs) {
  std::map<fs::path, std::string> taken;
  for (const std::string& output : outputs) {
    std::error_code unknown;
    if (output.empty() || output == "-" || fs::is_other(output, unknown)) continue;
    if (const auto [other, is_new] = taken.emplace(place_of(output), output); !is_new) refuse(output, other->second);
  }
  const std::lock_guard lock(claims_mutex);
  before_ = claims.size();
  for (const auto& [place, output] : taken) {
    const int descriptor = ::open(output.c_str(), O_PATH | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat there {};
    if (::fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode))
      claims.push_back({output, descriptor, there.st_dev, there.st_ino, {}});
    else
      ::close(descriptor);
  }
}

OutputClaim::~OutputClaim() {
  const std::lock_guard lock(claims_mutex);
  for (; claims.size() > before_; claims.pop_back()) ::close(claims.back().descriptor);
}

void refuse_output_as_input(const fs::path& input) {
  const std::lock_guard lock(claims_mutex);
  Claim* const claim = claim_of(input);
  if (claim == nullptr) return;
  claim->input = input.string();
  refuse(claim->output, claim->input);
}

void refuse_input_as_output(const fs::path& target) {
  const std::lock_guard lock(claims_mutex);
  if (const Claim* const claim = claim_of(target); claim != nullptr && !claim->input.empty())
    refuse(claim->output, claim->input);
}

}  // namespace treadmark

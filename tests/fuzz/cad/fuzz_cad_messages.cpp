// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <memory>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cad/cad_process.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

namespace treadmark::fuzz {
namespace {

/// A program that a file has broken: it answers whatever is asked with these bytes, and from some place on again and
/// again, so that few bytes answer all lines of a section.
class AnyAnswers final : public Channel {
 public:
  AnyAnswers(const std::uint8_t* data, std::size_t size, std::size_t again)
      : data_(data), size_(size), again_(again < size ? again : 0) {}

 protected:
  void put_bytes(const void*, std::size_t) override {}
  void take_bytes(void* data, std::size_t size) override {
    auto* out = static_cast<std::uint8_t*>(data);
    if (size > most_) throw Broken{};
    most_ -= size;
    for (std::size_t k = 0; k < size; ++k) {
      if (at_ == size_) at_ = again_;
      if (at_ == size_) throw Broken{};
      out[k] = data_[at_++];
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, again_, at_ = 0;
  std::size_t most_ = 400'000;
};

}  // namespace
}  // namespace treadmark::fuzz

// The first byte says what the name of the file ends in, and the body, the second one where answers begin again.
TREADMARK_FUZZ_TARGET(fuzz_cad_messages) {
  if (size < 2) return 0;
  constexpr const char* kNames[] = {"a.step", "a.STP", "a.igs", "a.iges", "a", "a.step.txt", "", ".stp"};
  const std::filesystem::path file = kNames[data[0] / 2 % 8];
  const treadmark::Body body = data[0] % 2 == 0 ? treadmark::Body::rail : treadmark::Body::wheel;
  const bool step = treadmark::io::is_step_file(file);
  if (step && !treadmark::io::is_cad_file(file)) __builtin_trap();
  try {
    const treadmark::io::cad::CadShape shape(std::make_unique<treadmark::fuzz::AnyAnswers>(data + 2, size - 2, data[1]),
                                             file, !step);
    treadmark::io::cad::running_surface(shape, body, 0.46, file);
  } catch (const treadmark::Error&) {
  }
  return 0;
}

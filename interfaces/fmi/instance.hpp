// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "treadmark/app/fmu/model.hpp"

namespace treadmark::fmi {

/// How a call ended, with the numbers of fmi2Status and fmi3Status.
enum class Outcome { ok, warning, discard, error, fatal };

/// States of an instance in which a call is allowed: a sum of them.
enum Mode : unsigned { kInstantiated = 1, kInitialization = 2, kStep = 4, kTerminated = 8 };
inline constexpr unsigned kAnyMode = kInstantiated | kInitialization | kStep | kTerminated;
inline constexpr unsigned kComputed = kInitialization | kStep | kTerminated;

/// Takes messages to the importer; category: of kCategories.
using Logger = std::function<void(Outcome outcome, const char* category, const char* message)>;

/// Thrown for what an importer can do wrong.
struct BadCall {
  std::string what;
};
void require(bool right, const char* what);

/// A copy of an instance's state.
struct SavedState {
  std::vector<std::byte> bytes;
};

/// One instance of an FMU: what both versions of the interface have in common. Calls may throw; see call().
class Instance {
 public:
  /// Null with a message where it cannot be made; never throws.
  static Instance* create(const char* token, const std::filesystem::path& resources, const Logger& logger,
                          bool tells_all);

  void log(Outcome outcome, const char* category, const std::string& message) const;
  void set_logging(bool on, std::span<const char* const> categories);

  Mode mode() const { return mode_; }
  double time() const { return time_; }
  const Model& model() const { return *model_; }

  void set_up(double start_time, const double* stop_time);
  void enter_initialization() { mode_ = kInitialization; }
  void exit_initialization();
  void terminate() { mode_ = kTerminated; }
  void reset();

  /// Arrays are asked for as a whole by the reference of their first element, or else each element by its own.
  enum class Arrays { whole, elements };
  std::vector<std::uint32_t> scalars(const std::uint32_t* references, std::size_t count, Arrays arrays) const;
  void get(std::span<const std::uint32_t> scalars, bool integers, double* out);
  void set(std::span<const std::uint32_t> scalars, bool integers, const double* values);
  void derivative(std::span<const std::uint32_t> outputs, std::span<const std::uint32_t> inputs,
                  std::span<const double> seed, double* out);

  /// To from + length.
  Outcome step(double from, double length);

  SavedState save() const;
  void restore(const SavedState& state);
  /// Whether bytes may be a state of this FMU; Error(input_data) if not.
  void check(std::span<const std::byte> bytes) const;

 private:
  Instance() = default;
  void compute_start();

  std::unique_ptr<Model> model_;
  std::string token_;
  Logger logger_;
  bool tells_all_ = false;
  Mode mode_ = kInstantiated;
  double time_ = 0.0;
  double stop_time_ = std::numeric_limits<double>::infinity();  ///< behind which there are no steps
  bool computed_ = false;                                       ///< outputs belong to the inputs
};

/// Runs the body of a call; what it throws becomes a message and an error. body: Instance& -> void or Outcome.
Outcome call(void* instance, const char* function, unsigned modes, Outcome (*body)(Instance&, void*),
             void* data) noexcept;

template <class Body>
Outcome call(void* instance, const char* function, unsigned modes, Body&& body) noexcept {
  return call(
      instance, function, modes,
      [](Instance& i, void* data) {
        auto& run = *static_cast<std::remove_reference_t<Body>*>(data);
        if constexpr (std::is_void_v<decltype(run(i))>) {
          run(i);
          return Outcome::ok;
        } else {
          return run(i);
        }
      },
      &body);
}

/// Bodies of calls that both versions have, on pointers to a state.
void get_state(Instance& instance, void** state);
void set_state(Instance& instance, const void* state);
void free_state(void** state);
void state_size(const void* state, std::size_t* size);
void serialize(const void* state, void* bytes, std::size_t size);
void deserialize(const Instance& instance, const void* bytes, std::size_t size, void** state);

}  // namespace treadmark::fmi

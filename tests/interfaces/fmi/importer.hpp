// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace treadmark::testing {

/// An unpacked FMU, and what its importer knows of it: the description alone.
struct UnpackedFmu {
  std::filesystem::path library, resources;
  std::string description;
  int version = 3;
  std::string attribute(const std::string& name) const;
};

/// Of the FMI standard.
enum Answer { kOk, kWarning, kDiscard, kError };

/// An instance of an FMU behind the official headers, by dlopen and dlsym; the same for both versions. Names,
/// references and types come from the description.
class Importer {
 public:
  struct Known {
    std::vector<std::uint32_t> references;  ///< FMI 2: of all elements; FMI 3: one
    std::size_t elements = 1;
    bool integer = false;
  };

  /// Null where it cannot be instantiated; token: another than that of the description.
  static std::unique_ptr<Importer> open(const UnpackedFmu& fmu, const char* token = nullptr,
                                        std::string* messages = nullptr);
  virtual ~Importer() = default;

  const std::map<std::string, Known>& variables() const { return variables_; }
  std::string& messages() { return *messages_; }

  int set(const std::string& name, double value);
  std::vector<double> get(const std::string& name);
  double number(const std::string& name) { return get(name).at(0); }
  int initialize(double start_time = 0.0, std::optional<double> stop_time = {});

  virtual int enter_initialization(double start_time, std::optional<double> stop_time = {}) = 0;
  virtual int exit_initialization() = 0;
  virtual int step(double from, double length) = 0;
  virtual int terminate() = 0;
  virtual int reset() = 0;
  virtual int set_reals(const std::vector<std::uint32_t>& references, const std::vector<double>& values) = 0;
  virtual int get_reals(const std::vector<std::uint32_t>& references, std::vector<double>& values) = 0;
  virtual int get_integers(const std::vector<std::uint32_t>& references, std::vector<int>& values) = 0;
  virtual int save(void** state) = 0;
  virtual int restore(void* state) = 0;
  virtual int free_state(void** state) = 0;
  virtual int to_bytes(void* state, std::string& bytes) = 0;
  virtual int from_bytes(const std::string& bytes, void** state) = 0;
  virtual int derivative(const std::vector<std::uint32_t>& unknowns, const std::vector<std::uint32_t>& knowns,
                         const std::vector<double>& seed, std::vector<double>& sensitivity) = 0;
  /// Answers to calls without an instance.
  virtual std::vector<int> without_instance() = 0;
  /// Answers to calls for what these FMUs do not have.
  virtual std::vector<int> for_nothing() = 0;

 protected:
  std::map<std::string, Known> variables_;
  std::string* messages_ = nullptr;
  std::string own_messages_;
};

}  // namespace treadmark::testing

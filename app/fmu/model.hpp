// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "treadmark/app/fmu/variables.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/report.hpp"

namespace treadmark::fmi {

/// What an FMU computes, whichever version of the interface asks. All calls may throw Error; after one, and after a
/// report that is not ok, the model is as it was before the call. Not thread-safe; several models may work at once.
class Model {
 public:
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Variables& variables() const { return variables_; }
  /// By value reference. Those of inputs and parameters are there to be set.
  std::vector<double>& values() { return values_; }

  /// Back to before the start, with the start values.
  void reset();
  /// Outputs at the start of time from the present inputs; may be repeated.
  virtual Report start(double time) = 0;
  /// Outputs at `to` from the present inputs.
  virtual Report step(double from, double to) = 0;

  /// Whether derivative() is there.
  virtual bool differentiable() const { return false; }
  /// Derivatives of outputs by inputs, times the seed, at the last start or step.
  virtual std::vector<double> derivative(std::span<const std::uint32_t> outputs, std::span<const std::uint32_t> inputs,
                                         std::span<const double> seed);
  /// The last instant that can be reached from a start at 0 [s]; infinity: there is none.
  virtual double end() const;
  /// A communication step that can be taken from the start values on [s].
  virtual double usual_step() const;

  void save(ByteWriter& out) const;
  /// Of a model of the same files. Errors: Error(input_data).
  void restore(ByteReader& in);

 protected:
  /// With the time as its first variable.
  Model();
  virtual void reset_state() = 0;
  virtual void save_state(ByteWriter& out) const = 0;
  virtual void restore_state(ByteReader& in) = 0;
  /// To be called once, after the variables have been added.
  void use_start_values();

  Variables variables_;
  std::vector<double> values_;  ///< that of the time is kept by the caller
};

/// Files within the folder `resources` of an FMU.
inline constexpr const char *kCaseFile = "case.toml", *kOverridesFile = "overrides.txt";

/// The model of a folder of resources: one or two cases of a wheel on a rail, or a simulation with its overrides, one a
/// line. Errors: those of reading, and Error(configuration) for what an FMU cannot be.
std::unique_ptr<Model> open_model(const std::filesystem::path& resources);

/// The same for each kind.
std::unique_ptr<Model> open_wheels(const std::filesystem::path& resources);
std::unique_ptr<Model> open_vehicle(const std::filesystem::path& resources);

/// The lines of kOverridesFile; none where there is no such file.
std::vector<std::string> read_overrides(const std::filesystem::path& resources);

/// Digest of version, names and contents of all files of a folder of resources: what description and model have in
/// common.
std::string token_of(const std::filesystem::path& resources);

}  // namespace treadmark::fmi

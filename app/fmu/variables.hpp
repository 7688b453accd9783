// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treadmark::fmi {

/// Kinds of messages to an importer.
struct Category {
  const char *name, *description;
};
inline constexpr Category kCategories[] = {
    {"logStatusError", "calls that failed, with the reason; always told"},
    {"logStatusDiscard", "steps that could not be computed, with the reason; always told"},
    {"logAll", "what is to be known of the FMU; with logging on"},
};

/// A variable of an FMU: one number, or an array of numbers. The table of them is all that descriptions, getters and
/// setters know of a model.
struct Variable {
  enum class Kind { time, parameter, tunable, input, output };
  std::string name;
  std::string unit;  ///< SI, "1": none
  std::string description;
  Kind kind = Kind::output;
  std::uint32_t size = 0;  ///< elements of an array; 0: a single number
  bool integer = false;
  double start = 0.0;   ///< of what can be set
  double change = 0.0;  ///< of an input: by which differences are taken for derivatives
  /// The wheel that it belongs to, -1: none or all of them. An output depends on the inputs of its wheel.
  int wheel = -1;
  /// Of its first element; those of the others follow. Every scalar has a number of its own, so that the same numbers
  /// serve for arrays and for scalars.
  std::uint32_t reference = 0;

  std::uint32_t elements() const { return size == 0 ? 1 : size; }
  bool settable() const { return kind != Kind::time && kind != Kind::output; }
};

/// Whether an output depends on an input.
bool depends(const Variable& output, const Variable& input);

/// The variables of an FMU in the order of their value references.
class Variables {
 public:
  /// Gives the variable its value reference and returns it.
  std::uint32_t add(Variable variable);
  std::span<const Variable> all() const { return all_; }
  std::size_t scalars() const { return owner_.size(); }
  /// The one that the scalar of this reference belongs to; null: there is none.
  const Variable* of(std::uint32_t reference) const;

 private:
  std::vector<Variable> all_;
  std::vector<std::size_t> owner_;  ///< by reference
};

}  // namespace treadmark::fmi

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/cases/case_derivatives.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/io/simulations/design_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::app {

/// What is sought: a number of the base, or a depth at a place. In a design it is a share of its range, 0 ... 1.
struct DesignVariable {
  std::string name;                          ///< with its unit
  double from = 0.0, to = 0.0, given = 0.0;  ///< in that unit; given: where the search starts
  double best = kNaN;                        ///< what was found
  bool surfaces = false;                     ///< it changes surfaces, whose heights are differenced
};

/// A number that a design is judged by.
struct DesignNumber {
  double value = kNaN;     ///< in the unit of its quantity; NaN: there is none, as of a patch that is not there
  double weight = 0.0;     ///< in a mean
  std::vector<double> by;  ///< each variable, over its whole range
};
/// Of each quantity a list that is as long for every design.
using DesignNumbers = std::vector<std::vector<DesignNumber>>;

/// The positions of a design with all that its numbers follow from. Not thread-safe, and must not be moved.
class DesignCases {
 public:
  /// Errors: those of readers and surfaces; Error(configuration) for positions that are no single instants of a wheel
  /// on a rail, that have different surfaces of the body that changes or different values of what is sought, for
  /// quantities that there are not and values that the keys do not take.
  explicit DesignCases(const io::DesignFile& file);
  DesignCases(const DesignCases&) = delete;
  DesignCases& operator=(const DesignCases&) = delete;

  const std::vector<DesignVariable>& variables() const { return variables_; }
  /// Cases that are solved for a design; 0: its numbers need no contact.
  std::size_t solutions() const { return contact_ ? cases_.cases.size() : 0; }

  /// Place of a quantity among the numbers of a design. Every one of the file has one.
  std::size_t place_of(const io::DesignedQuantity& quantity) const;
  std::size_t quantities() const { return quantities_.size(); }
  /// Of a number, for people: "pmax_MPa", and where it is: "y = 2, patch 1".
  std::string name_of(std::size_t quantity) const { return quantities_[quantity].name; }
  std::string where_of(std::size_t quantity, std::size_t number) const;
  /// Whether results of cases have it; else it is of the depth.
  bool in_results(std::size_t quantity) const {
    return quantities_[quantity].kind == Kind::contact || quantities_[quantity].kind == Kind::conicity;
  }

  /// Numbers of a design with their derivatives. May be cancelled. Errors: Error where a position has no solution, or
  /// a number no derivative.
  DesignNumbers at(const std::vector<double>& design);

  /// The positions as the base gives them.
  const io::CaseFile& given() const { return cases_; }
  /// Those of a design, over the changed surface as a file, which is written into the folder: rail.csv or wheel.csv, of
  /// what is not one profile rail.slcs (about the positions) or wheel.slcw. Errors: those of writers.
  io::CaseFile written(const std::vector<double>& design, const std::filesystem::path& folder);
  /// Numbers of cases that were solved, without derivatives; none of the depth.
  DesignNumbers of_results(const io::CaseFile& file, const io::RunResult& run) const;

  /// Depth at each place of a design [m]; empty: none is sought.
  std::vector<double> depths(const std::vector<double>& design) const;

 private:
  enum class Kind { contact, conicity, removed, bend, convexity };
  struct Asked {
    std::string name;
    std::vector<double> amplitudes;
    Kind kind = Kind::contact;
    bool of_patches = false;
  };
  /// The first of positions that have the same bodies, and the weight of all of them.
  struct BodyPair {
    std::size_t position = 0;
    double weight = 0.0;
  };

  void read_positions();
  void find_variables();
  void find_quantities();
  void find_surfaces();
  Asked asked(const io::DesignedQuantity& quantity) const;

  const io::SurfaceSource& source_of(const io::Case& c) const;
  io::Case case_of(std::size_t position, const std::vector<double>& design) const;
  /// The first place where the depth bends: level ends bend it themselves.
  std::size_t first_bent() const { return file_.depth->level_ends ? 1 : 0; }
  /// With places beyond the ends.
  std::vector<double> padded(std::vector<double> depths) const;
  /// Of padded depths.
  SectionHeights heights(std::vector<double> depths) const;
  std::optional<SectionHeights> heights_of(const std::vector<double>& design) const;
  /// Without depths, and with them.
  wheelrail::Geometry given_geometry(std::size_t position, const std::vector<double>& design);
  wheelrail::Geometry geometry(std::size_t position, const std::vector<double>& design);

  void add_contact(const std::vector<double>& design, DesignNumbers& out);
  void add_conicity(const std::vector<double>& design, std::size_t quantity, std::vector<DesignNumber>& out);
  void add_depth(const std::vector<double>& design, Kind kind, std::vector<DesignNumber>& out) const;
  /// Of a quantity of a position, from what is known of its case.
  void take_contact(const Asked& asked, std::size_t position, const std::vector<io::CaseDerivatives::Number>& known,
                    std::vector<DesignNumber>& out) const;

  const io::DesignFile& file_;
  io::CaseFile cases_;               ///< of all positions
  std::vector<std::string> labels_;  ///< of each
  std::vector<double> weights_;      ///< of each, sum 1
  SampledRegions regions_;
  std::vector<std::string> keys_;
  std::vector<DesignVariable> variables_;    ///< those by keys, then those of places
  std::vector<std::size_t> places_;          ///< of the depths that are variables
  std::vector<std::vector<double>> ranges_;  ///< padded depths that each of these makes over its range
  std::vector<SectionHeights> by_place_;     ///< the same as heights
  std::vector<Asked> quantities_;
  bool contact_ = false;
  bool remakes_ = false;  ///< a key changes surfaces, of which the store holds those of one design
  std::vector<BodyPair> pairs_;
  std::vector<double> convexity_;  ///< of the given profile at each place [1/m]
  std::optional<SurfaceStore> store_;
};

}  // namespace treadmark::app

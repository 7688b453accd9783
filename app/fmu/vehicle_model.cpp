// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "treadmark/app/fmu/model.hpp"
#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

namespace treadmark::fmi {
namespace {

vehicle::SystemState equilibrium_of(const app::BuiltVehicle& built) {
  const vehicle::Equilibrium found = vehicle::find_equilibrium(built.vehicle, {}, built.easy ? &*built.easy : nullptr);
  if (found.report.status != Status::ok)
    throw Error(ErrorKind::numerical, found.report.message, {}, vehicle::kNoEquilibriumAdvice);
  for (const auto& chosen : built.chosen) chosen->begin();
  return found.state;
}

/// Two instants count as one [s]; rounding of sums of communication steps lies far below, steps far above.
constexpr double kSameInstant = 1e-12;

/// A vehicle on its track. It takes its own steps, whatever the communication steps are: outputs between two of its
/// instants lie on straight lines.
class VehicleModel final : public Model {
 public:
  explicit VehicleModel(const std::filesystem::path& resources)
      : file_(io::read_simulation_file(resources / kCaseFile, read_overrides(resources))),
        tables_(io::ContentCache::from_environment()),
        built_(app::build_vehicle(file_, store_, &tables_)),
        simulation_(built_.vehicle, equilibrium_of(built_), app::integration_settings(file_)),
        record_(file_, simulation_) {
    for (const io::HistoryColumn& column : record_.columns()) {
      Variable output;
      output.name = column.name;
      output.unit = column.unit;
      output.description = column.description;
      first_ = std::min(first_, variables_.add(std::move(output)));
    }
    use_start_values();
    record_.append(present_);
    last_ = present_;
    ByteWriter out;
    save_state(out);
    at_start_ = out.bytes();
  }

  Report start(double time) override {
    reset_state();
    start_ = time;
    put(0.0);
    return {};
  }

  Report step(double, double to) override {
    const double time = to - start_;
    if (time > end() * (1.0 + kSameInstant) + kSameInstant)
      throw Error(ErrorKind::numerical, fmt::format("the simulation ends {:.9g} s after its start", end()), {},
                  "make the FMU of a longer one (simulation.distance_m)");
    ByteWriter before;
    save_state(before);
    try {
      while (present_.front() < time - kSameInstant && !simulation_.finished()) {
        simulation_.advance();
        last_ = present_;
        present_.clear();
        record_.append(present_);
      }
      if (!simulation_.derailed().empty()) throw Error(ErrorKind::numerical, "derailed: " + simulation_.derailed());
    } catch (...) {
      ByteReader in(before.bytes());
      restore_state(in);
      throw;
    }
    put(time);
    return {};
  }

  double end() const override { return file_.settings.duration; }

 protected:
  void reset_state() override {
    ByteReader in(at_start_);
    restore_state(in);
  }

  void save_state(ByteWriter& out) const override {
    out.put(start_);
    out.put(last_);
    out.put(present_);
    simulation_.save(out);
  }

  void restore_state(ByteReader& in) override {
    const double start = in.get<double>();
    std::vector<double> last, present;
    in.get(last);
    in.get(present);
    if (last.size() != present_.size() || present.size() != present_.size())
      refuse_saved_state("it has another number of columns");
    simulation_.restore(in);
    start_ = start, last_ = std::move(last), present_ = std::move(present);
  }

 private:
  /// Outputs at a time since the start, between the last two instants.
  void put(double time) {
    const double from = last_.front(), to = present_.front();
    const bool there = to - from < kSameInstant || to - time < kSameInstant;
    const double share = there ? 1.0 : (time - from) / (to - from);
    for (std::size_t i = 0; i < present_.size(); ++i)
      values_[first_ + i] = there ? present_[i] : last_[i] + share * (present_[i] - last_[i]);
  }

  io::SimulationFile file_;
  app::SurfaceStore store_;
  app::ContactTables tables_;
  app::BuiltVehicle built_;
  vehicle::Simulation simulation_;
  app::HistoryRecord record_;
  std::vector<double> last_, present_;  ///< columns of the record, the time first, at the last two own instants
  std::vector<std::byte> at_start_;
  double start_ = 0.0;  ///< time of the simulation's start [s]
  std::uint32_t first_ = std::numeric_limits<std::uint32_t>::max();
};

}  // namespace

std::unique_ptr<Model> open_vehicle(const std::filesystem::path& resources) {
  return std::make_unique<VehicleModel>(resources);
}

}  // namespace treadmark::fmi

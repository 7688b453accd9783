// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/model/vehicle/train.hpp"

namespace treadmark::io {

namespace {

TrainPart read_part(const CaseValue& one, const std::string& path) {
  using C = CouplerSpec;
  const TableOf table(one, path, train_keys());
  TrainPart part = table.read();
  part.coupler.where = one.where;
  if (part.between.size() != 2)
    table.refuse(&TrainPart::between,
                 fmt::format("{} needs two bodies, [before, this]", table.path_of(&TrainPart::between)));
  const auto of = [](auto C::*member) {
    return [member](auto& t) -> auto& { return t.coupler.*member; };
  };
  const auto check_curve = [&](std::vector<double> C::*list) {
    const std::vector<double>& values = part.coupler.*list;
    const bool rises = std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
    if (values.size() < 2 || values.front() != 0.0 || !rises)
      table.refuse(of(list), fmt::format("{} must increase from 0", table.path_of(of(list))));
  };
  check_curve(&C::travel);
  check_curve(&C::force);
  if (part.coupler.travel.size() != part.coupler.force.size())
    table.refuse(of(&C::force), fmt::format("{} has {} values for {} travels", table.path_of(of(&C::force)),
                                            part.coupler.force.size(), part.coupler.travel.size()));
  if (part.coupler.friction > 0.0) table.need(of(&C::friction_stiffness));
  table.go_with(of(&C::friction_stiffness), of(&C::friction));
  return part;
}

/// A vehicle and where its x = 0 stands in a train [m].
struct Placed {
  const VehicleModel& vehicle;
  double at = 0.0;

  double x_of(const std::string& body) const {
    return at + ranges::find(vehicle.bodies, body, &BodySpec::name)->position.x();
  }
  /// The wheelset that is ahead of the others, or behind them.
  double end(bool front) const {
    std::vector<double> x;
    for (const WheelsetSpec& w : vehicle.wheelsets) x.push_back(x_of(w.body));
    return front ? *ranges::max_element(x) : *ranges::min_element(x);
  }
};

/// Vehicles stand one behind the other, with the coupler between what it couples.
void check_places(const TableOf<TrainPart>& table, const TrainPart& part, const Placed& before, const Placed& next) {
  const double apart = before.end(false) - next.end(true);
  const double wheels = before.vehicle.wheelsets.front().nominal_radius + next.vehicle.wheelsets.front().nominal_radius;
  if (!(apart > wheels))
    table.refuse(&TrainPart::behind,
                 fmt::format("{} = {:.6g} puts vehicles into each other: the foremost wheelset of the one is {:.4g} m "
                             "{} the last one of the vehicle before",
                             table.path_of(&TrainPart::behind), part.behind, std::abs(apart),
                             apart < 0.0 ? "ahead of" : "behind"),
                 "it is from x = 0 of the one to x = 0 of the other: the length over couplers");
  const auto position = [](auto& t) -> auto& { return t.coupler.position; };
  constexpr double kRounding = 1e-9;
  const double front = before.x_of(part.between[0]) - before.at, rear = next.x_of(part.between[1]) - before.at,
               x = part.coupler.position.x();
  if (!(x <= front + kRounding && x >= rear - kRounding))
    table.refuse(
        position,
        fmt::format("{}: the coupler acts at x = {:.6g} m of the vehicle before, not between the bodies that it "
                    "couples, whose centres of mass are at {:.6g} and {:.6g} m",
                    table.path_of(position), x, front, rear),
        "it stands at the rear end of the vehicle before, whose coordinates count");
}

}  // namespace

void read_train(const SimulationTable& simulation, const std::filesystem::path& folder, SimulationFile& out) {
  const VehicleModel leading = out.vehicle;
  VehicleModel before = leading;
  double place = 0.0;  // of x = 0 of the last vehicle
  const auto list = &SimulationFile::train;
  for (const CaseValue* one : simulation.tables(list)) {
    const std::string path = simulation.path_of(list);
    TrainPart part = read_part(*one, path);
    const TableOf table(*one, path, train_keys());
    VehicleModel vehicle = leading;
    if (table.find(&TrainPart::file) != nullptr) {
      const FileText text = named_text(table, table.key(&TrainPart::file), folder);
      vehicle = parse_vehicle_text(text.text, text.file.path.string());
      part.file = text.file;
    }
    if (vehicle_count(out.vehicle) + part.count > kLongestTrain)
      table.fail(fmt::format("a train of more than {} vehicles", kLongestTrain));
    for (int i = 0; i < part.count; ++i) {
      const int number = vehicle_count(out.vehicle);
      check_name(path + ".between: the body of the vehicle before", part.between[0], names_of(before.bodies),
                 table.need(&TrainPart::between).list()[0].where);
      check_name(path + ".between: the body", part.between[1], names_of(vehicle.bodies),
                 table.need(&TrainPart::between).list()[1].where);
      check_places(table, part, {before, place}, {vehicle, place - part.behind});
      CouplerSpec coupler = part.coupler;
      coupler.name = fmt::format("{}", number);
      coupler.front = vehicle_prefix(number - 1) + part.between[0];
      coupler.rear = vehicle_prefix(number) + part.between[1];
      coupler.position.x() += place;
      place -= part.behind;
      append_vehicle(out.vehicle, vehicle, place);
      out.vehicle.couplers.push_back(std::move(coupler));
      before = vehicle;
    }
    out.train.push_back(std::move(part));
  }
  if (out.train.empty()) return;
  // Coupled bodies move along the track, also where their file lets them travel at the vehicle's speed.
  for (const CouplerSpec& coupler : out.vehicle.couplers)
    for (const std::string& name : {coupler.rear, coupler.front})
      ranges::find(out.vehicle.bodies, name, &BodySpec::name)->free.front() = true;
  check_held(out.vehicle);
}

}  // namespace treadmark::io

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/table/force_tables.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

io::KeyTable<TableRequest> list_table_keys() {
  using R = TableRequest;
  using A = vehicle::ContactTableOptions;
  using T = vehicle::TableAngles;
  using C = vehicle::TableCheckOptions;
  const auto axis = [](auto A::*member) { return [member](R& r) -> decltype(auto) { return (r.axes.*member); }; };
  const auto angles = [](T A::*which, auto T::*member) {
    return [which, member](R& r) -> decltype(auto) { return (r.axes.*which.*member); };
  };
  const auto check = [](auto C::*member) { return [member](R& r) -> decltype(auto) { return (r.check.*member); }; };
  io::KeyRows<R> keys;
  keys.number("lateral_range_mm", {{}, 0.1, 50.0},
              "Of the wheel against the rail, to both sides of its central position", axis(&A::lateral_range));
  keys.number("step_mm", {{}, 0.01, 5.0}, "Between lateral places; finer where the contact angle changes fast",
              axis(&A::step));
  keys.number("element_mm", {{}, 0.02, 5.0}, "Elements of the problems that are solved for the table",
              axis(&A::element_size));
  keys.number("load_kN", {{}, 1e-3, 1e4}, "Vertical load; the table reaches from nothing to two and a half times of it",
              &R::load);
  keys.number("roll_mrad", {{}, 0.01, 200.0}, "Rolls of the wheel against the rail, to both sides",
              angles(&A::roll, &T::most));
  keys.integer("roll_intervals", 0, 64, "Between them; 0: to first order about an upright wheel, up to 200 mrad",
               angles(&A::roll, &T::intervals));
  keys.number("yaw_mrad", {{}, 0.01, 200.0}, "Yaws of the wheelset, to both sides", angles(&A::yaw, &T::most));
  keys.integer("yaw_intervals", 0, 64, "Between none and the greatest; 0: up to 200 mrad, without a part in heights",
               angles(&A::yaw, &T::intervals));
  keys.choice("creep_forces", {{"exact_table", true}, {"linear", false}},
              "exact_table: of the exact theory over ellipses; linear: Kalker's coefficients with saturation",
              &R::exact_creep);
  keys.integer("check_points", 1, 1000000, "At which the table is compared with the exact theory", check(&C::points));
  keys.integer("seed", 0, 1e9, "Of the places of these points", check(&C::seed));
  keys.number("check_speed_m_s", io::kPositive, "Speed at these points", check(&C::speed));
  keys.number("check_creepage", {{}, 1e-6, 0.5}, "Greatest creepage at these points, longitudinal and lateral",
              check(&C::creepage));
  return std::move(keys).done();
}

}  // namespace

const io::KeyTable<TableRequest>& table_keys() {
  static const io::KeyTable<TableRequest> keys = list_table_keys();
  return keys;
}

TableRequest table_request(const io::GivenSettings& given) {
  TableRequest request;
  io::set_given(request, table_keys(), given);
  if (request.axes.roll.intervals == 1)
    throw Error(ErrorKind::configuration, "roll_intervals must be 0, or 2 and more", {},
                "they lie to both sides of an upright wheel");
  return request;
}

}  // namespace treadmark::app

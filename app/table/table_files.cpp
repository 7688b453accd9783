// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/table/force_tables.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"

namespace treadmark::app {
namespace {

using vehicle::CreepTable;
using vehicle::CreepTableOptions;
using vehicle::TableCheck;
using vehicle::TableError;

constexpr const char* kFormat = "treadmark force table 1";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(ErrorKind::input_data, what, {file.string(), 0, 0}, "make it with: treadmark table CASE -o FILE");
}

std::string case_text(const MadeTable& made) {
  io::CaseFile file;
  file.title = made.title;
  file.cases.push_back(made.given);
  return io::case_file_text(file, {});
}

/// The axes of a table of creep forces, whole numbers but the last.
constexpr const char* kCreepCounts[] = {"intervals", "ratio_intervals", "nx", "ny"};
std::vector<int> counts_of(const CreepTableOptions& o) { return {o.intervals, o.ratio_intervals, o.nx, o.ny}; }

struct StoredCreep {
  double poisson = 0.0, greatest_ratio = 0.0;
  std::vector<int> counts;
  std::vector<double> values, slopes;
};

/// What a file holds.
struct Stored {
  std::string text;
  TableHead head;
  std::vector<TableNode> nodes;
  std::optional<TableCheck> check;
  std::optional<StoredCreep> creep;
  std::string sha256 = {};  ///< that the file says of itself
};

Stored stored_of(const MadeTable& made) {
  Stored stored{case_text(made), made.head, made.nodes, made.table.check(), {}};
  if (const auto& creep = made.table.creep())
    stored.creep = {creep->poisson(), creep->options().greatest_ratio, counts_of(creep->options()), creep->values(),
                    creep->slopes()};
  return stored;
}

/// Of all that counts, however it is written: any bit of it that changes makes another one.
std::string digest_of(const Stored& stored) {
  ByteWriter out;
  // -0 and 0 are one number, which text may not tell apart.
  const auto put = [&out](double value) { out.put(value + 0.0); };
  const auto put_all = [&](const std::vector<double>& values) {
    out.put(values.size());
    ranges::for_each(values, put);
  };
  const auto put_row = [&]<class Row>(const Row& row) {
    for (const Column<Row>& column : columns<Row>())
      column.access.word != nullptr ? out.put(column.access.word(row)) : put(column.access.get(row));
  };
  out.put(stored.text);
  put_row(stored.head);
  out.put(stored.nodes.size());
  ranges::for_each(stored.nodes, put_row);
  out.put(stored.check.has_value());
  if (stored.check) {
    put_row(*stored.check);
    out.put(stored.check->errors.size());
    ranges::for_each(stored.check->errors, put_row);
  }
  out.put(stored.creep.has_value());
  if (stored.creep) {
    put(stored.creep->poisson), put(stored.creep->greatest_ratio);
    out.put(std::span<const int>(stored.creep->counts));
    put_all(stored.creep->values), put_all(stored.creep->slopes);
  }
  return io::sha256_hex({reinterpret_cast<const char*>(out.bytes().data()), out.bytes().size()});
}

std::shared_ptr<const CreepTable> creep_of(StoredCreep from) {
  CreepTableOptions o;
  o.intervals = from.counts[0], o.ratio_intervals = from.counts[1], o.nx = from.counts[2], o.ny = from.counts[3];
  o.greatest_ratio = from.greatest_ratio;
  return std::make_shared<const CreepTable>(from.poisson, o, std::move(from.values), std::move(from.slopes));
}

/// Nodes stand in the order of the sheets, columns, loads and parts.
std::vector<vehicle::ContactTableColumns> sheets_of(const std::filesystem::path& file,
                                                    const std::vector<TableNode>& nodes,
                                                    const std::vector<vehicle::TableTurn>& turns,
                                                    const std::vector<double>& loads) {
  std::vector<vehicle::ContactTableColumns> sheets;
  const TableNode* before = nullptr;
  for (const TableNode& node : nodes) {
    if (!before || node.roll != before->roll || node.yaw != before->yaw) {
      const std::size_t sheet = sheets.size();
      if (sheet == turns.size() || node.roll != turns[sheet].roll || node.yaw != turns[sheet].yaw)
        refuse(file, "this table of forces has nodes at other rolls and yaws than its head says");
      sheets.emplace_back();
    }
    vehicle::ContactTableColumns& columns = sheets.back();
    if (columns.empty() || node.y != columns.back().y) columns.push_back({node.y, {}});
    auto& under = columns.back().under;
    if (under.empty() || node.load != before->load) {
      if (under.size() == loads.size() || node.load != loads[under.size()])
        refuse(file, "this table of forces has other loads from place to place");
      under.push_back(node.contact);
    }
    under.back().parts.push_back(node.part);
    before = &node;
  }
  return sheets;
}

std::vector<double> loads_of(const std::vector<TableNode>& nodes) {
  std::vector<double> loads;
  for (const TableNode& node : nodes) {
    if (!loads.empty() && node.load < loads.back()) break;
    if (loads.empty() || node.load > loads.back()) loads.push_back(node.load);
  }
  return loads;
}

MadeTable made_of(const std::filesystem::path& file, Stored stored) {
  const io::CaseTable document = io::parse_toml(stored.text, file.string());
  if (ranges::any_of(document, [](const io::CaseEntry& entry) { return entry.key == "cases_file"; }))
    refuse(file, "this table of forces names another file with its case");
  const io::CaseFile cases = io::case_file_of(document, file);
  if (cases.cases.size() != 1 || !std::holds_alternative<io::WheelRailCase>(cases.cases.front().content))
    refuse(file, "this table of forces holds no case of a wheel on a rail");
  const io::Case& given = cases.cases.front();
  const auto& pair = std::get<io::WheelRailCase>(given.content);
  const TableHead& h = stored.head;
  for (const Column<TableHead>& column : columns<TableHead>())
    if (column.access.get != nullptr && !std::isfinite(column.access.get(h)))
      refuse(file, fmt::format("this table of forces has no {}", column.key));
  if (!(h.load > 0.0) || !(h.element_size > 0.0))
    refuse(file, "this table of forces has no load, or elements of no size");
  if (stored.check) vehicle::require_whole(*stored.check);
  wheelrail::Problem problem = to_problem(pair, true);
  problem.side = wheelrail::Side::right;
  vehicle::ContactTableOptions axes;
  axes.element_size = h.element_size;
  wheelrail::Placement nominal;
  nominal.X_TR = {{0.0, h.rail_y, h.rail_z}, rotation_x(h.rail_roll)};
  nominal.X_TWs.origin = {0.0, 0.0, h.wheelset_z};
  nominal.X_TW.origin = {0.0, h.wheel_y, h.wheel_z};
  const std::vector<double> loads = loads_of(stored.nodes);
  if (loads.empty()) refuse(file, "this table of forces holds no nodes");
  const auto nearest = ranges::min_element(loads, {}, [&](double load) { return std::abs(load / h.load - 1.0); });
  const vehicle::TableAngles roll{h.roll_most, h.roll_intervals}, yaw{h.yaw_most, h.yaw_intervals};
  auto contact = std::make_shared<const vehicle::ContactTable>(
      sheets_of(file, stored.nodes, vehicle::table_turns(roll, yaw), loads),
      vehicle::ContactTable::Loads{loads, {}, static_cast<std::size_t>(nearest - loads.begin())},
      vehicle::table_problem(problem, axes), nominal, roll, yaw);
  MadeTable made{
      cases.title, given, h, std::move(stored.nodes),
      vehicle::ForceTable(std::move(contact), pair.side, stored.creep ? creep_of(*std::move(stored.creep)) : nullptr)};
  if (stored.check) made.table.keep(*std::move(stored.check));
  return made;
}

void write_hdf5(const std::filesystem::path& file, const Stored& stored) {
  io::Hdf5Writer out(file);
  const io::Hdf5GroupWriter& root = out.root();
  root.add({"format", std::string(kFormat)});
  root.add({"units", std::string("SI")});
  root.add({"version", std::string(version())});
  root.add({"sha256", digest_of(stored)});
  root.add({"case", stored.text});
  io::write_attributes(root.make_group("head"), stored.head);
  io::write_rows(root.make_group("nodes"), stored.nodes);
  if (const auto& check = stored.check) {
    const io::Hdf5GroupWriter group = root.make_group("check");
    io::write_attributes(group, *check);
    io::write_rows(group.make_group("errors"), check->errors);
  }
  if (const auto& creep = stored.creep) {
    const io::Hdf5GroupWriter group = root.make_group("creep");
    for (std::size_t i = 0; i < creep->counts.size(); ++i) group.add({kCreepCounts[i], creep->counts[i]});
    group.add({"poisson", creep->poisson});
    group.add({"greatest_ratio", creep->greatest_ratio});
    group.write({"values", {creep->values.size()}, "1", "F_x, F_y, M_n over the friction bound", true}, creep->values);
    group.write({"slopes", {creep->slopes.size()}, "1", "without creepage"}, creep->slopes);
  }
  out.commit();
}

Stored read_hdf5(const std::filesystem::path& file) {
  const io::Hdf5Reader in(file);
  const io::Hdf5GroupReader& root = in.root();
  if (!root.has_attribute("format") || root.text("format") != kFormat) refuse(file, "this is no table of forces");
  Stored stored;
  stored.sha256 = root.text("sha256");
  stored.text = root.text("case");
  io::read_attributes(root.open_group("head"), stored.head);
  stored.nodes = io::read_rows<TableNode>(root.open_group("nodes"));
  if (root.has("check")) {
    TableCheck& check = stored.check.emplace();
    io::read_attributes(root.open_group("check"), check);
    check.errors = io::read_rows<TableError>(root.open_group("check").open_group("errors"));
  }
  if (root.has("creep")) {
    const io::Hdf5GroupReader group = root.open_group("creep");
    std::vector<int> counts;
    for (const char* name : kCreepCounts) counts.push_back(group.integer(name));
    stored.creep = {group.number("poisson"), group.number("greatest_ratio"), std::move(counts), group.numbers("values"),
                    group.numbers("slopes")};
  }
  return stored;
}

std::string json_file(const Stored& stored) {
  io::Json out;
  out["format"] = kFormat;
  out["version"] = std::string(version());
  out["sha256"] = digest_of(stored);
  out["case"] = stored.text;
  out["head"] = io::json_of(stored.head, Digits::all);
  if (const auto& check = stored.check) {
    out["check"] = io::json_of(*check, Digits::all);
    out["check"]["errors"] = io::json_of(check->errors, Digits::all);
  }
  io::add_lists(out["nodes"], stored.nodes, Digits::all);
  if (const auto& creep = stored.creep) {
    io::Json& to = out["creep"];
    for (std::size_t i = 0; i < creep->counts.size(); ++i) to[kCreepCounts[i]] = creep->counts[i];
    to["poisson"] = creep->poisson;
    to["greatest_ratio"] = creep->greatest_ratio;
    to["values"] = io::numbers(creep->values, Digits::all);
    to["slopes"] = io::numbers(creep->slopes, Digits::all);
  }
  return io::dumped(out, -1) + '\n';
}

std::vector<TableNode> nodes_of(const io::JsonTree& lists) {
  std::vector<TableNode> nodes;
  for (const Column<TableNode>& column : columns<TableNode>()) {
    const std::vector<double> values = lists.at(column.key).numbers();
    if (&column == columns<TableNode>().data()) nodes.resize(values.size());
    if (values.size() != nodes.size()) lists.refuse("its lists differ in length");
    for (std::size_t i = 0; i < nodes.size(); ++i) column.access.put(nodes[i], values[i] / column.unit.per_si);
  }
  return nodes;
}

Stored read_json_table(const std::filesystem::path& file) {
  const io::JsonTree in = io::read_json_file(file);
  if (!in.has("format") || in.text("format") != kFormat) refuse(file, "this is no table of forces");
  Stored stored;
  stored.sha256 = in.text("sha256");
  stored.text = in.text("case");
  io::read_json(in.at("head"), stored.head);
  stored.nodes = nodes_of(in.at("nodes"));
  if (const auto check = in.find("check")) {
    io::read_json(*check, stored.check.emplace());
    for (const io::JsonTree& row : check->at("errors").items()) io::read_json(row, stored.check->errors.emplace_back());
  }
  if (const auto creep = in.find("creep")) {
    std::vector<int> counts;
    for (const char* name : kCreepCounts) counts.push_back(creep->at(name).integer());
    stored.creep = {creep->number("poisson"), creep->number("greatest_ratio"), std::move(counts),
                    creep->at("values").numbers(), creep->at("slopes").numbers()};
  }
  return stored;
}

}  // namespace

bool is_table_file(const std::filesystem::path& file) {
  const std::string extension = io::extension_of(file);
  return extension == ".h5" || extension == ".json";
}

void check_table_output(const std::filesystem::path& file) {
  const std::string extension = io::extension_of(file);
  if (extension != ".h5" && extension != ".json" && extension != ".csv")
    throw Error(ErrorKind::configuration, "a table of forces is a file .h5, .json or .csv, not " + file.string());
  if (extension == ".h5") require_part("hdf5", "tables of forces as .h5");
}

void write_table(const std::filesystem::path& file, const MadeTable& made) {
  check_table_output(file);
  const std::string extension = io::extension_of(file);
  if (extension == ".h5")
    write_hdf5(file, stored_of(made));
  else if (extension == ".json")
    write_file(file, json_file(stored_of(made)));
  else
    write_file(file, io::csv_of(made.nodes, Digits::all));
}

MadeTable read_table(const std::filesystem::path& file) {
  if (!is_table_file(file)) refuse(file, "a table of forces is read from a file .h5 or .json");
  Stored stored = io::extension_of(file) == ".h5" ? read_hdf5(file) : read_json_table(file);
  const bool as_written = digest_of(stored) == stored.sha256;
  try {
    MadeTable made = made_of(file, std::move(stored));
    if (!as_written) refuse(file, "this table of forces is damaged: it is not what was written");
    return made;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::input_data) throw;
    refuse(file, "this table of forces is damaged: " + error.message());
  }
}

}  // namespace treadmark::app

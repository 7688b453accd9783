// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/kept_tables.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include <link.h>

#include <fmt/format.h>

#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/solvers/wheelrail/problem_bytes.hpp"

namespace treadmark::app {
namespace {

/// What the linker has made of the contents of a loaded module (NT_GNU_BUILD_ID); empty without one.
std::string build_id(const dl_phdr_info& module) {
  for (int i = 0; i < module.dlpi_phnum; ++i) {
    const auto& part = module.dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const auto* at = reinterpret_cast<const char*>(module.dlpi_addr + part.p_vaddr);
    std::size_t left = part.p_memsz;
    const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
    while (left >= 3 * sizeof(std::uint32_t)) {
      std::array<std::uint32_t, 3> head{};  // lengths of name and content, type
      std::memcpy(head.data(), at, sizeof head);
      const std::size_t name = padded(head[0]), content = padded(head[1]), all = sizeof head + name + content;
      if (all > left) break;
      constexpr std::uint32_t kBuildId = 3;
      if (head[2] == kBuildId && head[0] == 4 && std::memcmp(at + sizeof head, "GNU", 4) == 0) {
        std::string text;
        for (std::uint32_t k = 0; k < head[1]; ++k)
          text += fmt::format("{:02x}", static_cast<unsigned char>(at[sizeof head + name + k]));
        return text;
      }
      at += all;
      left -= all;
    }
  }
  return {};
}

bool holds(const dl_phdr_info& module, std::uintptr_t address) {
  for (int i = 0; i < module.dlpi_phnum; ++i) {
    const auto& part = module.dlpi_phdr[i];
    const std::uintptr_t from = module.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && address >= from && address < from + part.p_memsz) return true;
  }
  return false;
}

struct LoadedModules {
  std::string own;
  std::vector<std::string> libraries;
  bool all_known = true;
};

int note_module(dl_phdr_info* module, std::size_t, void* to) {
  auto& out = *static_cast<LoadedModules*>(to);
  if (holds(*module, reinterpret_cast<std::uintptr_t>(&note_module))) {
    out.own = build_id(*module);
    return 0;
  }
  // Of the libraries those that compute.
  const std::string_view path = module->dlpi_name != nullptr ? module->dlpi_name : "";
  const std::string_view name = path.substr(path.rfind('/') + 1);
  if (!name.starts_with("libm.") && !name.starts_with("libmvec.") && !name.starts_with("libfftw") &&
      !name.starts_with("libtreadmark"))
    return 0;
  const std::string id = build_id(*module);
  out.all_known = out.all_known && !id.empty();
  out.libraries.push_back(fmt::format("{} {}", name, id));
  return 0;
}

/// Mathematical libraries choose their code by it.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  std::string text, line;
  while (std::getline(in, line) && !line.empty())  // the first one
    for (const char* key : {"model name", "flags", "Features"})
      if (line.starts_with(key)) text += line + '\n';
  return text;
}

std::string find_identity() {
  LoadedModules modules;
  dl_iterate_phdr(note_module, &modules);
  const std::string cpu = processor();
  if (modules.own.empty() || !modules.all_known || cpu.empty()) return {};
  ranges::sort(modules.libraries);
  std::string text = modules.own + '\n' + cpu;
  for (const std::string& library : modules.libraries) text += library + '\n';
  return io::sha256_hex(text);
}

std::string hex_of(const ByteWriter& bytes) {
  const std::vector<std::byte>& b = bytes.bytes();
  return io::sha256_hex({reinterpret_cast<const char*>(b.data()), b.size()});
}

/// From the cache what reads, else what make() makes, which is then kept.
template <class Thing, class Make, class Read, class Save>
Thing kept_or_made(const io::ContentCache* cache, const std::string& key, Make make, Read read, Save save) {
  if (cache == nullptr || computing_identity().empty()) return make();
  const std::string whole = key + "\ncomputed by " + computing_identity() + plugin_identity();
  if (const auto bytes = cache->find(whole)) {
    try {
      ByteReader in(*bytes);
      Thing found = read(in);
      if (in.at_end()) return found;
    } catch (const Error&) {
      // Not what it should be: made anew.
    }
  }
  Thing made = make();
  ByteWriter out;
  save(made, out);
  cache->keep(whole, out.bytes());
  return made;
}

using vehicle::ColumnsBeyond, vehicle::ContactTableColumns;

void write_made(const ContactTableColumns& made, ByteWriter& out) { vehicle::write_columns(made, out); }
ContactTableColumns read_made(ByteReader& in, const ContactTableColumns&) { return vehicle::read_columns(in); }

void write_made(const ColumnsBeyond& made, ByteWriter& out) {
  vehicle::write_columns(made.columns, out);
  out.put(made.unsolved);
}
ColumnsBeyond read_made(ByteReader& in, ColumnsBeyond made) {
  made.columns = vehicle::read_columns(in);
  in.get(made.unsolved);
  return made;
}

}  // namespace

const std::string& computing_identity() {
  static const std::string identity = find_identity();
  return identity;
}

std::shared_ptr<const vehicle::ContactTable> kept_contact_table(const io::ContentCache* cache,
                                                                const std::string& bodies,
                                                                const wheelrail::Geometry& geometry,
                                                                const wheelrail::Problem& prototype, double load) {
  const vehicle::ContactTableOptions options;
  // Of numerical coefficients the contents are not known.
  if (prototype.influence.table) cache = nullptr;
  ByteWriter decides;
  wheelrail::write(vehicle::table_problem(prototype, options), decides);
  for (const double value : {load, options.lateral_range, options.step, options.element_size}) decides.put(value);
  decides.put(options.relative_loads);
  decides.put(options.heavier);
  decides.put(options.growth);
  const auto kept = [key = "contact table of " + bodies + "\nwith " + hex_of(decides),
                     cache = cache ? std::optional(*cache) : std::nullopt](const std::string& which, auto make) {
    return kept_or_made<decltype(make())>(
        cache ? &*cache : nullptr, key + which, make, [](ByteReader& in) { return read_made(in, decltype(make())()); },
        [](const auto& made, ByteWriter& out) { write_made(made, out); });
  };
  const ContactTableColumns central =
      kept("", [&] { return vehicle::solve_contact_sheets(geometry, prototype, load, options).front(); });
  return vehicle::contact_table_of(
      {central}, geometry, prototype, load, options,
      {[=](const vehicle::TableTurn& turn, double from) {
         return kept(fmt::format("\nbeyond {:a} m", from),
                     [&] { return vehicle::solve_columns_beyond(geometry, prototype, load, turn, from, options); });
       },
       [=](const vehicle::TableTurn& turn, const ContactTableColumns& columns) {
         return kept(fmt::format("\nheavier from {:a} m", columns.front().y),
                     [&] { return vehicle::solve_heavier(geometry, prototype, load, turn, columns, options); });
       }});
}

std::shared_ptr<const vehicle::CreepTable> kept_creep_table(
    const io::ContentCache* cache, double poisson, const vehicle::CreepTableOptions& options,
    const std::function<void(std::size_t finished, std::size_t all)>& report) {
  ByteWriter decides;
  for (const double value : {poisson, options.greatest_ratio}) decides.put(value);
  for (const int value : {options.intervals, options.ratio_intervals, options.nx, options.ny}) decides.put(value);
  return kept_or_made<std::shared_ptr<const vehicle::CreepTable>>(
      cache, "creep table " + hex_of(decides), [&] { return vehicle::build_creep_table(poisson, options, report); },
      vehicle::CreepTable::read, [](const auto& table, ByteWriter& out) { table->save(out); });
}

}  // namespace treadmark::app

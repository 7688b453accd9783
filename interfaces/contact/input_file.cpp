// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/contact/input_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <mutex>

#include "treadmark/core/error.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::contact {
namespace {

struct CloseInput {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputHandle = std::unique_ptr<std::FILE, CloseInput>;

struct InputFile {
  std::mutex mutex;
  InputHandle file;
};

InputFile& the_input() {
  static InputFile& one = *new InputFile;  // lives as long as threads that may still call
  return one;
}

void write_text(std::FILE* file, const std::string& name, const std::string& text) {
  if (file == nullptr || std::fputs(text.c_str(), file) < 0 || std::fflush(file) != 0)
    throw Error(ErrorKind::input_data, "cannot write the file " + name);
}

/// The source of a body, its points written where they come from the caller.
io::SurfaceSource written_source(const Problem& p, Body body, const std::string& stem) {
  const GivenProfile& given = body == Body::wheel ? p.wheel : p.rail;
  io::SurfaceSource source = given.source;
  if (given.points.empty()) return source;
  const std::string name = fmt::format("{}_re{:03}_{}.txt", stem, p.element, body_name(body));
  write_text(InputHandle(std::fopen(name.c_str(), "w")).get(), name, given.points);
  std::get<io::GeometryFile>(source.geometry).file = name;
  return source;
}

}  // namespace

void write_input(const Problem& p, io::Case c) {
  try {
    const Folders where = folders();
    const std::string stem = where.out + where.name, name = stem + ".inp";
    InputFile& input = the_input();
    const std::lock_guard lock(input.mutex);
    if (auto* rail = std::get_if<io::WheelRailCase>(&c.content)) {
      rail->rail = written_source(p, Body::rail, stem);
      rail->wheel = written_source(p, Body::wheel, stem);
    }
    const std::string sequence =
        p.module == 1 ? fmt::format("{}", p.element) : fmt::format("{} {}", p.element, p.number);
    const std::string text = io::contact_case_text(c, where.out, sequence);
    if (!input.file) input.file.reset(std::fopen(name.c_str(), "w"));
    write_text(input.file.get(), name, text);
  } catch (const std::exception& error) {
    warn(fmt::format("WARNING: case {} of result element {} is not in the .inp file: {}", c.number, p.element,
                     error.what()));
  }
}

void close_input() {
  InputFile& input = the_input();
  const std::lock_guard lock(input.mutex);
  if (input.file) std::fputs("\n 0  MODULE\n", input.file.get());
  input.file.reset();
}

}  // namespace treadmark::contact

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/cad_process.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

extern char** environ;

namespace treadmark::io::cad {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "treadmark-opencascade";
constexpr int kSocketThere = 3;       // the program's end of the socket
constexpr int kLongestSilence = 120;  // [s]

/// Errors: Error(configuration) where it is nowhere.
fs::path program() {
  std::vector<fs::path> places;
  std::error_code failed;
  if (const fs::path own = fs::read_symlink("/proc/self/exe", failed); !failed)
    places.push_back(own.parent_path().parent_path() / "lib" / "treadmark");
  // Beside the shared library that this is part of, wherever it was installed.
  if (Dl_info here{}; dladdr(reinterpret_cast<const void*>(&write_sheet), &here) != 0 && here.dli_fname != nullptr)
    places.push_back(fs::path(here.dli_fname).parent_path() / "treadmark");
  places.emplace_back(TREADMARK_BUILT_MODULES);
  places.emplace_back(TREADMARK_INSTALLED_MODULES);
  std::string tried;
  for (const fs::path& place : places) {
    if (::access((place / kProgram).c_str(), X_OK) == 0) return place / kProgram;
    tried += "\n  " + place.string();
  }
  throw Error(ErrorKind::configuration, fmt::format("cannot find {}, which files of CAD need, in{}", kProgram, tried),
              {}, "install Treadmark again");
}

}  // namespace

CadProcess::CadProcess(std::string file) : file_(std::move(file)), channel_(-1) {
  const fs::path name = program();
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(ErrorKind::configuration, "no socket can be opened for OpenCASCADE", {file_},
                "are too many files open?");
  const timeval silence{kLongestSilence, 0};
  ::setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &silence, sizeof silence);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kSocketThere);
  std::string path = name.string(), version = TREADMARK_MODULE_VERSION;
  char* arguments[] = {path.data(), version.data(), nullptr};
  const int failed = ::posix_spawn(&process_, path.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  socket_ = ends[0];
  channel_ = Channel(socket_);
  if (failed == 0) return;
  ::close(socket_);
  throw Error(ErrorKind::configuration, fmt::format("cannot start {}", path), {file_}, "install Treadmark again");
}

CadProcess::~CadProcess() {
  ::close(socket_);
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void CadProcess::broke_down() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
  throw Error(ErrorKind::input_data, "OpenCASCADE broke down over the CAD file", {file_},
              "is it damaged? export it again, or export triangles (.stl)");
}

CadShape::CadShape(const fs::path& file, bool iges) : process_(file.string()) {
  process_.ask([&](Channel& c) {
    c.put<std::int64_t>(iges ? 1 : 0);
    c.put_list(file.string());
  });
  const CadFault fault = process_.ask([](Channel& c) {
    CadFault said;
    said.message = c.take_list<std::string>();
    said.advice = c.take_list<std::string>();
    return said;
  });
  if (!fault.message.empty())
    throw Error(ErrorKind::input_data, "the CAD file " + fault.message, {file.string()}, fault.advice);
  process_.ask([&](Channel& c) {
    unit_ = c.take_list<std::string>();
    faces_ = static_cast<int>(c.take<std::int64_t>());
    low_ = c.take<Point>();
    high_ = c.take<Point>();
  });
}

std::vector<CadHit> CadShape::hits(const Point& origin, const Point& direction) const {
  return process_.ask([&](Channel& c) {
    c.put(Question::hits);
    c.put(origin);
    c.put(direction);
    return c.take_list<std::vector<CadHit>>();
  });
}

std::vector<Point> CadShape::points_on(std::int64_t face) const {
  return process_.ask([&](Channel& c) {
    c.put(Question::points_on);
    c.put(face);
    return c.take_list<std::vector<Point>>();
  });
}

std::vector<Point> CadShape::edges_of(std::int64_t face) const {
  return process_.ask([&](Channel& c) {
    c.put(Question::edges_of);
    c.put(face);
    return c.take_list<std::vector<Point>>();
  });
}

bool CadShape::unchanging(std::int64_t face, bool turned) const {
  return process_.ask([&](Channel& c) {
    c.put(Question::unchanging);
    c.put(face);
    c.put<std::int64_t>(turned ? 1 : 0);
    return c.take<std::int64_t>() != 0;
  });
}

std::string CadShape::entity(std::int64_t face) const {
  return process_.ask([&](Channel& c) {
    c.put(Question::entity);
    c.put(face);
    return c.take_list<std::string>();
  });
}

void write_sheet(const fs::path& file, const CadSheet& sheet) {
  CadProcess process(file.string());
  const CadFault fault = process.ask([&](Channel& c) {
    constexpr std::int64_t kWrite = 2;
    c.put(kWrite);
    c.put_list(file.string());
    c.put(sheet.kind);
    c.put(sheet.rows);
    c.put(sheet.from);
    c.put(sheet.to);
    c.put_list(sheet.name);
    c.put_list(sheet.points);
    CadFault said;
    said.message = c.take_list<std::string>();
    said.advice = c.take_list<std::string>();
    return said;
  });
  if (!fault.message.empty())
    throw Error(ErrorKind::configuration, "the CAD file " + fault.message, {file.string()}, fault.advice);
}

}  // namespace treadmark::io::cad

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/cad_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/platform/ranges.hpp"

extern char** environ;

namespace treadmark::io::cad {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "treadmark-opencascade";
constexpr int kSocketThere = 3;       // the program's end of the socket
constexpr int kLongestSilence = 120;  // [s]
constexpr int kSlice = 50;            // [ms] between questions whether the work is to end

/// Errors: Error(configuration) where it is nowhere.
fs::path program() {
  std::string tried;
  for (const fs::path& folder : module_folders()) {
    if (::access((folder / kProgram).c_str(), X_OK) == 0) return folder / kProgram;
    tried += "\n  " + folder.string();
  }
  throw Error(ErrorKind::configuration, fmt::format("cannot find {}, which files of CAD need, in{}", kProgram, tried),
              {}, module_advice("cad"));
}

/// A run of the program. It ends with this object.
class ProcessChannel final : public SocketChannel {
 public:
  explicit ProcessChannel(const std::string& file) : SocketChannel(-1) {
    const fs::path name = program();
    int ends[2] = {-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw Error(ErrorKind::configuration, "no socket can be opened for OpenCASCADE", {file},
                  "are too many files open?");
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
    if (failed == 0) return;
    ::close(socket_);
    throw Error(ErrorKind::configuration, fmt::format("cannot start {}", path), {file}, module_advice("cad"));
  }
  ProcessChannel(const ProcessChannel&) = delete;
  ProcessChannel& operator=(const ProcessChannel&) = delete;
  ~ProcessChannel() override {
    ::close(socket_);
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

 private:
  void put_bytes(const void* data, std::size_t size) override {
    for (const char* bytes = static_cast<const char*>(data); size > 0;) {
      const std::size_t n = moved(POLLOUT, [&] { return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT); });
      bytes += n, size -= n;
    }
  }
  void take_bytes(void* data, std::size_t size) override {
    for (char* bytes = static_cast<char*>(data); size > 0;) {
      const std::size_t n = moved(POLLIN, [&] { return ::recv(socket_, bytes, size, MSG_DONTWAIT); });
      bytes += n, size -= n;
    }
  }
  /// Bytes that a call moves once the socket is ready for it.
  template <class Call>
  std::size_t moved(short ready, Call call) {
    for (int slices = 0; slices < kLongestSilence * 1000 / kSlice;) {
      check_cancelled();
      const ssize_t n = call();
      if (n > 0) return static_cast<std::size_t>(n);
      if (n == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) throw Broken{};
      pollfd wait{socket_, ready, 0};
      if (::poll(&wait, 1, kSlice) == 0) ++slices;
    }
    throw Broken{};
  }

  pid_t process_ = -1;
};

/// Calls talk(channel); ends the channel where it is broken or in the midst of an answer.
template <class Talk>
auto talk_to(std::unique_ptr<Channel>& channel, const std::string& file, Talk talk) {
  try {
    if (channel == nullptr) throw Broken{};
    return talk(*channel);
  } catch (const Cancelled&) {
    channel.reset();
    throw;
  } catch (const Broken&) {
    channel.reset();
    throw Error(ErrorKind::input_data, "OpenCASCADE broke down over the CAD file", {file},
                "is it damaged? export it again, or export triangles (.stl)");
  }
}

bool is_finite(const Point& p) {
  return ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

void require(bool sense) {
  if (!sense) throw Broken{};
}

std::vector<Point> take_points(Channel& c) {
  auto points = c.take_list<std::vector<Point>>();
  require(ranges::all_of(points, is_finite));
  return points;
}

}  // namespace

std::unique_ptr<Channel> start_opencascade(const std::string& file) { return std::make_unique<ProcessChannel>(file); }

template <class Talk>
auto CadShape::ask(Talk talk) const {
  return talk_to(channel_, file_, talk);
}

CadShape::CadShape(std::unique_ptr<Channel> channel, const fs::path& file, bool iges)
    : channel_(std::move(channel)), file_(file.string()) {
  const CadFault fault = ask([&](Channel& c) {
    c.put<std::int64_t>(iges ? 1 : 0);
    c.put_list(file_);
    return take_fault(c);
  });
  if (!fault.message.empty())
    throw Error(ErrorKind::input_data, "the CAD file " + fault.message, {file_}, fault.advice);
  ask([&](Channel& c) {
    unit_ = c.take_list<std::string>();
    const auto faces = c.take<std::int64_t>();
    low_ = c.take<Point>();
    high_ = c.take<Point>();
    require(faces > 0 && faces <= kMostFaces && is_finite(low_) && is_finite(high_));
    for (std::size_t k = 0; k < 3; ++k) require(low_[k] <= high_[k]);
    faces_ = static_cast<int>(faces);
  });
}

std::vector<CadHit> CadShape::last_hits(double least, const std::vector<CadLine>& lines) const {
  return ask([&](Channel& c) {
    c.put(Question::last_hits);
    c.put(least);
    c.put_list(lines);
    auto hits = c.take_list<std::vector<CadHit>>();
    require(hits.size() == lines.size());
    for (const CadHit& hit : hits) require(hit.face >= -1 && hit.face < faces_ && std::isfinite(hit.t));
    return hits;
  });
}

std::vector<Point> CadShape::points_on(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::points_on);
    c.put(face);
    return take_points(c);
  });
}

std::vector<CadEdgePoint> CadShape::edges_of(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::edges_of);
    c.put(face);
    auto points = c.take_list<std::vector<CadEdgePoint>>();
    for (const CadEdgePoint& point : points) require(is_finite(point.p));
    return points;
  });
}

bool CadShape::unchanging(std::int64_t face, bool turned) const {
  return ask([&](Channel& c) {
    c.put(Question::unchanging);
    c.put(face);
    c.put<std::int64_t>(turned ? 1 : 0);
    return c.take<std::int64_t>() != 0;
  });
}

std::string CadShape::entity(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::entity);
    c.put(face);
    return c.take_list<std::string>();
  });
}

CadSpline CadShape::spline_of(std::int64_t face, const CadPart& part, std::string& why) const {
  return ask([&](Channel& c) {
    c.put(Question::spline_of);
    c.put(face);
    c.put(part);
    why = c.take_list<std::string>();
    CadSpline spline;
    if (why.empty()) spline = take_spline(c);
    return spline;
  });
}

CadTriangles CadShape::triangles_of(const std::vector<std::int64_t>& faces, double deviation, double side) const {
  return ask([&](Channel& c) {
    c.put(Question::triangles_of);
    c.put_list(faces);
    c.put(deviation);
    c.put(side);
    CadTriangles out;
    out.message = c.take_list<std::string>();
    out.deviation = c.take<double>();
    out.vertices = take_points(c);
    out.triangles = c.take_list<std::vector<std::array<std::int32_t, 3>>>();
    out.faces = c.take_list<std::vector<std::int32_t>>();
    require(out.faces.size() == out.triangles.size() && !(out.deviation < 0.0));
    for (const auto& triangle : out.triangles)
      for (const std::int32_t corner : triangle)
        require(corner >= 0 && static_cast<std::size_t>(corner) < out.vertices.size());
    for (const std::int32_t face : out.faces) require(face >= 0 && face < faces_);
    return out;
  });
}

void write_sheet(const fs::path& file, const CadSheet& sheet) {
  std::unique_ptr<Channel> channel = start_opencascade(file.string());
  const CadFault fault = talk_to(channel, file.string(), [&](Channel& c) {
    constexpr std::int64_t kWrite = 2;
    c.put(kWrite);
    c.put_list(file.string());
    c.put(sheet.kind);
    c.put(sheet.from);
    c.put(sheet.to);
    c.put_list(sheet.name);
    c.put_list(sheet.description);
    put(c, sheet.spline);
    return take_fault(c);
  });
  if (!fault.message.empty())
    throw Error(ErrorKind::configuration, "the CAD file " + fault.message, {file.string()}, fault.advice);
}

}  // namespace treadmark::io::cad

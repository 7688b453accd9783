// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace treadmark::io::cad {

/// What Treadmark and the program that holds OpenCASCADE, a process of its own, say to each other over a socket: any
/// file may break that program, and Treadmark lives on. Both are of one build on one machine, so numbers go as they
/// are.

using Point = std::array<double, 3>;  ///< [m]

/// Where a line meets a face.
struct CadHit {
  double t = 0.0;         ///< along the line [m]
  std::int64_t face = 0;  ///< counted from 0
};

/// What is wrong with a file; no message: nothing.
struct CadFault {
  std::string message = {}, advice = {};
};

/// A surface to be written: a curve through points, extruded along x or turned about y, or a grid of points.
struct CadSheet {
  enum class Kind : std::int64_t { extruded, revolved, grid };
  Kind kind = Kind::grid;
  std::int64_t rows = 0;        ///< grid: along u; the points stand row by row
  double from = 0.0, to = 0.0;  ///< extruded: x [m]; revolved: angle from +z towards +x [rad]
  std::string name = {};
  std::vector<Point> points = {};
};

/// The questions; each is followed by what it is about, and answered.
enum class Question : std::int64_t {
  hits,        ///< origin, unit direction: the hits of the whole line with all faces, in the order of t
  points_on,   ///< face: some points inside of it
  edges_of,    ///< face: some points on each of its edges
  unchanging,  ///< face, whether turned: by its kind the same all round the y axis, or else all along x
  entity,      ///< face: number and kind of the entity of the file that it was made of
};

/// The other end is gone.
struct Broken {};

/// One end of the socket.
class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof(T));
  }
  template <class T>
  void put_list(const T& list) {
    put(static_cast<std::int64_t>(list.size()));
    put_bytes(list.data(), list.size() * sizeof(list[0]));
  }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    take_bytes(&value, sizeof(T));
    return value;
  }
  template <class List>
  List take_list() {
    constexpr std::int64_t kMost = 100'000'000;
    const auto size = take<std::int64_t>();
    if (size < 0 || size > kMost) throw Broken{};
    List list;
    list.resize(static_cast<std::size_t>(size));
    take_bytes(list.data(), list.size() * sizeof(list[0]));
    return list;
  }

 private:
  void put_bytes(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t n = ::send(socket_, bytes, size, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw Broken{};
      bytes += n, size -= static_cast<std::size_t>(n);
    }
  }
  /// Also Broken where the other end says nothing for as long as the socket waits.
  void take_bytes(void* data, std::size_t size) {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
      const ssize_t n = ::recv(socket_, bytes, size, 0);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw Broken{};
      bytes += n, size -= static_cast<std::size_t>(n);
    }
  }

  int socket_;
};

}  // namespace treadmark::io::cad

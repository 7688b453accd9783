// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "sample_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

TEST(ScanErrors, PlyHeader) {
  using scans::parse_ply;
  expect_error(parse_ply, "plx\n", "begins with the word ply", 1, 1);
  expect_error(parse_ply, "ply\nformat ascii 1.0\n", "no line end_header");
  expect_error(parse_ply, replaced(ascii_ply(), "property uchar red", "property byte red"), "unknown type 'byte'", 11,
               10);
  expect_error(parse_ply, replaced(ascii_ply(), "property double y", "property double w"),
               "lack one of the properties x, y, z");
  expect_error(parse_ply, replaced(ascii_ply(), "property double y", "property double X"), "the property x twice");
  expect_error(parse_ply, replaced(ascii_ply(), "element vertex", "element point"), "the element vertex 0 times");
  expect_error(parse_ply, replaced(ascii_ply(), "element face", "element vertex"), "the element vertex 2 times");
  expect_error(parse_ply, replaced(ascii_ply(), "element vertex 5", "element vertex 999"),
               "promises 999 times 'vertex', more than the file holds");
  expect_error(parse_ply, replaced(ascii_ply(), "element empty 0", "element empty 1"),
               "the element 'empty' has no properties");
  ScanReadOptions few;
  few.most_points = 4;
  expect_error(parse_ply, ascii_ply(), "5 points, more than the 4 allowed", 0, 0, few);
}

TEST(ScanErrors, PlyText) {
  using scans::parse_ply;
  const std::string text = ascii_ply();
  const std::string second = "200 0.5 0 10 2 7 7 1 0 1 0 -3\n";  // on line 28
  expect_error(parse_ply, replaced(text, second, "200 0.5 0 10 2 7 7 1 0 one 0 -3\n"),
               "a number is expected, this is 'one'", 28, 24);
  expect_error(parse_ply, replaced(text, second, "200 0.5 0 10 2 7 7 1 0 1 0\n"), "the line ends before all properties",
               28, 0);
  expect_error(parse_ply, replaced(text, second, "200 0.5 0 10 2 7 7 1 0 1 0 -3 4\n"),
               "more values than a vertex has properties", 28, 31);
  expect_error(parse_ply, replaced(text, second, "200 0.5 0 10 -2 7 7 1 0 1 0 -3\n"),
               "a number of elements is expected", 28, 14);
  expect_error(parse_ply, replaced(text, second, "200 0.5 0 10 2 7 7 70000 0 1 0 -3\n"),
               "the pass 70000 is not a whole number", 28, 0);
  expect_error(parse_ply, text.substr(0, text.find(second)), "more than the file holds");
  const std::string cut = replaced(text.substr(0, text.find(second) + 10), "element face 1", "element face 0");
  expect_error(parse_ply, cut + std::string(300, ' '), "the line ends before all properties", 28, 0);
  expect_error(parse_ply, text.substr(0, text.find(second)) + std::string(300, '\n'),
               "the file ends before all elements", 327, 0);
}

TEST(ScanErrors, PlyBinary) {
  using scans::parse_ply;
  const std::string bytes = binary_ply(false);
  const std::size_t header = bytes.find("end_header\n") + 11;
  // the list of the second vertex: 19 bytes of elements before, 45 bytes of the first vertex, then 17 to the list
  std::string damaged = bytes;
  const std::size_t first = header + 1 + 6 + 8 + 1 + 8,
                    list = first + (1 + 8 + 4 + 4) + 2 + 2 + 8 + 8 + 4 + (1 + 8 + 4 + 4);
  set_bytes(damaged, list, std::uint16_t{40000});
  expect_error(parse_ply, damaged,
               "at byte " + std::to_string(list) + ": a list of 40000 entries, more than the file holds");
  expect_error(parse_ply, bytes.substr(0, header + 40), "more than the file holds");
  // lists longer than their least length: the end shows only there
  std::string cut = replaced(bytes, "element face 1", "element face 0");
  cut.resize(cut.size() - 17 - 4);
  expect_error(parse_ply, cut, "the file ends in the middle of its data");
}

TEST(ScanErrors, Stl) {
  using scans::parse_stl;
  expect_error(parse_stl, "short", "at byte 0: the file ends in the middle of its data");
  expect_error(parse_stl, std::string(80, 'a') + "aa", "at byte 80: the file ends");
  std::string bytes = binary_stl("x");
  bytes.pop_back();
  expect_error(parse_stl, bytes, "at byte 80: 2 triangles are promised, the file holds 1");
  set_bytes(bytes, 80, std::uint32_t{0});
  expect_error(parse_stl, bytes, "the file holds no points");
  expect_error(parse_stl, "solid\nsolids are here\n", "unknown line 'solids'", 2, 1);
  expect_error(parse_stl, replaced(ascii_stl(), "10 0 0.5", "10 0"), "three coordinates", 5, 4);
  expect_error(parse_stl, replaced(ascii_stl(), "10 0 0.5", "10 0 x"), "this is 'x'", 5, 16);
  expect_error(parse_stl, replaced(ascii_stl(), "endsolid sample\n", ""), "ends within a solid", 15, 0);
  ScanReadOptions few;
  few.most_points = 3;
  expect_error(parse_stl, ascii_stl(), "more than the 3 points allowed", 12, 0, few);
}

TEST(ScanErrors, Obj) {
  using scans::parse_obj;
  expect_error(parse_obj, "# nothing\nf 1 2 3\n", "the file holds no points");
  expect_error(parse_obj, "v 1 2 3\nv 1 2\n", "three numbers are expected behind 'v'", 2, 1);
  expect_error(parse_obj, "v 1 2 3\nvn 1 two 3\n", "this is 'two'", 2, 6);
  expect_error(parse_obj, std::string("v 1 2 3\nxy\0z\n", 13), "NUL byte", 2, 3);
  expect_error(parse_obj, "v nan 2 3\n", "none of the 1 points is finite");
}

TEST(ScanErrors, Off) {
  using scans::parse_off;
  expect_error(parse_off, "4OFF\n1 0 0\n1 2 3\n", "begins with the word OFF", 1, 1);
  expect_error(parse_off, "NOFF BINARY\n1234", "without further properties", 1, 1);
  expect_error(parse_off, "OFF\n-5 0 0\n1 2 3\n", "a number of elements is expected", 2, 1);
  expect_error(parse_off, "OFF\n500 0 0\n1 2 3\n", "500 points are promised", 2, 0);
  expect_error(parse_off, "OFF\n2 0 0\n1 2 3\n", "ends before all vertices", 3, 0);
  expect_error(parse_off, "OFF\n1 0 0\n1 2\n", "the line ends too early", 3, 0);
  expect_error(parse_off, "OFF\n1 0 0\n1 2 z\n", "this is 'z'", 3, 5);
  std::string bytes = binary_off();
  set_bytes(bytes, 11, std::uint32_t{0x01000000});  // big endian: 1
  EXPECT_EQ(parse(parse_off, bytes).cloud.points.size(), 1u);
  set_bytes(bytes, 11, std::uint32_t{0x0000ffff});
  expect_error(parse_off, bytes, "at byte 23: 4294901760 points are promised");
}

TEST(ScanErrors, FilesThatCannotBeRead) {
  const TemporaryFolder folder;
  const ScanReadOptions asked{{"case.toml", 3, 5}, 10};
  const auto expect = [&](const std::filesystem::path& file, const std::string& part) {
    const Error error = error_thrown_by([&] { read_scan(file, asked); });
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_EQ(error.where().to_string(), "case.toml:3:5");
  };
  expect(folder.path() / "none.ply", "'none.ply' does not exist");
  std::filesystem::create_directory(folder.path() / "dir.ply");
  expect(folder.path() / "dir.ply", "is a folder");
  expect("/dev/null/a.ply", "");
  expect(folder.write("empty.xyz", ""), "is empty");
  expect(folder.write("a.laz", "LASF"), "decompress it first: 'laszip -i a.laz -o a.las'");
  expect(folder.write("a.docx", "x"), "of no known kind");
  EXPECT_EQ(error_thrown_by([&] { read_scan(folder.path() / "none.ply"); }).where().file,
            (folder.path() / "none.ply").string());
}

TEST(ScanErrors, ReadingToldAndStopped) {
  const TemporaryFolder folder;
  std::string text = "x y z\n";
  while (text.size() < 9'000'000) text += "1.25 2.5 3.125\n";
  const auto file = folder.write("a.xyz", text);
  std::vector<std::size_t> done;
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t now, std::size_t total, const std::string& what) {
    EXPECT_EQ(total, text.size());
    EXPECT_EQ(what, "reading a.xyz");
    done.push_back(now);
  };
  EXPECT_EQ(read_scan(file, {}, progress).cloud.points.size(), (text.size() - 6) / 15);
  EXPECT_GE(done.size(), 3u);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(done.back(), text.size());

  progress.report = [&](std::size_t now, std::size_t, const std::string&) { stop = now > 0; };
  const Error error = error_thrown_by([&] { read_scan(file, {}, progress); });
  EXPECT_EQ(error.kind(), ErrorKind::input_data);
  EXPECT_NE(std::string(error.what()).find("stopped"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace treadmark::io

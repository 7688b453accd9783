// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/las_header.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

Scan parse_las(ByteBlocks& bytes, const ScanReadOptions& options) {
  const LasHeader header = read_las_header(bytes);
  CloudBuilder builder(bytes, options, header.record_length,
                       [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  const std::optional<std::size_t> source_id = header.source_id();
  builder.set_content(false, source_id.has_value());
  builder.set_intensities(true);
  builder.expect(header.count);
  const unsigned withheld = header.withheld_bit();
  for (std::uint64_t i = 0; i < header.count; ++i) {
    const char* const at = bytes.need(header.record_length);
    if ((load<std::uint8_t>(at + header.withheld_byte()) & withheld) != 0) {
      builder.add_withheld();
    } else {
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k)
        p[static_cast<Eigen::Index>(k)] = load<std::int32_t>(at + 4 * k) * header.scale[k] + header.origin[k];
      constexpr std::size_t kIntensity = 12;
      builder.add(p, Eigen::Vector3f::Zero(), source_id ? load<std::uint16_t>(at + *source_id) : std::uint16_t{0},
                  static_cast<float>(load<std::uint16_t>(at + kIntensity)));
    }
    bytes.consume(header.record_length);
  }
  std::string format = fmt::format("LAS 1.{}, point data format {}", header.minor, header.format);
  if (builder.keep_different_passes()) format += ", pass from the point source ID";
  if (!header.reference.empty()) format += ", coordinate system " + header.reference;
  Scan scan = builder.finish(std::move(format), header.unit);
  scan.usual_unit = LengthUnit::metre;
  scan.reference = header.reference;
  return scan;
}

}  // namespace treadmark::io::scans

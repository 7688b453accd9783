// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/line_blocks.hpp"

namespace treadmark::io::points {

LineBlocks::LineBlocks(ByteBlocks& bytes, int first) : TextLine(bytes.file(), first - 1), bytes_(bytes) {
  constexpr std::size_t kSample = 100'000;
  bytes_.want(kSample);
  const std::string_view start = bytes_.window();
  if (bytes_.offset() == 0) {
    if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
      throw Error(ErrorKind::input_data, "the text is in UTF-16", {bytes_.file(), 1, 1},
                  "save it as UTF-8 or plain text");
    if (start.starts_with("\xEF\xBB\xBF")) bytes_.consume(3);
  }
  if (start.find('\n') == std::string_view::npos && start.find('\r') != std::string_view::npos) end_of_line_ = '\r';
}

bool LineBlocks::more(std::size_t searched) {
  line_ = {};  // the block that it lies in may go
  if (searched > ByteBlocks::kLongestPiece) {
    ++number_;
    fail("a line of more than 64 million characters", 0, "is it a text file?");
  }
  if (bytes_.want(searched + 1) > searched) return true;
  if (searched == 0) return false;
  next_ = bytes_.size() + 1;
  return true;
}

void LineBlocks::too_many() const { fail("more than 2000 million lines", 0, "thin out the points"); }

}  // namespace treadmark::io::points

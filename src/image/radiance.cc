#include "image/radiance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "facet/error.h"
#include "image/codec.h"
#include "image/limits.h"

namespace facet {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void Fail(const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, "broken Radiance picture: " + why, name_);
  }

  std::uint8_t Byte() {
    if (at_ >= bytes_.size()) Fail("the file is cut off");
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }

  void Pixels(Rgbe* to, std::size_t count) {
    if (bytes_.size() - at_ < count * 4) Fail("the file is cut off");
    std::memcpy(to, bytes_.data() + at_, count * 4);
    at_ += count * 4;
  }

  void Bytes(std::uint8_t* to, std::size_t count) {
    if (bytes_.size() - at_ < count) Fail("the file is cut off");
    std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }

  // Reads a line without its line break.
  std::string_view Line() {
    const char* begin = reinterpret_cast<const char*>(bytes_.data()) + at_;
    const std::size_t left = bytes_.size() - at_;
    const void* end = std::memchr(begin, '\n', left);
    if (!end) Fail("the file is cut off in its header");
    const auto length = static_cast<std::size_t>(static_cast<const char*>(end) - begin);
    at_ += length + 1;
    std::string_view line(begin, length);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  // The number of bytes that remain for pixel data.
  std::size_t Left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  const std::string& name_;
};

struct Resolution {
  std::uint64_t width = 0, height = 0;
  bool bottom_up = false, right_to_left = false;
};

struct Axis {
  char sign = 0, letter = 0;
  std::uint64_t length = 0;
};

// Reads an axis like "-Y 512" from the start of `line`. False: it is malformed; if there is no letter, even its name
// is.
bool TakeAxis(std::string_view& line, Axis& axis) {
  while (line.starts_with(' ')) line.remove_prefix(1);
  if (line.size() < 4 || (line[0] != '+' && line[0] != '-') || (line[1] != 'X' && line[1] != 'Y') || line[2] != ' ') {
    return false;
  }
  axis.sign = line[0];
  axis.letter = line[1];
  const char* const end = line.data() + line.size();
  const auto [after, bad] = std::from_chars(line.data() + 3, end, axis.length);
  line = std::string_view(after, static_cast<std::size_t>(end - after));
  return bad == std::errc();
}

// "-Y 512 +X 1024": rows from the top (-Y), pixels from the left (+X).
Resolution ParseResolution(std::string_view line, const Reader& reader, const std::string& name) {
  Resolution out;
  for (const char expected : {'Y', 'X'}) {
    Axis axis;
    const bool good = TakeAxis(line, axis);
    if (axis.letter != 0 && axis.letter != expected) {
      throw Error(ErrorCode::Unsupported, "a Radiance picture stored by columns", name, "convert it to rows");
    }
    if (!good) reader.Fail("its size cannot be read");
    (expected == 'X' ? out.width : out.height) = axis.length;
    (expected == 'X' ? out.right_to_left : out.bottom_up) = axis.sign == (expected == 'X' ? '-' : '+');
  }
  return out;
}

// New run lengths: the four components one after the other, runs of at most 127 equal or 128 different bytes.
void ReadPlanes(Reader& reader, std::vector<Rgbe>& row, std::vector<std::uint8_t>& plane) {
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t x = 0; x < row.size();) {
      const std::size_t code = reader.Byte();
      const std::size_t count = code > 128 ? code - 128 : code;
      if (count == 0 || count > row.size() - x) reader.Fail("a run is longer than its row");
      if (code > 128) {
        std::fill_n(plane.begin() + static_cast<std::ptrdiff_t>(x), count, reader.Byte());
      } else {
        reader.Bytes(plane.data() + x, count);
      }
      x += count;
    }
    for (std::size_t x = 0; x < row.size(); ++x) row[x][c] = plane[x];
  }
}

// Old run lengths: the pixel (1, 1, 1, n) repeats the one before it n times; several in a row are the bytes of a longer
// count, lowest first. `first` has been read already. A flat (uncompressed) image is one without repetitions.
void ReadOldRow(Reader& reader, Rgbe first, std::vector<Rgbe>& row) {
  unsigned shift = 0;
  Rgbe pixel = first;
  for (std::size_t x = 0;;) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      if (x == 0 || shift > 24) reader.Fail("a run repeats nothing");
      const std::size_t count = std::size_t(pixel[3]) << shift;
      if (count > row.size() - x) reader.Fail("a run is longer than its row");
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
    if (x >= row.size()) return;
    reader.Pixels(&pixel, 1);
  }
}

void ReadRow(Reader& reader, std::vector<Rgbe>& row, std::vector<std::uint8_t>& plane) {
  Rgbe first;
  reader.Pixels(&first, 1);
  const bool planes = row.size() >= 8 && row.size() <= 32767 && first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!planes) return ReadOldRow(reader, first, row);
  if ((std::size_t(first[2]) << 8 | first[3]) != row.size()) reader.Fail("a row's length differs from the width");
  ReadPlanes(reader, row, plane);
}

}  // namespace

void ProbeRadiance(const FileStart& file, ImageHeader& header) {
  header.channels = 3;
  header.bits = 32;
  std::size_t at = 0;
  std::string_view line;
  do {
    if (!file.Line(at, line)) return;
  } while (!line.empty());
  Axis first, second;
  if (!file.Line(at, line) || !TakeAxis(line, first) || !TakeAxis(line, second)) return;
  for (const Axis& axis : {first, second}) (axis.letter == 'X' ? header.width : header.height) = SideOf(axis.length);
}

Image DecodeRadiance(std::span<const std::byte> bytes, const std::string& name) {
  Reader reader(bytes, name);
  reader.Line();
  for (std::string_view line = reader.Line(); !line.empty(); line = reader.Line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      throw Error(ErrorCode::Unsupported, "a Radiance picture with " + std::string(line.substr(0, 60)), name,
                  "convert it to 32-bit_rle_rgbe");
    }
  }
  const Resolution size = ParseResolution(reader.Line(), reader, name);
  const MemoryLease lease = LeaseImage(size.width, size.height, size.height, 3 * sizeof(float), name);
  // A row has at least 4 bytes, so a size that the file cannot contain is refused before memory is allocated for it.
  if (reader.Left() / 4 < size.height) reader.Fail("the file is cut off");

  Image image;
  image.width = static_cast<int>(size.width);
  image.height = static_cast<int>(size.height);
  image.channels = 3;
  image.type = ChannelType::F32;
  image.encoding = Encoding::Linear;
  const std::size_t row_bytes = 3 * sizeof(float) * size.width;
  ReservePixels(image.bytes, row_bytes * size.height, name);
  std::array<float, 256> scale{};  // exponent 0 is black
  for (int e = 1; e < 256; ++e) scale[static_cast<std::size_t>(e)] = std::ldexp(1.0f, e - 136);

  std::vector<Rgbe> row(size.width);
  std::vector<std::uint8_t> plane(size.width);
  for (std::size_t y = 0; y < size.height; ++y) {
    ReadRow(reader, row, plane);
    image.bytes.resize(row_bytes * (y + 1));  // memory of a row is touched only when the file has the row
    float* to = image.As<float>() + 3 * size.width * y;
    for (std::size_t x = 0; x < size.width; ++x) {
      const Rgbe& pixel = row[size.right_to_left ? size.width - 1 - x : x];
      const float unit = scale[pixel[3]];
      for (std::size_t c = 0; c < 3; ++c) to[3 * x + c] = static_cast<float>(pixel[c]) * unit;
    }
  }
  for (std::size_t y = 0; size.bottom_up && y < size.height / 2; ++y) {
    float* const row_above = image.As<float>() + 3 * size.width * y;
    std::swap_ranges(row_above, row_above + 3 * size.width, image.As<float>() + 3 * size.width * (size.height - 1 - y));
  }
  return image;
}

}  // namespace facet

// Encoded pictures. Compiled once for each format: FACET_FUZZ_FORMAT is one of the names below, and what an input
// begins with is made to be of that format. "any": as it comes; what no signature tells is taken for Targa.
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "base/memory_budget.h"
#include "facet/image.h"
#include "fuzz/fuzz.h"
#include "image/codec.h"

namespace facet::fuzz {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kFormat = FACET_FUZZ_FORMAT;

struct Mark {
  std::size_t at;
  std::string_view bytes;
};

constexpr std::pair<std::string_view, Mark> kMarks[] = {{"png", {0, "\x89PNG\r\n\x1a\n"sv}},
                                                        {"jpeg", {0, "\xFF\xD8\xFF"sv}},
                                                        {"webp", {0, "RIFF"sv}},
                                                        {"webp", {8, "WEBP"sv}},
                                                        {"radiance", {0, "#?RADIANCE\n"sv}},
                                                        {"exr", {0, "\x76\x2F\x31\x01"sv}},
                                                        {"tiff", {0, "II*\0"sv}}};

std::string Marked(std::span<const std::byte> input) {
  std::string bytes(AsText(input));
  for (const auto& [format, mark] : kMarks) {
    const std::size_t end = mark.at + mark.bytes.size();
    if (format == kFormat && bytes.size() >= end) bytes.replace(mark.at, mark.bytes.size(), mark.bytes);
  }
  return bytes;
}

void CheckForm(const Image& image) {
  Check(image.width > 0 && image.height > 0 && image.width <= kMaxImageSide && image.height <= kMaxImageSide &&
            image.channels >= 1 && image.channels <= 4,
        "a picture without a size");
  Check(image.bytes.size() == image.PixelCount() * std::size_t(image.channels) * SizeOf(image.type),
        "a picture has more or fewer bytes than its size says");
}

// What the first bytes say is what is decoded; of a damaged file, what was damaged may not be.
void CheckHeader(const ImageHeader& header, const Image& image) {
  const auto same = [](int said, int is) { return said == 0 || said == is; };
  Check(same(header.width, image.width) && same(header.height, image.height), "the header has another size");
  if (!image.damage.empty()) return;
  Check(same(header.channels, image.channels) && same(header.bits, int(8 * SizeOf(image.type))),
        "the header has another kind of pixels");
}

}  // namespace

void Run(std::span<const std::byte> input) {
  const std::string bytes = Marked(input);
  const std::string name = "picture.tga";
  const std::optional<ImageHeader> header = ProbeImage(AsBytes(bytes));
  Image whole;
  const Outcome outcome = Try([&] {
    MemoryBudget budget(kMemoryLimit);
    const MemoryBudget::Scope scope(budget);
    whole = DecodeImage(AsBytes(bytes), name);
  });
  if (outcome == Outcome::Done) {
    CheckForm(whole);
    if (header) CheckHeader(*header, whole);
  }

  std::size_t done = 0;  // bytes
  const Outcome by_rows = Try([&] {
    MemoryBudget budget(kMemoryLimit);
    const MemoryBudget::Scope scope(budget);
    DecodeImageRows(AsBytes(bytes), name, [&](const Image& rows, int height) {
      CheckForm(rows);
      if (outcome != Outcome::Done) return;
      Check(height == whole.height && rows.width == whole.width && rows.channels == whole.channels &&
                rows.type == whole.type && rows.encoding == whole.encoding,
            "rows of another picture");
      Check(rows.bytes.size() <= whole.bytes.size() - done &&
                std::memcmp(rows.bytes.data(), whole.bytes.data() + done, rows.bytes.size()) == 0,
            "rows have other pixels than the whole");
      done += rows.bytes.size();
    });
  });
  if (outcome == Outcome::OutOfMemory || by_rows == Outcome::OutOfMemory) return;
  Check(outcome == by_rows, "the whole is decoded and its rows are not, or the other way");
  Check(done == whole.bytes.size(), "rows are missing");
  Try([&] {
    MemoryBudget budget(kMemoryLimit);
    const MemoryBudget::Scope scope(budget);
    DecodeStored(AsBytes(bytes), name);
  });
}

}  // namespace facet::fuzz

#include "image/ktx2.h"

namespace facet {
namespace {

// The basic block of the data format descriptor, 24 bytes and 16 for each sample.
void ProbeKtx2Descriptor(const FileStart& file, std::size_t block, ImageHeader& header) {
  if (!file.Has(block, 24)) return;
  const std::size_t size = file.Little16(block + 6);
  if (file.Little32(block) != 0 || size < 40 || !file.Has(block, size)) return;  // vendor and type: Khronos, basic
  const std::size_t samples = (size - 24) / 16;
  const auto channel = [&](std::size_t sample) { return file.Byte(block + 24 + 16 * sample + 3) & 0xF; };
  constexpr std::uint32_t kPlain = 1, kEtc1s = 163, kUastc = 166;  // the color model
  switch (file.Byte(block + 8)) {
    case kPlain:
      if (samples > 4) return;
      header.channels = static_cast<int>(samples);
      header.bits = static_cast<int>(file.Byte(block + 24 + 2)) + 1;
      return;
    case kEtc1s: {  // a slice of RGB (0) or of one channel (3), perhaps with a slice of another (GGG 4, AAA 15)
      const int colors = channel(0) == 0 ? 3 : 1;
      header.channels = colors + (samples > 1 ? 1 : 0);
      header.bits = 8;
      return;
    }
    case kUastc: {  // RGB 0, RGBA 3, RRR 4, RRRG 5, RG 6
      const std::uint32_t id = channel(0);
      header.channels = id == 0 ? 3 : id == 3 ? 4 : id == 4 ? 1 : id == 5 || id == 6 ? 2 : 0;
      header.bits = 8;
      return;
    }
    default: return;  // blocks of other kinds do not say
  }
}

}  // namespace

void ProbeKtx2(const FileStart& file, ImageHeader& header) {
  if (!file.Has(0, 56)) return;
  header.width = SideOf(file.Little32(20));
  header.height = SideOf(file.Little32(24));
  const std::size_t descriptor = file.Little32(48);
  if (file.Little32(52) >= 4 + 40) ProbeKtx2Descriptor(file, descriptor + 4, header);  // after its total size
}

}  // namespace facet

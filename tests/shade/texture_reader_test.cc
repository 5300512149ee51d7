// A reader is used for one packet of fragments after the other: nothing of the last may show in the next.
#include <gtest/gtest.h>

#include "shade/material_view-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

// Black, but for a bar in the middle.
TextureData Bar() {
  constexpr int kSize = 1024;
  Image image{kSize, kSize, 3, ChannelType::U8, Encoding::Srgb, {}};
  image.bytes.resize(image.PixelCount() * 3, std::byte(0));
  for (std::size_t y = 0; y < kSize; ++y) {
    for (std::size_t x = 480; x < 544; ++x) image.bytes[3 * (y * kSize + x)] = std::byte(255);
  }
  return BuildTexture(image, TextureRole::Color, true, TexelBits::Mixed, kRgb, /*emission=*/true);
}

class EmissionReader {
 public:
  explicit EmissionReader(const TextureData& data) {
    material_.features = BitOf(Slot::Emissive) | kEmission;
    material_.textures[IndexOf(Slot::Emissive)].data = &data;
    for (float& factor : material_.factors.emissive) factor = 1.0f;
  }
  void MoveTo(float u) {
    surface_.uv[0] = {u, 0.5f};
    surface_.duv_dx[0] = {0.0005f, 0.0f};
    surface_.duv_dy[0] = {0.0f, 0.0005f};
    reader_.ReadAhead(material_);
  }
  float Alone() const { return View().Emissive(surface_).x; }
  float AmongAll() const { return View().Inputs(surface_).emissive.x; }

 private:
  lanes::MaterialView<float> View() const { return lanes::MaterialView<float>(material_, &reader_); }

  FrameMaterial material_{};
  lanes::Surface<float> surface_{};
  mutable lanes::TextureReader<float> reader_{surface_};
};

TEST(TextureReader, DarknessEndsWithThePacket) {
  const TextureData data = Bar();
  ASSERT_GT(data.empty_cells.width, 0);
  EmissionReader reader(data);
  reader.MoveTo(0.1f);
  EXPECT_EQ(reader.Alone(), 0.0f);
  EXPECT_EQ(reader.AmongAll(), 0.0f);
  reader.MoveTo(0.5f);
  EXPECT_EQ(reader.Alone(), 1.0f);
  EXPECT_EQ(reader.AmongAll(), 1.0f);
  EXPECT_EQ(reader.Alone(), 1.0f);
  reader.MoveTo(0.1f);
  EXPECT_EQ(reader.Alone(), 0.0f);
}

}  // namespace
}  // namespace facet

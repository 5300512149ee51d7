// Reflectances at normal incidence, F0, of substances in air: linear, and as the 8-bit codes of sRGB. Akenine-Moeller,
// Haines, Hoffman, Pesce, Iwanicki and Hillaire, 2018, Real-Time Rendering, fourth edition, tables 9.1 (dielectrics),
// 9.2 (metals) and 9.3 (the diamond and the semiconductor). Ranges have two rows, of their ends. The primaries are
// those of Rec. 709; gold's red lies slightly beyond them, and the book has it clamped to 1.
//
// Lectures round some of these: plastic and glass 0.040 to 0.045 (the book: to 0.05), like diamond from 0.100 (the
// book: from 0.13).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "facet/models/lecture.h"

namespace facet {

struct LecturePresetRow {
  LecturePreset preset;
  const char* word;  // in material files
  std::array<float, 3> linear;
  std::array<std::uint8_t, 3> srgb8;
  enum class Kind : std::uint8_t { Dielectric, Semiconductor, Metal } kind;
};

inline constexpr auto kLecturePresets = [] {
  using enum LecturePreset;
  using Row = LecturePresetRow;
  constexpr auto kMetal = Row::Kind::Metal, kSemiconductor = Row::Kind::Semiconductor;
  const auto dielectric = [](LecturePreset preset, const char* word, float f0, std::uint8_t code) {
    return Row{preset, word, {f0, f0, f0}, {code, code, code}, Row::Kind::Dielectric};
  };
  return std::to_array<Row>({
      {None, "none", {0.0f, 0.0f, 0.0f}, {0, 0, 0}, Row::Kind::Dielectric},
      dielectric(Water, "water", 0.02f, 39),
      dielectric(LivingTissueLow, "living-tissue-low", 0.02f, 39),
      dielectric(LivingTissueHigh, "living-tissue-high", 0.04f, 56),
      dielectric(Skin, "skin", 0.028f, 47),
      dielectric(Eyes, "eyes", 0.025f, 44),
      dielectric(Hair, "hair", 0.046f, 61),
      dielectric(Teeth, "teeth", 0.058f, 68),
      dielectric(FabricLow, "fabric-low", 0.04f, 56),
      dielectric(FabricHigh, "fabric-high", 0.056f, 67),
      dielectric(StoneLow, "stone-low", 0.035f, 53),
      dielectric(StoneHigh, "stone-high", 0.056f, 67),
      dielectric(PlasticLow, "plastic-low", 0.04f, 56),
      dielectric(PlasticHigh, "plastic-high", 0.05f, 63),
      dielectric(GlassLow, "glass-low", 0.04f, 56),
      dielectric(GlassHigh, "glass-high", 0.05f, 63),
      dielectric(CrystalLow, "crystal-low", 0.05f, 63),
      dielectric(CrystalHigh, "crystal-high", 0.07f, 75),
      dielectric(GemsLow, "gems-low", 0.05f, 63),
      dielectric(GemsHigh, "gems-high", 0.08f, 80),
      dielectric(DiamondLikeLow, "diamond-like-low", 0.13f, 101),
      dielectric(DiamondLikeHigh, "diamond-like-high", 0.2f, 124),
      {Diamond, "diamond", {0.171f, 0.172f, 0.176f}, {115, 115, 116}, Row::Kind::Dielectric},
      {Silicon, "silicon", {0.345f, 0.369f, 0.426f}, {159, 164, 174}, kSemiconductor},
      {Titanium, "titanium", {0.542f, 0.497f, 0.449f}, {194, 187, 179}, kMetal},
      {Chromium, "chromium", {0.549f, 0.556f, 0.554f}, {196, 197, 196}, kMetal},
      {Iron, "iron", {0.562f, 0.565f, 0.578f}, {198, 198, 200}, kMetal},
      {Nickel, "nickel", {0.660f, 0.609f, 0.526f}, {212, 205, 192}, kMetal},
      {Platinum, "platinum", {0.673f, 0.637f, 0.585f}, {214, 209, 201}, kMetal},
      {Copper, "copper", {0.955f, 0.638f, 0.538f}, {250, 209, 194}, kMetal},
      {Palladium, "palladium", {0.733f, 0.697f, 0.652f}, {222, 217, 211}, kMetal},
      {Mercury, "mercury", {0.781f, 0.780f, 0.778f}, {229, 228, 228}, kMetal},
      {Brass, "brass", {0.910f, 0.778f, 0.423f}, {245, 228, 174}, kMetal},
      {Zinc, "zinc", {0.664f, 0.824f, 0.850f}, {213, 234, 237}, kMetal},
      {Gold, "gold", {1.000f, 0.782f, 0.344f}, {255, 229, 158}, kMetal},
      {Aluminium, "aluminium", {0.913f, 0.922f, 0.924f}, {245, 246, 246}, kMetal},
      {Silver, "silver", {0.972f, 0.960f, 0.915f}, {252, 250, 245}, kMetal},
  });
}();

inline constexpr auto kLecturePresetWords = [] {
  std::array<const char*, kLecturePresets.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = kLecturePresets[i].word;
  return words;
}();

static_assert(
    [] {
      for (std::size_t i = 0; i < kLecturePresets.size(); ++i) {
        if (kLecturePresets[i].preset != static_cast<LecturePreset>(i)) return false;
      }
      return kLecturePresets.size() == static_cast<std::size_t>(LecturePreset::Silver) + 1;
    }(),
    "the rows stand in the order of the enumeration");

constexpr const LecturePresetRow& PresetOf(LecturePreset preset) {
  return kLecturePresets[static_cast<std::size_t>(preset)];
}

}  // namespace facet

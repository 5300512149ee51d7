#include "stability/stability_case.h"

#include <algorithm>

#include "facet/error.h"
#include "render/hand_built.h"

namespace facet::stability {

namespace {

bool SameCounts(const RenderStats& a, const RenderStats& b) {
  return a.fragments_shaded == b.fragments_shaded && a.fragments_blended == b.fragments_blended &&
         a.covered_pixels == b.covered_pixels && a.triangles_binned == b.triangles_binned &&
         a.triangles_culled == b.triangles_culled && a.triangles_clipped == b.triangles_clipped &&
         a.non_finite_fragments == b.non_finite_fragments && a.warnings == b.warnings;
}

bool IsSound(const Film& film) {
  return std::all_of(film.pixels.begin(), film.pixels.end(), [](const glm::vec4& p) {
    for (int c = 0; c < 4; ++c) {
      if (!(std::isfinite(p[c]) && p[c] >= 0.0f)) return false;
    }
    return p.a <= 1.0f;
  });
}

bool FileIsFinite(const Film& film) {
  const Image image = EncodeFilm(film, {}, ChannelType::F32);
  const float* numbers = image.As<float>();
  return std::all_of(numbers, numbers + image.PixelCount() * 4, [](float v) { return std::isfinite(v); });
}

}  // namespace

Film Draw(const Scene& scene, const RenderSettings& settings, Measured& measured, RenderStats* stats,
          std::uint64_t non_finite) {
  RenderStats own;
  const Film film = Render(scene, settings, &own);
  ++measured.images;
  measured.sanitised += own.non_finite_fragments;
  measured.Expect(IsSound(film), "a number of the film is not finite, negative, or an alpha above 1");
  measured.Expect(FileIsFinite(film), "a number of the file is not finite");
  measured.Expect(
      own.non_finite_fragments == non_finite,
      std::to_string(own.non_finite_fragments) + " fragments were not finite, not " + std::to_string(non_finite));
  for (const Target target : AvailableTargets()) {
    const ScopedTarget forced(target);
    RenderStats other;
    measured.Expect(SameBytes(Render(scene, settings, &other), film),
                    std::string("another picture on ") + TargetName(target));
    measured.Expect(SameCounts(own, other), std::string("other counts on ") + TargetName(target));
  }
  if (stats != nullptr) *stats = own;
  return film;
}

void ExpectRefused(const Scene& scene, const RenderSettings& settings, const std::string& culprit, Measured& measured) {
  try {
    Render(scene, settings);
    measured.Expect(false, culprit + " is not refused");
  } catch (const Error& error) {
    const bool named = std::string(error.what()).find(culprit) != std::string::npos;
    measured.Expect(error.code() == ErrorCode::InvalidInput && named, culprit + ": " + error.what());
  }
}

std::size_t DifferingPixels(const Film& a, const Film& b, float tolerance) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec4 d = glm::abs(a.pixels[i] - b.pixels[i]);
    count += !(d.x <= tolerance && d.y <= tolerance && d.z <= tolerance && d.w <= tolerance);
  }
  return count;
}

double LargestRelativeDifference(const Film& a, const Film& b, double floor) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      const double x = a.pixels[i][c], y = b.pixels[i][c];
      largest = std::max(largest, std::fabs(x - y) / std::max({std::fabs(x), std::fabs(y), floor}));
    }
  }
  return largest;
}

}  // namespace facet::stability

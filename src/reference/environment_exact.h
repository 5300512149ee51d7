// The environment for the reference: its image in double, with importance sampling of bright parts.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/memory_budget.h"
#include "facet/settings.h"

namespace facet {

// The equirectangular image with bilinear interpolation between pixel centres, which the rasterizer prefilters and
// shows as a background. Directions are unit, in world axes. Immutable.
class ExactEnvironment {
 public:
  // For Kind::Studio or Kind::Image. Throws Error(InvalidUsage) for a broken image.
  explicit ExactEnvironment(const EnvironmentSettings& settings);

  struct Light {
    glm::dvec3 direction{0.0};
    glm::dvec3 radiance{0.0};
    double density = 0.0;  // probability density of the direction, in 1/steradian
  };
  Light Toward(const glm::dvec3& direction) const;

  // Samples a direction with a density proportional to the image's luminance (mean of R, G, B), except that the solid
  // angle is constant within a row. `random`: uniform in (0, 1)^2; neighbouring points give neighbouring directions.
  // Not for a black image.
  Light Sample(const glm::dvec2& random) const;
  bool IsBlack() const { return !(total_ > 0.0); }

 private:
  // The bilinear patch between four pixels' centres. Above the first row's and below the last row's there are patches
  // of half a pixel's height, that do not change along it; so there are height + 1 bands of patches.
  struct Patch {
    const float* corner[4];  // RGB: top left, top right, bottom left, bottom right
    double Luminance(int corner_index) const;
  };
  Patch PatchAt(int band, int column) const;
  double BandTop(int band) const { return band == 0 ? -0.5 : band - 1.0; }  // in pixels from the first row's centre
  double BandHeight(int band) const { return band == 0 || band == height_ ? 0.5 : 1.0; }
  Light Read(int band, int column, double x, double y, double sine_of_polar) const;
  glm::dvec3 ToWorld(const glm::dvec3& d) const;

  int width_ = 0, height_ = 0;
  MemoryLease held_;  // of all vectors here
  std::vector<float> rgb_;
  double cosine_ = 1.0, sine_ = 0.0;  // of the rotation
  double intensity_ = 1.0;
  std::vector<double> sine_of_band_;  // of the polar angle at each band's middle
  // Running sums of luminance * area * that sine: of each band's patches, and of the bands.
  std::vector<double> in_band_, bands_;
  double total_ = 0.0;
};

}  // namespace facet

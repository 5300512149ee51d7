#include "light/irradiance_harmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace facet {
namespace {

using Basis = std::array<double, 9>;

// The real spherical harmonics of degrees 0, 1 and 2, without their normalisation, which is part of kFactor.
Basis HarmonicsAt(const glm::dvec3& d) {
  return {1.0, d.x, d.y, d.z, d.x * d.y, d.y * d.z, d.x * d.z, 3.0 * d.z * d.z - 1.0, d.x * d.x - d.y * d.y};
}

// For each harmonic the square of its normalisation constant times 4 pi (1; 3; 15; 5/4; 15/4), times the coefficient of
// the clamped cosine for its degree (1, 2/3, 1/4).
constexpr Basis kFactor = {1.0, 2.0, 2.0, 2.0, 15.0 / 4.0, 15.0 / 4.0, 15.0 / 4.0, 5.0 / 16.0, 15.0 / 16.0};

// The direction of a node of the octahedral square.
glm::dvec3 DirectionOf(std::int32_t i, std::int32_t j, std::int32_t size) {
  const double u = 2.0 * i / size - 1.0, v = 2.0 * j / size - 1.0;
  const double y = 1.0 - std::fabs(u) - std::fabs(v);
  const double x = y < 0.0 ? std::copysign(1.0 - std::fabs(v), u) : u;
  const double z = y < 0.0 ? std::copysign(1.0 - std::fabs(u), v) : v;
  return glm::normalize(glm::dvec3(x, y, z));
}

}  // namespace

void FillIrradianceFromHarmonics(const std::vector<SourceTexel>& source, std::int32_t size, float* out) {
  std::array<glm::dvec3, 9> coefficients{};
  double solid_angle = 0.0;
  for (const SourceTexel& texel : source) {
    const Basis basis = HarmonicsAt({texel.x, texel.y, texel.z});
    for (std::size_t k = 0; k < 9; ++k) coefficients[k] += glm::dvec3(texel.r, texel.g, texel.b) * basis[k];
    solid_angle += double(texel.solid_angle);
  }
  for (std::size_t k = 0; k < 9; ++k) coefficients[k] *= kFactor[k] / solid_angle;
  for (std::int32_t j = 0; j <= size; ++j) {
    for (std::int32_t i = 0; i <= size; ++i, out += 4) {
      const Basis basis = HarmonicsAt(DirectionOf(i, j, size));
      glm::dvec3 sum(0.0);
      for (std::size_t k = 0; k < 9; ++k) sum += coefficients[k] * basis[k];
      for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(std::max(sum[c], 0.0));
    }
  }
}

}  // namespace facet

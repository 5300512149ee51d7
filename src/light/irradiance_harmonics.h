// Irradiance from nine spherical-harmonic coefficients per channel.
#pragma once

#include <cstdint>
#include <vector>

#include "light/environment_kernels.h"

namespace facet {

// Fills an octahedral square of (size + 1) x (size + 1) texels of 4 floats (see EnvironmentMap) with the irradiance,
// divided by pi, of the environment whose texels are `source`, approximated by spherical harmonics up to degree 2 and
// clamped to 0 from below. Source: Ramamoorthi and Hanrahan, 2001, An Efficient Representation for Irradiance
// Environment Maps, equations 2 to 9.
void FillIrradianceFromHarmonics(const std::vector<SourceTexel>& source, std::int32_t size, float* out);

}  // namespace facet

// How much light the specular lobe reflects, by integration: what the rasterizer reads from its DfgTable.
#pragma once

#include <memory>
#include <vector>

namespace facet {

// Directional albedo of single-scattering GGX with height-correlated Smith: F0 * a + b where Fresnel is Schlick's with
// F0.
struct ExactAlbedo {
  double a = 0.0, b = 0.0;
};

// By quadrature, to 1e-7. `n_dot_v` in [0, 1], `alpha` in (0, 1].
//
// The integral over the light's azimuth is done in closed form for a + b, and for b up to what Schlick's weight changes
// over the lobe, which is summed by the trapezoidal rule in the logarithm of the half azimuth's tangent: there the
// lobe's poles stand at least pi / 2 away from the real axis, so that the sum converges exponentially at every
// roughness. Over the light's elevation pieces of Gauss and Legendre's rule grow geometrically away from the lobe's
// peak and from the horizon.
ExactAlbedo IntegrateAlbedo(double n_dot_v, double alpha);

// The albedo at one roughness, as a function of the cosine.
class AlbedoRow {
 public:
  ExactAlbedo At(double n_dot_v) const;
  // Over the hemisphere: 2 * integral of mu d mu.
  ExactAlbedo Average() const { return average_; }

 private:
  friend class AlbedoSurface;
  static constexpr int kPanels = 10, kNodes = 11;
  double coefficients_[kPanels][kNodes][2];  // of Chebyshev's polynomials; a, b
  ExactAlbedo average_;
};

// The quadrature above over all cosines and roughnesses, interpolated by polynomials of degree 10 in the fourth root of
// the cosine and 7 in the logarithm of perceptual roughness, in pieces. Differs from it by less than 1e-7 (measured in
// tests/reference), a fifty thousandth of what the DfgTable may be off. Immutable.
class AlbedoSurface {
 public:
  // Runs in parallel: not to be called from within ParallelFor.
  static const AlbedoSurface& Shared();

  // `perceptual_roughness` in [kMinPerceptualRoughness, 1].
  AlbedoRow Row(double perceptual_roughness) const;
  // The same at one cosine, where the roughness is another each time.
  ExactAlbedo At(double n_dot_v, double perceptual_roughness) const;

 private:
  AlbedoSurface();
  static constexpr int kPanels = 8, kNodes = 8;
  std::vector<AlbedoRow> coefficients_;  // [panel][polynomial] over the logarithm of roughness
};

}  // namespace facet

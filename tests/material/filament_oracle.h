// Filament's shading models a second time, in double, from the formulas of its documentation in other forms than the
// project's: what the tests of the model compare it with. Axes: the normal is +Z, the tangent +X, the bitangent +Y.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace facet::filament_oracle {

inline constexpr double kPi = 3.14159265358979324;

struct Dfg {
  double x = 0.0, y = 0.0;  // Filament's: reflectance is mix(x, y, f0)
};

// The material's parameters by Filament's names, all scalar inputs in their ranges.
struct Inputs {
  glm::dvec3 baseColor{1.0};
  double metallic = 0.0, roughness = 1.0, reflectance = 0.5;
  bool hasSpecularFactor = false;
  double specularFactor = 1.0;
  glm::dvec3 specularColorFactor{1.0};
  bool hasSheen = false;
  glm::dvec3 sheenColor{0.0};
  double sheenRoughness = 0.0;
  bool hasClearCoat = false, clearCoatIorChange = true;
  double clearCoat = 0.0, clearCoatRoughness = 0.0;
  glm::dvec3 clearCoatNormal{0.0, 0.0, 1.0};
  bool hasAnisotropy = false;
  double anisotropy = 0.0;
  bool isSpecularGlossiness = false;
  glm::dvec3 specularColor{0.0};
  double glossiness = 0.0;
  double transmission = 0.0;
  bool hasSubsurfaceColor = false;
  glm::dvec3 subsurfaceColor{0.0};
  double subsurfacePower = 12.234, thickness = 0.5;
};

inline double Saturate(double x) { return std::clamp(x, 0.0, 1.0); }
inline glm::dvec3 Saturate(const glm::dvec3& v) { return glm::clamp(v, 0.0, 1.0); }
inline double Max3(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// GGX by the tangent of the angle (Walter et al., 2007, equation 33 as printed).
inline double D_GGX(double n_dot_h, double alpha) {
  if (n_dot_h <= 0.0) return alpha * alpha / kPi;  // its limit, which facets behind the horizon of a coat have
  const double c2 = n_dot_h * n_dot_h, tan2 = (1.0 - c2) / c2, a2 = alpha * alpha;
  return a2 / (kPi * c2 * c2 * (a2 + tan2) * (a2 + tan2));
}

// Anisotropic GGX by slopes (Heitz, 2014, equation 85).
inline double D_GGX(const glm::dvec3& h, double at, double ab) {
  if (h.z <= 0.0) return 0.0;
  const double sx = h.x / h.z / at, sy = h.y / h.z / ab, s = 1.0 + sx * sx + sy * sy;
  return 1.0 / (kPi * at * ab * h.z * h.z * h.z * h.z * s * s);
}

// Smith's Lambda for GGX, and the height-correlated masking and shadowing over 4 cos cos (Heitz, 2014, 72, 86 and 99).
inline double Lambda(const glm::dvec3& w, double at, double ab) {
  const double tan2 = (at * at * w.x * w.x + ab * ab * w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1.0 + tan2) - 1.0);
}
inline double V_Smith(const glm::dvec3& v, const glm::dvec3& l, double at, double ab) {
  return 1.0 / ((1.0 + Lambda(v, at, ab) + Lambda(l, at, ab)) * 4.0 * v.z * l.z);
}

inline glm::dvec3 F_Schlick(const glm::dvec3& f0, double f90, double cosine) {
  return glm::mix(f0, glm::dvec3(f90), std::pow(1.0 - cosine, 5.0));
}

inline double D_Charlie(double n_dot_h, double alpha) {
  const double theta = std::acos(std::min(n_dot_h, 1.0));
  return (2.0 + 1.0 / alpha) * std::pow(std::sin(theta), 1.0 / alpha) / (2.0 * kPi);
}
inline double V_Neubelt(double n_dot_v, double n_dot_l) {
  return 1.0 / (4.0 * (n_dot_l + n_dot_v - n_dot_l * n_dot_v));
}

struct Pixel {
  glm::dvec3 diffuse{0.0}, f0{0.0};
  double f90 = 1.0, roughness = 1.0, alpha = 1.0;  // perceptual, and its square
};

inline Pixel PixelOf(const Inputs& in) {
  Pixel p;
  if (in.isSpecularGlossiness) {
    p.diffuse = in.baseColor * (1.0 - Max3(in.specularColor));
    p.f0 = in.specularColor;
    p.roughness = 1.0 - in.glossiness;
  } else {
    glm::dvec3 dielectric(0.16 * in.reflectance * in.reflectance);
    if (in.hasSpecularFactor) {
      dielectric = glm::min(dielectric * in.specularColorFactor, 1.0) * in.specularFactor;
    }
    p.diffuse = in.baseColor * (1.0 - in.metallic);
    p.f0 = glm::mix(dielectric, in.baseColor, in.metallic);
    p.roughness = in.roughness;
  }
  p.f90 = in.hasSpecularFactor && !in.isSpecularGlossiness ? glm::mix(in.specularFactor, 1.0, in.metallic)
                                                           : Saturate(glm::dot(p.f0, glm::dvec3(50.0 * 0.33)));
  if (in.hasClearCoat) {
    const double coat = std::clamp(in.clearCoatRoughness, 0.045, 1.0);
    if (in.clearCoatIorChange) {
      const glm::dvec3 f = p.f0;
      const glm::dvec3 under = Saturate(f * (f * (0.941892 - 0.263008 * f) + 0.346479) - 0.0285998);
      p.f0 = glm::mix(f, under, in.clearCoat);
    }
    p.roughness = glm::mix(p.roughness, std::max(p.roughness, coat), in.clearCoat);
  }
  p.roughness = std::clamp(p.roughness, 0.045, 1.0);
  p.alpha = p.roughness * p.roughness;
  return p;
}

inline glm::dvec3 Compensation(const Pixel& p, Dfg dfg) { return 1.0 + p.f0 * (1.0 / dfg.y - 1.0); }

inline glm::dvec3 Specular(const Inputs& in, const Pixel& p, const glm::dvec3& v, const glm::dvec3& l) {
  const glm::dvec3 h = glm::normalize(v + l);
  const glm::dvec3 f = F_Schlick(p.f0, p.f90, glm::dot(v, h));
  if (!in.hasAnisotropy) return f * (D_GGX(h.z, p.alpha) * V_Smith(v, l, p.alpha, p.alpha));
  const double at = std::max(p.alpha * (1.0 + in.anisotropy), 0.045 * 0.045);
  const double ab = std::max(p.alpha * (1.0 - in.anisotropy), 0.045 * 0.045);
  return f * (D_GGX(h, at, ab) * V_Smith(v, l, at, ab));
}

// The BSDF times the cosine. `dfg`: at the pixel's roughness; `cloth`: the albedo of the sheen's fibres; where it is
// above 1, the project divides them by it.
inline glm::dvec3 Lit(const Inputs& in, const glm::dvec3& v, const glm::dvec3& l, Dfg dfg, double cloth) {
  if (l.z <= 0.0) return glm::dvec3(0.0);
  const Pixel p = PixelOf(in);
  const glm::dvec3 h = glm::normalize(v + l);
  glm::dvec3 color = p.diffuse / kPi * (1.0 - in.transmission) + Specular(in, p, v, l) * Compensation(p, dfg);
  if (in.hasSheen) {
    const double r = std::max(in.sheenRoughness, 0.07);
    color = color * (1.0 - Max3(in.sheenColor) * std::min(cloth, 1.0)) +
            in.sheenColor * (D_Charlie(h.z, r * r) * V_Neubelt(v.z, l.z) / std::max(cloth, 1.0));
  }
  color *= l.z;
  if (in.hasClearCoat) {
    const double r = std::clamp(in.clearCoatRoughness, 0.045, 1.0), l_dot_h = glm::dot(l, h);
    const double fresnel = (0.04 + 0.96 * std::pow(1.0 - l_dot_h, 5.0)) * in.clearCoat;
    const glm::dvec3 n = glm::normalize(in.clearCoatNormal);
    const double coat = D_GGX(glm::dot(n, h), r * r) * 0.25 / (l_dot_h * l_dot_h) * fresnel;
    color = color * (1.0 - fresnel) + coat * std::max(glm::dot(n, l), 0.0);
  }
  return color;
}

inline glm::dvec3 Cloth(const Inputs& in, const glm::dvec3& v, const glm::dvec3& l, double cloth) {
  const double r = std::max(in.roughness, 0.07), n_dot_l = std::max(l.z, 0.0);
  const glm::dvec3 h = glm::normalize(v + l);
  const glm::dvec3 sheen = in.hasSheen ? in.sheenColor : glm::sqrt(in.baseColor);
  glm::dvec3 diffuse = in.baseColor / kPi;
  if (in.hasSubsurfaceColor) {
    diffuse *= Saturate((l.z + 0.5) / 2.25);
    diffuse *= Saturate(in.subsurfaceColor + n_dot_l);
  } else {
    diffuse *= n_dot_l;
  }
  if (n_dot_l == 0.0) return diffuse;
  return diffuse + sheen * (D_Charlie(h.z, r * r) * V_Neubelt(v.z, n_dot_l) * n_dot_l / std::max(cloth, 1.0));
}

inline glm::dvec3 Subsurface(const Inputs& in, const glm::dvec3& v, const glm::dvec3& l, Dfg dfg) {
  const Pixel p = PixelOf(in);
  const double n_dot_l = std::max(l.z, 0.0), thick = Saturate(in.thickness);
  glm::dvec3 color = p.diffuse / kPi * n_dot_l;
  if (l.z > 0.0) color += Specular(in, p, v, l) * Compensation(p, dfg) * n_dot_l;
  const double along = Saturate(-glm::dot(v, l));
  const double forward = std::exp2(in.subsurfacePower * (along - 1.0));
  const double back = Saturate(n_dot_l * thick + 1.0 - thick) * 0.5;
  const glm::dvec3 tint = in.hasSubsurfaceColor ? in.subsurfaceColor : glm::dvec3(1.0);
  return color + tint * (glm::mix(back, 1.0, forward) * (1.0 - thick) / kPi);
}

}  // namespace facet::filament_oracle

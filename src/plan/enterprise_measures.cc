#include "plan/enterprise_measures.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/round_to_float.h"
#include "scene/topology.h"

namespace facet {
namespace {

bool HasUv(const Primitive& mesh) { return !mesh.tex_coords.empty() && !mesh.tex_coords[0].empty(); }

bool IsFiniteVector(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

double MetresPerUnit(const Drawable& drawable) {
  return Cbrt(std::fabs(glm::determinant(glm::dmat3(drawable.world_from_mesh))));
}

bool PassesVolume(const EnterpriseParameters& p) {
  return !p.thin_walled && (p.transparency.value != 0.0f || p.translucency.value != 0.0f);
}

bool IsPower(const EnterpriseParameters& p) {
  return p.emission_mode == EnterpriseEmissionMode::LuminousPower && p.emission_value != 0.0f;
}

}  // namespace

MeshMeasures MeasureMesh(const Drawable& drawable) {
  const Primitive& mesh = *drawable.geometry;
  MeshMeasures measures;
  if (ClassOf(mesh.topology) != PrimitiveClass::Triangles || mesh.positions.empty()) return measures;
  const glm::dmat3 linear(drawable.world_from_mesh);
  const bool has_uv = HasUv(mesh);
  // Near the mesh, so that the volumes of the pyramids over its triangles do not cancel.
  const glm::dvec3 origin(mesh.positions[0]);
  double volume6 = 0.0, area2 = 0.0, uv_area2 = 0.0;
  for (std::uint32_t i = 0; i < PrimitiveCount(mesh); ++i) {
    const std::array<std::uint32_t, 3> v = PrimitiveVertices(mesh, i);
    const auto corner = [&](int k) { return linear * (glm::dvec3(mesh.positions[v[std::size_t(k)]]) - origin); };
    const glm::dvec3 a = corner(0), cross = glm::cross(corner(1) - a, corner(2) - a);
    if (!IsFiniteVector(cross)) continue;
    area2 += glm::length(cross);
    volume6 += glm::dot(a, cross);
    if (!has_uv) continue;
    const auto uv = [&](int k) { return glm::dvec2(mesh.tex_coords[0][v[std::size_t(k)]]); };
    const glm::dvec2 p = uv(1) - uv(0), q = uv(2) - uv(0);
    const double in_uv = std::fabs(p.x * q.y - p.y * q.x);
    if (std::isfinite(in_uv)) uv_area2 += in_uv;
  }
  measures.area = 0.5 * area2;
  if (area2 > 0.0) measures.mean_chord = 4.0 * (std::fabs(volume6) / 6.0) / measures.area;
  if (uv_area2 > 0.0) measures.metres_per_uv = std::sqrt(area2 / uv_area2);
  return measures;
}

EnterpriseMeasures MeasuresFor(const EnterpriseParameters& p, const Drawable& drawable) {
  const bool has_flakes = p.flake_coverage.value != 0.0f, has_volume = PassesVolume(p);
  const bool needs_mesh = IsPower(p) || (has_volume && p.thickness == 0.0f) || (has_flakes && p.texture_scale == 0.0f);
  const MeshMeasures mesh = needs_mesh ? MeasureMesh(drawable) : MeshMeasures{};
  EnterpriseMeasures measures{};
  if (IsPower(p)) measures[0] = mesh.area > 0.0 ? RoundToFiniteFloat(double(p.emission_value) / mesh.area) : 0.0f;
  if (has_volume) {
    const double unit = MetresPerUnit(drawable);
    measures[1] = p.thickness != 0.0f ? p.thickness : unit > 0.0 ? RoundToFiniteFloat(mesh.mean_chord / unit) : 0.0f;
  }
  // Without texture coordinates the flakes have no place, and their mean is shown.
  if (has_flakes && HasUv(*drawable.geometry)) {
    measures[2] = p.texture_scale == 0.0f ? RoundToFiniteFloat(mesh.metres_per_uv) : p.texture_scale;
  }
  return measures;
}

EnterpriseParameters WithMeasures(EnterpriseParameters p, const EnterpriseMeasures& measures) {
  if (IsPower(p)) {
    p.emission_mode = EnterpriseEmissionMode::LuminousEmittance;
    p.emission_value = measures[0];
  }
  p.thickness = measures[1];
  p.texture_scale = measures[2];
  return p;
}

}  // namespace facet

// What a surface shows: its own light, and what is seen through it by tracing rays through the scene
// (KHR_materials_transmission, KHR_materials_volume, KHR_materials_dispersion).
//
// A thin wall lets a ray go on straight, spread by the wall's roughness. Where a volume begins, the ray is refracted
// at a microfacet by Snell's law, is absorbed along its way, and is refracted again where it leaves the mesh, at the
// back of a triangle; where Snell's law has no solution there, all is reflected inside. Dispersion sends a ray for each
// of red, green and blue. Media may lie inside others. Where a ray does not meet a back of the same mesh, the mesh is
// not closed, and the medium is a slab of the stated thickness, as in the rasterizer. A back that is not an exit, of a
// double-sided material, is a thin wall, likewise.
//
// What the rays meet is shaded as the camera would see it from there. Not part of the model:
//   - The reflection of light by the inside of a surface, unless it reflects all; so what goes in comes out. The base
//     colour counts where a medium is entered, only.
//   - Light that is bent on its way to a surface (caustics): lamps and the environment light the surfaces inside or
//     behind glass as if it were not there.
//   - What has been refracted or reflected kMostCrossings times and is still on its way: it counts as black.
//   - A camera inside a medium: it is taken to be outside of all.
//   - Anisotropy of what passes: microfacets are as wide along the tangent as across.
//   - Points and lines, which have no place in space (ExactRays).
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "plan/frame_plan.h"
#include "reference/geometry_exact.h"
#include "reference/material_exact.h"
#include "reference/radiance_exact.h"
#include "reference/rays_exact.h"
#include "reference/transmission_exact.h"
#include "scene/pose.h"

namespace facet {

// Immutable but for its count; thread-safe. Refers to all that it is made of.
class ExactTracer {
 public:
  static constexpr int kMostCrossings = 64;

  // `background`: what rays see that meet nothing; null: nothing.
  ExactTracer(const ExactGeometry& geometry, const PosedScene& posed, const FramePlan& plan,
              const std::vector<ExactMaterial>& materials, const ExactLight& light, const ExactEnvironment* background);

  // What a hit of a ray of the camera shows. `run`: of its own light, with a pair of 1 to 65535; what is seen through
  // it takes pairs from kPairsApart times that on.
  struct Shown {
    glm::dvec3 light{0.0};
    glm::dvec3 through{0.0};  // the share of what it shows that comes through it from nowhere
    double Alpha() const { return 1.0 - (through.x + through.y + through.z) / 3.0; }  // `light` is premultiplied by it
    double coverage = 1.0;  // of the surface: its base colour's alpha
  };
  Shown Shade(const ExactGeometry::Hit& hit, const SampleRun& run) const;
  // Whether any material lets light pass.
  bool Traces() const { return rays_.has_value(); }

  // How often a surface's light was not finite, and became black and transparent.
  std::uint64_t NonFinite() const { return non_finite_; }
  // How many rays were still on their way after kMostCrossings.
  std::uint64_t GivenUp() const { return given_up_; }

 private:
  static constexpr std::uint32_t kPairsApart = 1u << 16;
  static constexpr int kMostMedia = 4;

  // What has been seen: light, and the share of what lies behind everything that is let through.
  struct Seen {
    glm::dvec3 light{0.0}, through{0.0};
  };
  struct Medium {
    std::uint32_t drawable = 0;
    glm::dvec3 ior{1.0}, absorption{0.0};
  };
  // The media that a ray is in, by the order in which it entered them. The last one counts; more than kMostMedia are
  // not told apart.
  class Media {
   public:
    bool Any() const { return count_ > 0; }
    glm::dvec3 Ior() const { return Any() ? media_[count_ - 1].ior : glm::dvec3(1.0); }
    glm::dvec3 Passing(double distance) const;
    Media With(const Medium& medium) const;
    // Without the last one of the mesh that the drawable belongs to, or the last one of all.
    Media Without(const std::vector<Drawable>& drawables, std::uint32_t drawable) const;

   private:
    Medium media_[kMostMedia];
    int count_ = 0;
  };
  // A ray on its way.
  struct Way {
    ExactRay ray;
    Media media;
    int channel = -1;  // whose index of refraction counts; -1: those of all are equal
    int left = kMostCrossings;
  };
  // Hands out the random numbers of one sample of a pixel, each pair once.
  struct Random {
    const SampleSequence& sequence;
    std::uint32_t pair, index, environment_samples;
    SampleRun Run() {
      pair += kPairsOfRadiance;
      return {sequence, pair - kPairsOfRadiance, index};
    }
    glm::dvec2 Point() { return sequence.Point(pair++, index / environment_samples); }
  };

  const ExactMaterial& MaterialOf(std::uint32_t drawable) const {
    return materials_[std::size_t(plan_.material_of_drawable[drawable])];
  }
  // Whether the material bounds a medium.
  bool BoundsMedium(std::uint32_t drawable) const;
  bool IsSeen(const ExactRays::Hit& hit, const ExactRay& ray, bool inside) const;
  SurfacePoint PointOf(const ExactRays::Hit& hit, const ExactRay& ray) const {
    return geometry_.SurfaceOf(hit.triangle, hit.weight, hit.is_back, -ray.direction);
  }
  Seen Along(Way way, Random& random) const;
  Seen Surface(const SurfacePoint& point, const glm::dvec3& base_color, const TriangleId& triangle, bool is_back,
               const SampleRun& run, const Way& way, Random& random) const;
  Seen Behind(const ExactEntry& entry, const SurfacePoint& point, const TriangleId& triangle, bool is_back, Way way,
              Random& random) const;
  Seen Enter(const ExactEntry& entry, const glm::dvec3& facet, Way way, Random& random) const;
  Seen ThroughSlab(const ExactEntry& entry, double ratio, const Way& inside, const Way& outside, Random& random) const;
  Seen Leave(const ExactRays::Hit& hit, Way way, Random& random) const;
  bool IsClosed(const Way& inside) const;

  const ExactGeometry& geometry_;
  const PosedScene& posed_;
  const FramePlan& plan_;
  const std::vector<ExactMaterial>& materials_;
  const ExactLight& light_;
  const ExactEnvironment* const background_;
  std::optional<ExactRays> rays_;  // if any material transmits
  mutable std::atomic<std::uint64_t> non_finite_{0}, given_up_{0};
};

}  // namespace facet

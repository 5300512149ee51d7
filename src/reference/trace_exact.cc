#include "reference/trace_exact.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "reference/models_exact.h"

namespace facet {

ExactTracer::ExactTracer(const ExactGeometry& geometry, const PosedScene& posed, const FramePlan& plan,
                         const std::vector<ExactMaterial>& materials, const ExactLight& light,
                         const ExactEnvironment* background)
    : geometry_(geometry), posed_(posed), plan_(plan), materials_(materials), light_(light), background_(background) {
  const bool any = std::any_of(materials.begin(), materials.end(),
                               [](const ExactMaterial& m) { return m.Frame().Has(kTransmission); });
  if (any) rays_.emplace(geometry);
}

glm::dvec3 ExactTracer::Media::Passing(double distance) const {
  if (!Any()) return glm::dvec3(1.0);
  const glm::dvec3& a = media_[count_ - 1].absorption;
  const auto of = [&](double absorption) { return Exp(std::max(-absorption * distance, -700.0)); };
  return {of(a.x), of(a.y), of(a.z)};
}

ExactTracer::Media ExactTracer::Media::With(const Medium& medium) const {
  Media more = *this;
  if (more.count_ == kMostMedia) std::copy(more.media_ + 1, more.media_ + kMostMedia, more.media_);
  more.count_ = std::min(more.count_ + 1, kMostMedia);
  more.media_[more.count_ - 1] = medium;
  return more;
}

ExactTracer::Media ExactTracer::Media::Without(const std::vector<Drawable>& drawables, std::uint32_t drawable) const {
  Media fewer = *this;
  if (!Any()) return fewer;
  int gone = count_ - 1;
  for (int i = 0; i < count_; ++i) {
    const Drawable &a = drawables[media_[i].drawable], &b = drawables[drawable];
    if (a.node == b.node && a.mesh == b.mesh) gone = i;
  }
  std::copy(fewer.media_ + gone + 1, fewer.media_ + count_, fewer.media_ + gone);
  --fewer.count_;
  return fewer;
}

bool ExactTracer::BoundsMedium(std::uint32_t drawable) const {
  const FrameMaterial& frame = MaterialOf(drawable).Frame();
  return frame.Has(kTransmission) && frame.Has(kVolume);
}

// As the camera sees surfaces; from inside a medium, the backs of its bounds are seen as well.
bool ExactTracer::IsSeen(const ExactRays::Hit& hit, const ExactRay& ray, bool inside) const {
  const ExactMaterial& material = MaterialOf(hit.triangle.drawable);
  const FrameMaterial& frame = material.Frame();
  if (hit.is_back && !frame.Has(kDoubleSided) && !(inside && BoundsMedium(hit.triangle.drawable))) return false;
  if (frame.alpha_mode != AlphaMode::Mask) return true;
  return material.BaseColor(PointOf(hit, ray)).w >= double(frame.factors.alpha_cutoff);
}

ExactTracer::Shown ExactTracer::Shade(const ExactGeometry::Hit& hit, const SampleRun& run) const {
  const SurfacePoint point = geometry_.SurfaceAt(hit);
  const TriangleId triangle = geometry_.TriangleOf(hit);
  const glm::dvec4 base = MaterialOf(triangle.drawable).BaseColor(point);
  Random random{run.sequence, run.pair * kPairsApart, run.index, light_.environment_samples};
  const Seen seen = Surface(point, glm::dvec3(base), triangle, geometry_.IsBack(hit), run, Way{}, random);
  const Shown shown{seen.light, seen.through, std::clamp(base.w, 0.0, 1.0)};
  if (std::isfinite(shown.light.x + shown.light.y + shown.light.z + shown.Alpha() + base.w)) return shown;
  ++non_finite_;
  return {glm::dvec3(0.0), glm::dvec3(0.0), 0.0};
}

ExactTracer::Seen ExactTracer::Surface(const SurfacePoint& point, const glm::dvec3& base_color,
                                       const TriangleId& triangle, bool is_back, const SampleRun& run, const Way& way,
                                       Random& random) const {
  const ExactMaterial& material = MaterialOf(triangle.drawable);
  Seen seen{RadianceByModel(material, base_color, point, light_, run), glm::dvec3(0.0)};
  if (!material.Frame().Has(kTransmission)) return seen;
  const ExactEntry entry = EntryAt(material, base_color, point, light_);
  seen.light += entry.punctual;
  if (entry.tint == glm::dvec3(0.0)) return seen;
  if (way.left == 0) {
    ++given_up_;
    return seen;
  }
  const Seen behind = Behind(entry, point, triangle, is_back, way, random);
  seen.light += entry.tint * behind.light;
  seen.through = entry.tint * behind.through;
  return seen;
}

// `way`: on which the surface has been met.
ExactTracer::Seen ExactTracer::Behind(const ExactEntry& entry, const SurfacePoint& point, const TriangleId& triangle,
                                      bool is_back, Way way, Random& random) const {
  --way.left;
  way.ray.origin = point.position;
  way.ray.from = triangle;
  const glm::dvec2 pair = random.Point();
  if (is_back || !BoundsMedium(triangle.drawable)) {
    const ThinWallSample sample = PassThinWall(entry, light_.albedos, pair, random.Point().x);
    way.ray.direction = sample.direction;
    Seen seen = Along(way, random);
    seen.light *= sample.weight;
    return seen;
  }
  const glm::dvec3 facet = SampleFacet(entry.at, pair);
  const glm::dvec3& ior = entry.at.ior;
  if (way.channel >= 0 || (ior.x == ior.y && ior.y == ior.z)) return Enter(entry, facet, way, random);
  Seen seen;
  for (int c = 0; c < 3; ++c) {
    way.channel = c;
    const Seen of_one = Enter(entry, facet, way, random);
    seen.light[c] = of_one.light[c];
    seen.through[c] = of_one.through[c];
  }
  return seen;
}

// Into the medium behind a surface. `way`: in front of it, already at the surface.
ExactTracer::Seen ExactTracer::Enter(const ExactEntry& entry, const glm::dvec3& facet, Way way, Random& random) const {
  const int c = std::max(way.channel, 0);
  const double ratio = way.media.Ior()[c] / entry.at.ior[c];
  std::optional<glm::dvec3> refracted = Refracted(-entry.at.view, facet, ratio);
  if (!refracted) {
    way.ray.direction = Before(entry.at, Reflected(-entry.at.view, facet));
    return Along(way, random);
  }
  Way inside = way;
  inside.ray.direction = Beyond(entry.at, *refracted);
  inside.media = way.media.With({way.ray.from.drawable, entry.at.ior, entry.absorption});
  return IsClosed(inside) ? Along(inside, random) : ThroughSlab(entry, ratio, inside, way, random);
}

// Whether the ray leaves the medium somewhere: what it meets first, or what of the same mesh it meets at all, is the
// back of a surface that bounds a medium.
bool ExactTracer::IsClosed(const Way& inside) const {
  const Drawable& entered = posed_.drawables[inside.ray.from.drawable];
  const auto first = rays_->Nearest(inside.ray, [&](const auto& hit) { return IsSeen(hit, inside.ray, true); });
  if (!first) return false;
  if (first->is_back && BoundsMedium(first->triangle.drawable)) return true;
  const auto exit = rays_->Nearest(inside.ray, [&](const auto& hit) {
    const Drawable& met = posed_.drawables[hit.triangle.drawable];
    return hit.is_back && met.node == entered.node && met.mesh == entered.mesh && BoundsMedium(hit.triangle.drawable) &&
           IsSeen(hit, inside.ray, true);
  });
  return exit.has_value();
}

// Through a medium between this surface and a parallel one, at the stated distance along the ray, which is not there.
// `ratio`: of the indices outside and inside.
ExactTracer::Seen ExactTracer::ThroughSlab(const ExactEntry& entry, double ratio, const Way& inside, const Way& outside,
                                           Random& random) const {
  const auto met = rays_->Nearest(inside.ray, [&](const auto& hit) {
    return hit.distance < entry.thickness && IsSeen(hit, inside.ray, outside.media.Any());
  });
  Way way = outside;
  double path = entry.thickness;
  if (met) {
    // Something stands inside: the slab ends in front of it.
    path = met->distance;
    way.ray.direction = inside.ray.direction;
  } else {
    way.ray.origin = inside.ray.origin + inside.ray.direction * path;
    const auto left = Refracted(inside.ray.direction, entry.at.normal, 1.0 / ratio);
    way.ray.direction = Beyond(entry.at, left ? *left : -entry.at.view);
  }
  const glm::dvec3 passing = inside.media.Passing(path);
  const Seen seen = Along(way, random);
  return {seen.light * passing, seen.through * passing};
}

ExactTracer::Seen ExactTracer::Along(Way way, Random& random) const {
  const bool inside = way.media.Any();
  Seen sum;
  glm::dvec3 rest(1.0);  // what the surfaces so far let pass
  const auto add = [&](const Seen& seen, double share) {
    sum.light += rest * seen.light * share;
    sum.through += rest * seen.through * share;
  };
  for (;;) {
    const auto hit = rays_->Nearest(way.ray, [&](const auto& h) { return IsSeen(h, way.ray, inside); });
    if (!hit) {
      // A medium that has no end lets nothing pass that it absorbs at all.
      if (inside) rest *= way.media.Passing(1e30);
      const bool is_nothing = background_ == nullptr;
      add(is_nothing ? Seen{glm::dvec3(0.0), glm::dvec3(1.0)}
                     : Seen{background_->Toward(way.ray.direction).radiance, glm::dvec3(0.0)},
          1.0);
      return sum;
    }
    rest *= way.media.Passing(hit->distance);
    if (inside && hit->is_back && BoundsMedium(hit->triangle.drawable)) {
      add(Leave(*hit, way, random), 1.0);
      return sum;
    }
    const SurfacePoint point = PointOf(*hit, way.ray);
    const FrameMaterial& frame = MaterialOf(hit->triangle.drawable).Frame();
    const glm::dvec4 base = MaterialOf(hit->triangle.drawable).BaseColor(point);
    double coverage = frame.alpha_mode == AlphaMode::Blend ? std::clamp(base.w, 0.0, 1.0) : 1.0;
    // What lies behind is not followed twice, or the work would double with each layer.
    if (coverage < 1.0 && frame.Has(kTransmission)) coverage = random.Point().x < coverage ? 1.0 : 0.0;
    if (coverage > 0.0) {
      const SampleRun run = random.Run();
      add(Surface(point, glm::dvec3(base), hit->triangle, hit->is_back, run, way, random), coverage);
    }
    if (coverage >= 1.0) return sum;
    rest *= 1.0 - coverage;
    way.ray.origin = point.position;
    way.ray.from = hit->triangle;
  }
}

// `way`: inside, towards the hit, which is the back of a surface that bounds a medium.
ExactTracer::Seen ExactTracer::Leave(const ExactRays::Hit& hit, Way way, Random& random) const {
  if (way.left == 0) {
    ++given_up_;
    return {};
  }
  --way.left;
  const SurfacePoint point = PointOf(hit, way.ray);
  const ExactInterface at = ExitAt(MaterialOf(hit.triangle.drawable), point);
  const Media outside = way.media.Without(posed_.drawables, hit.triangle.drawable);
  const glm::dvec3 facet = SampleFacet(at, random.Point());
  const int c = std::max(way.channel, 0);
  const auto refracted = Refracted(way.ray.direction, facet, way.media.Ior()[c] / outside.Ior()[c]);
  way.ray.origin = point.position;
  way.ray.from = hit.triangle;
  if (refracted) {
    way.ray.direction = Beyond(at, *refracted);
    way.media = outside;
  } else {
    way.ray.direction = Before(at, Reflected(way.ray.direction, facet));
  }
  return Along(way, random);
}

}  // namespace facet

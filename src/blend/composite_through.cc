#include "blend/composite_through.h"

#include <algorithm>
#include <cmath>

#include "frame/constants.h"

namespace facet {
namespace {

constexpr float kCovered = 1e-4f;  // less of it is rounding error

// The perceptual roughness of a lobe by the deviation of its tangent: the inverse of TransmissionLobe::Spread().
float RoughnessOfSpread(float spread) {
  const float alpha = spread < 0.85f ? spread / (1.7f - spread) : 1.0f;
  return std::sqrt(alpha);
}

// Shifts below a unit of the grid on which triangles stand are none: whether a sample shows its own opaque surface must
// not depend on rounding.
bool Bends(const SeenThroughFragments& f, std::uint32_t i) {
  constexpr float kLeast = 1.0f / kSubpixelScale;
  bool bends = f.blur[i] > 0.0f;
  for (int c = 0; c < 3; ++c) {
    bends = bends || std::fabs(f.shift_x[c][i]) >= kLeast || std::fabs(f.shift_y[c][i]) >= kLeast;
  }
  return bends;
}

// What of a mean counts: all, if at least half of what is there is not too near; less as the rest of it vanishes.
float Trust(const Backdrop::Mean& mean) {
  return mean.inside > 0.0f ? std::min(2.0f * mean.accepted / mean.inside, 1.0f) : 0.0f;
}

// around(deviation), completed where too much of it is too near: by what narrower blurs find, because texels of coarse
// levels are left out as a whole, and then by wider ones. `accepted` of the result is the share that has been found.
template <class Around>
Backdrop::Mean Complete(float deviation, float widest, const Around& around) {
  constexpr float kRest = 1e-3f;
  Backdrop::Mean whole = around(deviation);
  if (whole.inside == 0.0f) return whole;
  float rest = 1.0f - Trust(whole);
  whole.accepted = 1.0f - rest;
  if (rest == 0.0f) return whole;
  whole.light *= whole.accepted, whole.depth *= whole.accepted;
  const auto add = [&](float other) {
    const Backdrop::Mean mean = around(other);
    const float share = rest * Trust(mean);
    whole.light += mean.light * share, whole.depth += mean.depth * share;
    rest -= share;
  };
  if (deviation > 0.0f) add(0.25f * deviation), add(0.0625f * deviation);
  for (float wider = 2.0f * std::max(deviation, 0.5f); rest > kRest && wider <= widest; wider *= 2.0f) add(wider);
  if (rest <= kRest) whole.light /= 1.0f - rest, whole.depth /= 1.0f - rest, rest = 0.0f;
  whole.accepted = 1.0f - rest;
  return whole;
}

// The share of a layer's blur that shows on what is behind it, by their depths.
float BlurByDepths(bool perspective, float layer, float behind) {
  return std::max(perspective ? 1.0f - behind / layer : layer - behind, 0.0f);
}

}  // namespace

ThroughCompositor::Seen ThroughCompositor::Look(const ThroughView& view, const ShadedFragments& layers, int x, int y,
                                                const TileBuffers& tile, const Backdrop& backdrop) const {
  const SeenThroughFragments& f = layers.seen_through;
  float shift_x[3] = {}, shift_y[3] = {}, blur2 = 0.0f;
  bool disperses = false;
  for (const std::uint32_t k : bending_) {
    const std::uint32_t i = fragment_of_[k];
    for (int c = 0; c < 3; ++c) {
      shift_x[c] += f.shift_x[c][i], shift_y[c] += f.shift_y[c][i];
      disperses = disperses || f.shift_x[c][i] != f.shift_x[0][i] || f.shift_y[c][i] != f.shift_y[0][i];
    }
    blur2 += f.blur[i] * f.blur[i];
  }
  const float in_block_x = static_cast<float>(x % kBlockSize) + 0.5f;
  const float in_block_y = static_cast<float>(y % kBlockSize) + 0.5f;
  const float in_image_x = static_cast<float>(tile.x0 + x) + 0.5f, in_image_y = static_cast<float>(tile.y0 + y) + 0.5f;
  const BlockDepth& rear = planes_[bending_.back()];
  // What is not nearer than the rearmost layer, continued to where it is looked at.
  const auto around = [&](int c, float deviation) {
    const float nearest = DepthAt(rear, in_block_x + shift_x[c], in_block_y + shift_y[c]);
    return Complete(deviation, backdrop.Widest(), [&](float d) {
      return backdrop.Around(in_image_x + shift_x[c], in_image_y + shift_y[c], d, nearest);
    });
  };

  Seen seen;
  float deviation = 0.0f;
  if (blur2 > 0.0f) {
    // How far away is what is seen? What a fourth of the widest blur covers says how wide it is. Then what that blur
    // covers says so again.
    const float widest = std::sqrt(blur2);
    seen.roughness = RoughnessOfSpread(widest / view.pixels_per_tangent);
    deviation = view.perspective ? widest : 0.0f;
    float look = 0.25f * deviation;
    for (int step = 0; step < 2; ++step) {
      const Backdrop::Mean mean = around(1, look);
      if (mean.light.a < kCovered) break;
      const float behind = mean.depth / mean.light.a;
      blur2 = 0.0f;
      for (const std::uint32_t k : bending_) {
        const float blur = f.blur[fragment_of_[k]] *
                           BlurByDepths(view.perspective, DepthAt(planes_[k], in_block_x, in_block_y), behind);
        blur2 += blur * blur;
      }
      look = deviation = std::sqrt(blur2);
    }
  }

  for (int c = 0; c < 3; ++c) seen.x[c] = in_image_x + shift_x[c], seen.y[c] = in_image_y + shift_y[c];
  for (int c = 0; c < (disperses ? 3 : 1); ++c) {
    const Backdrop::Mean mean = around(c, deviation);
    // A blur that is centred on the picture's border has half of its weight inside.
    const float part = std::min(2.0f * mean.inside, 1.0f);
    for (int k = c; k < (disperses ? c + 1 : 3); ++k) {
      seen.own[k] = mean.inside > 0.0f ? (1.0f - mean.accepted) * part : 0.0f;
      seen.light[k] = mean.light[k] * part;
      seen.coverage[k] = mean.light.a * part;
      seen.open[k] = std::max(1.0f - seen.coverage[k] - seen.own[k], 0.0f);
    }
  }
  return seen;
}

void ThroughCompositor::SeeEnvironment(const Seen& seen, const glm::vec3& weight, std::uint32_t pixel,
                                       EnvironmentSeen& out) const {
  const auto add = [&](int c, const glm::vec3& share) {
    if (share == glm::vec3(0.0f)) return;
    out.x.push_back(seen.x[c]), out.y.push_back(seen.y[c]);
    out.roughness.push_back(seen.roughness);
    out.weight.push_back(share);
    out.pixel.push_back(pixel);
  };
  const bool same =
      seen.x[0] == seen.x[1] && seen.x[0] == seen.x[2] && seen.y[0] == seen.y[1] && seen.y[0] == seen.y[2];
  if (same) return add(0, weight);
  for (int c = 0; c < 3; ++c) {
    glm::vec3 share(0.0f);
    share[c] = weight[c];
    add(c, share);
  }
}

void ThroughCompositor::Run(const ThroughView& view, const TileBuffers& tile, const ShadedFragments& opaque,
                            const ShadedFragments& layers, std::span<const ScreenTriangle* const> records,
                            const Backdrop& backdrop, const std::vector<glm::vec4>& background,
                            std::vector<glm::vec4>& pixels, std::vector<glm::vec3>& through,
                            EnvironmentSeen& environment) {
  const std::size_t pixel_count = pixels.size();
  environment.Clear();
  layers_of_.Fill(layers.list, pixel_count);
  opaque_of_.Fill(opaque.list, pixel_count);
  const SamplePosition* pattern = SamplePattern(tile.samples);
  const float share = 1.0f / static_cast<float>(tile.samples);
  for (std::size_t p = 0; p < pixel_count; ++p) {
    const std::uint32_t begin = layers_of_.first[p], end = layers_of_.first[p + 1];
    if (begin == end) continue;
    const int x = static_cast<int>(p) % tile.tile_size, y = static_cast<int>(p) / tile.tile_size;
    const int block_x = x / kBlockSize * kBlockSize, block_y = y / kBlockSize * kBlockSize;
    planes_.clear(), here_.clear(), before_.clear();
    fragment_of_.assign(layers_of_.order.begin() + begin, layers_of_.order.begin() + end);
    for (const std::uint32_t i : fragment_of_) {
      planes_.push_back(
          MakeBlockDepth(*records[std::size_t(layers.list.record[i])], tile.x0 + block_x, tile.y0 + block_y));
      here_.push_back(Gather(layers, i));
    }
    known_.clear(), bending_.clear();
    Seen seen;
    Passed passed;
    glm::vec4 sum(0.0f);
    glm::vec3 of_environment(0.0f), of_background(0.0f);
    const auto see_environment = [&] {
      SeeEnvironment(seen, of_environment * share, static_cast<std::uint32_t>(p), environment);
      of_environment = glm::vec3(0.0f);
    };
    for (int s = 0; s < tile.samples; ++s) {
      glm::vec4 own = background[p];
      for (std::uint32_t k = opaque_of_.first[p]; k < opaque_of_.first[p + 1]; ++k) {
        const std::uint32_t i = opaque_of_.order[k];
        if (opaque.list.samples[i] >> s & 1) own = glm::vec4(opaque.red[i], opaque.green[i], opaque.blue[i], 1.0f);
      }
      const float sample_x = static_cast<float>((x - block_x) * kSampleGrid + pattern[s].x) / kSampleGrid;
      const float sample_y = static_cast<float>((y - block_y) * kSampleGrid + pattern[s].y) / kSampleGrid;
      sorted_.clear();
      for (std::uint32_t k = 0; k < end - begin; ++k) {
        if (here_[k].samples >> s & 1) sorted_.push_back({DepthAt(planes_[k], sample_x, sample_y), k});
      }
      std::sort(sorted_.begin(), sorted_.end(), IsBehind);
      const auto same = [](const Layer& a, const Layer& b) { return a.fragment == b.fragment; };
      if (!std::equal(sorted_.begin(), sorted_.end(), before_.begin(), before_.end(), same)) passed = WalkLayers();
      std::swap(sorted_, before_);
      const glm::vec3 bent = passed.all - passed.straight;
      glm::vec3 straight = passed.straight;
      sum += glm::vec4(passed.light, 1.0f);
      glm::vec3 open(0.0f);
      if (!bending_.empty()) {
        if (bending_ != known_) {
          see_environment();
          seen = Look(view, layers, x, y, tile, backdrop);
          known_ = bending_;
        }
        sum += glm::vec4(bent * seen.light, 0.0f);
        straight += bent * seen.own;
        open = bent * seen.open;
        if (view.environment_behind) of_environment += open;
      }
      const glm::vec3 passes = open * (view.environment_behind ? 0.0f : 1.0f) + straight * (1.0f - own.a);
      sum += glm::vec4(straight * glm::vec3(own), (passes.x + passes.y + passes.z) * (-1.0f / 3.0f));
      of_background += passes;
    }
    see_environment();
    pixels[p] = sum * share;
    through[p] = of_background * share;
  }
}

ThroughCompositor::LayerHere ThroughCompositor::Gather(const ShadedFragments& layers, std::uint32_t i) const {
  const SeenThroughFragments& f = layers.seen_through;
  const float alpha = layers.alpha[i];
  const glm::vec3 tinted = glm::vec3(f.tint[0][i], f.tint[1][i], f.tint[2][i]) * alpha;
  const glm::vec3 passes = tinted + (1.0f - alpha);
  const bool bends = tinted != glm::vec3(0.0f) && Bends(f, i);
  return {glm::vec3(layers.red[i], layers.green[i], layers.blue[i]),
          passes,
          bends ? glm::vec3(1.0f - alpha) : passes,
          alpha,
          layers.list.samples[i],
          bends};
}

// From the front to the back.
ThroughCompositor::Passed ThroughCompositor::WalkLayers() {
  Passed passed;
  bending_.clear();
  for (std::size_t n = sorted_.size(); n-- > 0;) {
    const LayerHere& layer = here_[sorted_[n].fragment];
    if (layer.alpha == 0.0f) continue;
    passed.light += passed.all * layer.light * layer.alpha;
    passed.all *= layer.passes;
    passed.straight *= layer.straight;
    if (layer.bends) bending_.push_back(sorted_[n].fragment);
  }
  return passed;
}

}  // namespace facet

#include "blend/composite.h"

#include <algorithm>

namespace facet {

void FragmentsByPixel::Fill(const FragmentList& list, std::size_t pixel_count) {
  first.assign(pixel_count + 1, 0);
  order.resize(list.Size());
  for (const std::uint16_t p : list.pixel) ++first[p + 1u];
  for (std::size_t p = 0; p < pixel_count; ++p) first[p + 1] += first[p];
  next.assign(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < list.Size(); ++i) order[next[list.pixel[i]]++] = static_cast<std::uint32_t>(i);
}

template <int kSamples>
void Compositor::Composite(const TileBuffers& tile, const ShadedFragments& opaque, const ShadedFragments& blended,
                           std::span<const ScreenTriangle* const> records, const std::vector<glm::vec4>& background,
                           std::vector<glm::vec4>& pixels) {
  const int samples = tile.Samples<kSamples>();
  const std::size_t pixel_count = pixels.size();
  layers_of_.Fill(blended.list, pixel_count);
  opaque_of_.Fill(opaque.list, pixel_count);
  const SamplePosition* pattern = SamplePattern(samples);
  const float share = 1.0f / static_cast<float>(samples);
  for (std::size_t p = 0; p < pixel_count; ++p) {
    const std::uint32_t begin = layers_of_.first[p], end = layers_of_.first[p + 1];
    if (begin == end) continue;
    const int x = static_cast<int>(p) % tile.tile_size, y = static_cast<int>(p) / tile.tile_size;
    const int block_x = x / kBlockSize * kBlockSize, block_y = y / kBlockSize * kBlockSize;
    planes_.clear();
    for (std::uint32_t k = begin; k < end; ++k) {
      planes_.push_back(MakeBlockDepth(*records[std::size_t(blended.list.record[layers_of_.order[k]])],
                                       tile.x0 + block_x, tile.y0 + block_y));
    }
    glm::vec4 sum(0.0f);
    for (int s = 0; s < samples; ++s) {
      glm::vec4 color = background[p];
      for (std::uint32_t k = opaque_of_.first[p]; k < opaque_of_.first[p + 1]; ++k) {
        const std::uint32_t i = opaque_of_.order[k];
        if (opaque.list.samples[i] >> s & 1) color = glm::vec4(opaque.red[i], opaque.green[i], opaque.blue[i], 1.0f);
      }
      const float sample_x = static_cast<float>((x - block_x) * kSampleGrid + pattern[s].x) / kSampleGrid;
      const float sample_y = static_cast<float>((y - block_y) * kSampleGrid + pattern[s].y) / kSampleGrid;
      layers_.clear();
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t i = layers_of_.order[k];
        if (blended.list.samples[i] >> s & 1) layers_.push_back({DepthAt(planes_[k - begin], sample_x, sample_y), i});
      }
      if (layers_.size() > 1) std::sort(layers_.begin(), layers_.end(), IsBehind);
      for (const Layer& layer : layers_) {
        const std::uint32_t i = layer.fragment;
        const float a = blended.alpha[i];
        color = glm::vec4(blended.red[i], blended.green[i], blended.blue[i], 1.0f) * a + color * (1.0f - a);
      }
      sum += color;
    }
    pixels[p] = sum * share;
  }
}

void Compositor::Run(const TileBuffers& tile, const ShadedFragments& opaque, const ShadedFragments& blended,
                     std::span<const ScreenTriangle* const> records, const std::vector<glm::vec4>& background,
                     std::vector<glm::vec4>& pixels) {
  if (tile.samples == 1) {
    Composite<1>(tile, opaque, blended, records, background, pixels);
  } else {
    Composite<0>(tile, opaque, blended, records, background, pixels);
  }
}

}  // namespace facet

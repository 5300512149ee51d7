#include "render/texture_pass.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/bytes_text.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "material/model_parameters.h"
#include "texture/build_texture.h"

namespace facet {

namespace {

// The limits of the builder (texture/texture.h).
constexpr int kMaxSide = 1 << (kMaxTextureLevels - 1), kMaxTexels = 1 << 27;

// The size of a texture with all its levels, from the header of its image.
double ExpectedBytes(const ImageHeader& header, const PlannedTexture& planned, TexelBits texels) {
  const bool grey = header.channels == 1 || header.channels == 2, no_alpha = header.channels % 2 == 1;
  const auto read = static_cast<unsigned>(planned.channels & (no_alpha ? kRgb : kRgba));
  const int components = grey ? ((read & kRgb) != 0) + ((read & kA) != 0) : std::popcount(read);
  const bool is_16_bit =
      texels == TexelBits::Mixed ? planned.role == TextureRole::Color || header.bits > 8 : texels == TexelBits::Sixteen;
  return double(TexelCount(header.width, header.height, planned.mips)) * (is_16_bit ? 2.0 : 1.0) *
         std::max(components, 1);
}

// Refuses textures that are too large to decode, or for the budget.
void CheckSizes(const Scene& scene, const std::vector<bool>& needed, TexelBits texels, const FramePlan& plan,
                const FrameTextures& textures, MemoryBudget& budget) {
  double sum = 0.0, largest = 0.0;
  std::string of_largest;
  for (std::size_t t = 0; t < needed.size(); ++t) {
    const PlannedTexture& planned = plan.textures[t];
    if (!needed[t] || planned.image == kWhiteImage) continue;
    const ImageSource& source = *scene.images[std::size_t(planned.image)].source;
    const ImageHeader header = source.Header().value_or(ImageHeader());
    const bool broken = header.format.empty() && double(header.bytes) < double(header.width) * header.height;
    if (broken || header.width < 1 || header.height < 1) continue;  // decoding it gives a better message
    const std::string size = std::to_string(header.width) + " x " + std::to_string(header.height);
    const TextureData* const kept = textures.entries[t].data.get();
    const double bytes = kept != nullptr ? double(kept->bytes.size()) : ExpectedBytes(header, planned, texels);
    if (header.width > kMaxSide || header.height > kMaxSide || double(header.width) * header.height > kMaxTexels) {
      throw Error(ErrorCode::OutOfMemory,
                  "a texture of " + size + " texels needs " + BytesText(bytes) + ", and the limit is " +
                      std::to_string(kMaxSide) + " a side and 2^27 texels in all",
                  source.Name(), "scale the image down");
    }
    sum += bytes;
    if (bytes <= largest) continue;
    largest = bytes;
    of_largest = source.Name() + ", " + size + ", " + BytesText(bytes);
  }
  if (sum > 0.0) {
    budget.Charge(static_cast<std::uint64_t>(sum), 1, "textures (the largest: " + of_largest + ")", {},
                  "scale them down, or leave some out");
  }
}

Image WhitePixel() { return {1, 1, 4, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(4, std::byte{255})}; }

}  // namespace

void DecodeTextures(const Scene& scene, const std::vector<bool>& material_visible, TexelBits texels,
                    const FramePlan& plan, FrameTextures& textures, MemoryBudget& budget, const WorkBeside& beside,
                    RenderStats& stats) {
  if (textures.planned != plan.textures || textures.texels != texels) {
    FrameTextures now{plan.textures, texels, {}};
    now.entries.resize(plan.textures.size());
    for (std::size_t t = 0; t < now.entries.size() && textures.texels == texels; ++t) {
      const auto known = std::find(textures.planned.begin(), textures.planned.end(), plan.textures[t]);
      if (known == textures.planned.end()) continue;
      now.entries[t] = std::move(textures.entries[std::size_t(known - textures.planned.begin())]);
    }
    textures = std::move(now);
  }
  std::vector<bool> needed(plan.textures.size(), false);
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    if (!material_visible[m] && !plan.every_texture) continue;
    for (const int t : plan.materials[m].textures) {
      if (t >= 0) needed[std::size_t(t)] = true;
    }
  }
  for (std::size_t t = 0; t < needed.size(); ++t) {
    const int image = plan.textures[t].image;
    if (image != kWhiteImage && scene.images[std::size_t(image)].source->MayChange())
      textures.entries[t].problem.clear();
  }
  CheckSizes(scene, needed, texels, plan, textures, budget);
  // An image that is read in two roles is decoded once.
  std::vector<int> images;
  std::vector<std::vector<std::size_t>> textures_of(scene.images.size());  // textures to build, by image
  for (std::size_t t = 0; t < needed.size(); ++t) {
    FrameTextures::Entry& entry = textures.entries[t];
    if (!needed[t] || entry.data != nullptr || !entry.problem.empty()) continue;
    const int image = plan.textures[t].image;
    if (image == kWhiteImage) {
      entry.data =
          std::make_unique<const TextureData>(BuildTexture(WhitePixel(), plan.textures[t].role, false, texels));
      continue;
    }
    std::vector<std::size_t>& known = textures_of[std::size_t(image)];
    if (known.empty()) images.push_back(image);
    known.push_back(t);
  }
  std::vector<std::exception_ptr> failures(images.size());  // the first in the file's order is passed on
  // The largest first, so that the last one does not leave the other threads idle for long.
  std::vector<std::pair<std::size_t, std::size_t>> order = {{beside.size, images.size()}};  // bytes, index in `images`
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto header = scene.images[std::size_t(images[i])].source->Header();
    order.emplace_back(header ? header->bytes : 0, i);
  }
  std::sort(order.rbegin(), order.rend());
  std::atomic<std::size_t> next = 0;  // a free thread takes the next image, in this order
  ParallelFor(order.size(), 1, [&](std::size_t, std::size_t) {
    const std::size_t i = order[next++].second;
    if (i == images.size()) return beside.run();
    const auto for_each_role = [&](auto&& body) {
      for (const std::size_t t : textures_of[std::size_t(images[i])]) body(plan.textures[t], textures.entries[t]);
    };
    const ImageSource& source = *scene.images[std::size_t(images[i])].source;
    try {
      std::map<FrameTextures::Entry*, TextureBuilder> builders;
      std::string damage;
      source.DecodeRows([&](const Image& rows, int height) {
        if (!rows.damage.empty()) damage = source.Name() + ": " + rows.damage;
        for_each_role([&](const PlannedTexture& planned, FrameTextures::Entry& entry) {
          builders
              .try_emplace(&entry, rows, height, planned.role, planned.mips, texels, planned.channels, planned.emission)
              .first->second.Add(rows);
        });
      });
      if (builders.empty()) throw Error(ErrorCode::InvalidInput, "a picture without rows");
      for (auto& [entry, builder] : builders) {
        entry->data = std::make_unique<const TextureData>(builder.Finish());
        entry->damage = damage;
      }
    } catch (const Error& error) {
      if (error.code() != ErrorCode::InvalidInput && error.code() != ErrorCode::NotFound) {
        failures[i] = std::current_exception();
        return;
      }
      const std::string problem = error.where().empty() ? source.Name() + ": " + error.what() : error.what();
      for_each_role([&](const PlannedTexture&, FrameTextures::Entry& entry) { entry.problem = problem; });
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure != nullptr) std::rethrow_exception(failure);
  }
  std::vector<bool> warned(scene.images.size(), false);
  std::set<std::string> said;  // several images may refer to the same file
  stats.images_decoded = images.size();
  for (std::size_t t = 0; t < needed.size(); ++t) {
    const FrameTextures::Entry& entry = textures.entries[t];
    if (needed[t] && entry.data != nullptr) {
      const TextureData& data = *entry.data;
      stats.texture_bytes += data.bytes.size();
      stats.textures.push_back({plan.textures[t].image, plan.textures[t].role == TextureRole::Color,
                                data.level_width[0], data.level_height[0], data.levels, data.components,
                                data.is_16_bit ? 16 : 8, data.bytes.size(), data.empty_cells.Share()});
    }
    if (!needed[t] || (entry.problem.empty() && entry.damage.empty())) continue;
    const int image = plan.textures[t].image;
    if (warned[std::size_t(image)]) continue;
    warned[std::size_t(image)] = true;
    const std::string warning = entry.problem.empty() ? entry.damage : entry.problem + " (drawn without this texture)";
    if (said.insert(warning).second) stats.warnings.push_back(warning);
    if (!entry.problem.empty() && !textures_of[std::size_t(image)].empty()) --stats.images_decoded;
  }
}

std::vector<FrameMaterial> BindTextures(const FramePlan& plan, const FrameTextures& textures) {
  std::vector<FrameMaterial> bound;
  bound.reserve(plan.materials.size());
  for (const PlannedMaterial& planned : plan.materials) {
    FrameMaterial& material = bound.emplace_back(planned.frame);
    ForEachSlotOf(planned.frame.ModelOfSlots(), planned.frame.features, [&](const SlotInfo& info) {
      const Slot slot = info.slot;
      const TextureData* const data = textures.entries[std::size_t(planned.textures[IndexOf(slot)])].data.get();
      material.textures[IndexOf(slot)].data = data;
      if (data == nullptr) material.features &= ~BitOf(slot);
    });
  }
  return bound;
}

}  // namespace facet

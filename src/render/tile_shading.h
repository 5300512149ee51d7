// Shades the fragments of a tile in batches of one material, whatever triangles they come from.
#pragma once

#include <cstdint>
#include <vector>

#include "light/lighting.h"
#include "render/tile_records.h"
#include "render/tiled_view.h"
#include "shade/shade_task.h"

namespace facet {

// The position within a pixel at which a fragment is shaded: the pixel's centre if it covers all samples, otherwise the
// centroid of those that it covers, which lies within the triangle.
class ShadingPositions {
 public:
  explicit ShadingPositions(int samples);

  // In pixels from the top left corner; `samples`: bits of those that are covered.
  float X(std::uint8_t samples) const { return x_[samples]; }
  float Y(std::uint8_t samples) const { return y_[samples]; }

 private:
  float x_[256] = {}, y_[256] = {};
};

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class TileShading {
 public:
  TileShading(const TiledView& view, const ShadingPositions& positions) : view_(view), positions_(positions) {}

  // Shades all fragments of the list, and adds to `non_finite` how many of them were replaced by black.
  void Shade(const TileBuffers& tile, const TileRecords& records, const LightingData& lighting,
             ShadedFragments& fragments, std::uint64_t& non_finite);
  // Computes the alpha of the fragments, which all have this material.
  void ComputeAlpha(const TileBuffers& tile, const TileRecords& records, const FrameMaterial& material,
                    ShadedFragments& fragments);

 private:
  struct Batch;
  void ShadeBatch(const Batch& batch, ShadedFragments& fragments);
  void ShadePart(const Batch& batch, ShadedFragments& fragments);
  void SetUpBatch(const Batch& batch, const FragmentList& list, std::size_t padded);
  void PlaceFragments(const TileBuffers& tile, const FragmentList& list, std::size_t padded);
  void SelectAll(std::size_t count);
  SeenThroughOutputs PrepareSeenThrough(std::size_t padded, ShadeTask& task);
  void PutSeenThrough(bool is_seen_through, bool disperses, SeenThroughFragments& out) const;

  // Consecutive fragments of a list that have the same material: [begin, end).
  struct MaterialRun {
    std::uint32_t material, begin, end;
  };
  struct SetupOfRecord {
    std::uint64_t batch;  // for which it was computed
    std::int32_t setup;
  };

  const TiledView& view_;
  const ShadingPositions& positions_;
  std::vector<MaterialRun> runs_;
  std::vector<std::uint32_t> selected_;  // indices of the batch's fragments in their list
  std::vector<SetupOfRecord> setup_of_record_;
  std::uint64_t batch_number_ = 0;
  std::vector<const ScreenTriangle*> set_up_;  // the batch's triangles, in the order of their setups
  std::vector<float> setups_;
  std::vector<std::int32_t> setup_of_;  // by fragment of the batch, like all below
  std::vector<float> x_, y_;
  PageVector<float> red_, green_, blue_, alpha_;
  SeenThroughFragments seen_through_;
};

}  // namespace facet

// Shading the fragments of a tile: by material, packed into batches whatever triangles they come from.
#pragma once

#include <cstdint>
#include <vector>

#include "light/lighting.h"
#include "render/tile_records.h"
#include "render/tiled_view.h"

namespace facet {

// Where the fragments of a pixel are shaded, by which of its samples they cover: at the pixel's centre when they cover
// all, else at the centroid of those that they cover, which lies within the triangle.
class ShadingPositions {
 public:
  explicit ShadingPositions(int samples);

  // Pixels from the pixel's top left corner.
  float X(std::uint8_t samples) const { return x_[samples]; }
  float Y(std::uint8_t samples) const { return y_[samples]; }

 private:
  float x_[256] = {}, y_[256] = {};
};

// Keeps its working memory from tile to tile. Not thread-safe: one per worker.
class TileShading {
 public:
  TileShading(const TiledView& view, const ShadingPositions& positions) : view_(view), positions_(positions) {}

  // Shades all fragments of the list. `non_finite`: fragments that were replaced by black are added to it.
  void Shade(const TileBuffers& tile, const TileRecords& records, const LightingData& lighting,
             ShadedFragments& fragments, std::uint64_t& non_finite);
  // Only their alpha; all have this material, which is read for nothing else.
  void ShadeAlpha(const TileBuffers& tile, const TileRecords& records, const FrameMaterial& material,
                  ShadedFragments& fragments);

 private:
  struct Batch;
  void ShadeBatch(const Batch& batch, ShadedFragments& fragments);
  void ShadePart(const Batch& batch, ShadedFragments& fragments);
  void SetUpBatch(const Batch& batch, const FragmentList& list, std::size_t padded);
  void PlaceFragments(const TileBuffers& tile, const FragmentList& list, std::size_t padded);
  void SelectAll(std::size_t count);

  // Fragments [begin, end) of a list, which have one material: neighbours mostly do.
  struct MaterialRun {
    std::uint32_t material, begin, end;
  };
  struct SetupOfRecord {
    std::uint64_t batch;  // in which it was made
    std::int32_t setup;
  };

  const TiledView& view_;
  const ShadingPositions& positions_;
  std::vector<MaterialRun> runs_;
  std::vector<std::uint32_t> selected_;  // the batch's fragments, as indices into their list
  std::vector<SetupOfRecord> setup_of_record_;
  std::uint64_t batch_number_ = 0;
  std::vector<const TriangleRecord*> set_up_;  // the records that have a setup in this batch, in its order
  std::vector<float> setups_;
  std::vector<std::int32_t> setup_of_;  // by fragment of the batch, as all below
  std::vector<float> x_, y_, red_, green_, blue_, alpha_;
};

}  // namespace facet

// What stands behind the surfaces of a frame that are seen through: the opaque surfaces of the whole picture, blurred
// at all scales, with how near they are, so that no surface shows what is in front of it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/memory_budget.h"
#include "base/pages.h"
#include "frame/tile.h"

namespace facet {

// Filled by tiles (on many threads at once, each its own pixels), then finished; after that it is only read.
class Backdrop {
 public:
  // Charges its memory to the current budget. Throws Error(OutOfMemory).
  Backdrop(int width, int height);

  // `pixels`: the tile's opaque surfaces, premultiplied by their coverage, tile_size a row. `at`: where the tile is,
  // and their depths; `is_empty`: there are none.
  void SetTile(const TileBuffers& at, bool is_empty, const std::vector<glm::vec4>& pixels);
  // The pixels that SetTile() was given.
  void GetTile(const TileBuffers& at, std::vector<glm::vec4>& pixels) const;
  // Computes the coarser levels, in parallel.
  void Finish();

  // The mean around a point, in pixels, with the blur's standard deviation, of what is not nearer than `nearest`.
  struct Mean {
    glm::vec4 light{0.0f};  // premultiplied by coverage, and coverage
    float depth = 0.0f;     // mean of what is covered, times coverage
    // The share of the blur's weight that lies inside of the picture, and that of what is not too near besides. If the
    // latter is not zero, light and depth are divided by it.
    float inside = 0.0f, accepted = 0.0f;
  };
  Mean Around(float x, float y, float deviation, float nearest) const;
  // A deviation whose blur has all of the picture in it.
  float Widest() const { return static_cast<float>(1 << levels_.size()); }

 private:
  struct Texel {
    glm::vec4 light;
    float nearest, depth;  // of its nearest surface; mean times coverage
  };
  struct Level {
    int width, height;
    std::size_t offset;
  };
  // Adds a texel. Where a part of it is too near, adds those of its parts, in finer levels, that are not.
  // The share of a texel's area that lies inside of the picture.
  float AreaInside(std::size_t level, int column, int row) const;
  // Calls visit(column, row, share of the area) for the texels of the finer level that one is made of.
  template <class Visit>
  void ForEachPart(std::size_t level, int column, int row, const Visit& visit) const;
  void AddTexel(std::size_t level, int column, int row, float weight, float nearest, int finer, Mean& sum) const;
  // Adds count x count weighted texels.
  void AddWeighted(std::size_t level, int column, int row, int count, const float* weights_x, const float* weights_y,
                   float nearest, float share, Mean& sum) const;
  void AddLinear(float x, float y, float nearest, float share, Mean& sum) const;
  void AddSpline(std::size_t level, float x, float y, float nearest, float share, Mean& sum) const;

  std::vector<Level> levels_;
  MemoryLease lease_;
  PageVector<Texel> texels_;
};

}  // namespace facet

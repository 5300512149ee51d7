#include "frame/tile_grid.h"

namespace facet {

TileGrid MakeTileGrid(int width, int height, int tile_size) {
  return {width, height, tile_size, (width + tile_size - 1) / tile_size, (height + tile_size - 1) / tile_size};
}

}  // namespace facet

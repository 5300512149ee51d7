#include "render/film_planes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>

#include "facet/error.h"

namespace facet {

void CheckPlanes(const std::vector<PlaneKind>& planes) {
  for (auto plane = planes.begin(); plane != planes.end(); ++plane) {
    if (std::size_t(*plane) >= std::size(kPlanes)) {
      throw Error(ErrorCode::InvalidUsage, "a plane of kind " + std::to_string(int(*plane)), "render settings",
                  "0 to " + std::to_string(std::size(kPlanes) - 1) + " are accepted");
    }
    if (std::find(planes.begin(), plane, *plane) != plane) {
      throw Error(ErrorCode::InvalidUsage, "the plane " + std::string(InfoOf(*plane).name) + " is asked for twice",
                  "render settings", "name each plane once");
    }
  }
}

void ChargePlanes(const std::vector<PlaneKind>& planes, int width, int rows, MemoryBudget& budget) {
  std::uint64_t pixel_bytes = 0;
  for (const PlaneKind plane : planes) pixel_bytes += InfoOf(plane).PixelBytes();
  if (pixel_bytes == 0) return;
  budget.Charge(std::uint64_t(width) * std::uint64_t(rows), pixel_bytes, "planes besides colour", {},
                "make the picture smaller, or ask for fewer planes");
}

void SizePlanes(const std::vector<PlaneKind>& planes, Film& film) {
  film.planes.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    film.planes[i].kind = planes[i];
    film.planes[i].bytes.resize(std::size_t(film.width) * std::size_t(film.height) * InfoOf(planes[i]).PixelBytes());
  }
}

}  // namespace facet

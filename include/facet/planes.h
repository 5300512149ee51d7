// Planes of a film besides colour: for each pixel one or more components that describe the surface that is seen there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

namespace facet {

// Every plane describes the nearest sample of a pixel: of equally near samples, the first. Only opaque and alpha-tested
// surfaces count. Blended surfaces and the background are not seen.
enum class PlaneKind : std::uint8_t {
  Depth,     // distance along the camera's axis in metres; +infinity where no surface is seen
  Triangle,  // index of the triangle, line or point within its primitive; 0xffffffff where no surface is seen
};

enum class PlaneType : std::uint8_t { F32, U32 };
constexpr std::size_t SizeOf(PlaneType) { return 4; }
constexpr std::string_view NameOf(PlaneType type) { return type == PlaneType::F32 ? "f32" : "u32"; }

struct PlaneInfo {
  PlaneKind kind;
  std::string_view name;
  int channels;  // components of a pixel
  PlaneType type;
  std::string_view meaning;  // with its unit

  constexpr std::size_t PixelBytes() const { return std::size_t(channels) * SizeOf(type); }
};

// All planes, in the order of PlaneKind.
inline constexpr PlaneInfo kPlanes[] = {
    {PlaneKind::Depth, "depth", 1, PlaneType::F32, "distance along the camera's axis, metres"},
    {PlaneKind::Triangle, "triangle", 1, PlaneType::U32, "index of the triangle, line or point within its primitive"},
};

constexpr const PlaneInfo& InfoOf(PlaneKind kind) { return kPlanes[std::size_t(kind)]; }

static_assert(
    [] {
      for (std::size_t i = 0; i < std::size(kPlanes); ++i) {
        if (std::size_t(kPlanes[i].kind) != i) return false;
      }
      return true;
    }(),
    "InfoOf() finds a plane by its kind");

// A plane of a film: the film's height rows of its width pixels, top row first, little-endian, without gaps.
struct Plane {
  PlaneKind kind = PlaneKind::Depth;
  std::vector<std::byte> bytes;

  // The components; T is the plane's type: float or std::uint32_t.
  template <class T>
  std::span<const T> As() const {
    static_assert(sizeof(T) == SizeOf(PlaneType::F32));
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

}  // namespace facet

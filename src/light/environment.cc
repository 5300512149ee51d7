#include "light/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>

#include "base/check.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "image/codec.h"
#include "image/convert.h"
#include "light/environment_kernels.h"
#include "light/irradiance_harmonics.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPiDouble = 3.14159265358979324;

using Level = EnvironmentMap::Level;

float* RowOf(EnvironmentMap* map, const Level& level, std::int32_t row) {
  return map->texels.data() + level.offset + std::ptrdiff_t(row) * (level.size + 1) * 4;
}

// The chain is the mip pyramid that lobes are sampled from. Unlike those of an EnvironmentMap, its texels lie at the
// centres of cells, so that each is the mean of four texels of the next larger level, and each level has a border of
// one texel, which holds the neighbours across the octahedron's fold. The fourth component of a texel is its solid
// angle.
struct Cells {
  std::int32_t size = 0;
  std::int32_t offset = 0;

  std::int32_t Floats() const { return (size + 2) * (size + 2) * 4; }
  std::int32_t Origin() const { return offset + (size + 3) * 4; }  // the offset of texel (0, 0)
};

float* RowOf(float* texels, const Cells& cells, std::int32_t row) {
  return texels + cells.Origin() + std::ptrdiff_t(row) * (cells.size + 2) * 4;
}

// Fills the border with the neighbours across the fold: beyond an edge the map continues, mirrored along that edge.
void FillBorder(float* texels, const Cells& level) {
  const std::int32_t n = level.size;
  const auto at = [&](std::int32_t i, std::int32_t j) { return RowOf(texels, level, j) + i * 4; };
  const auto copy = [](const float* from, float* to) { std::copy(from, from + 4, to); };
  for (std::int32_t k = 0; k < n; ++k) {
    copy(at(n - 1 - k, 0), at(k, -1));
    copy(at(n - 1 - k, n - 1), at(k, n));
    copy(at(0, n - 1 - k), at(-1, k));
    copy(at(n - 1, n - 1 - k), at(n, k));
  }
  // All four corners of the square are the direction -Y, so the diagonal neighbour of each is the opposite corner.
  copy(at(n - 1, n - 1), at(-1, -1));
  copy(at(0, n - 1), at(n, -1));
  copy(at(n - 1, 0), at(-1, n));
  copy(at(0, 0), at(n, n));
}

// Pads RGB to 4 floats per pixel, and doubles the row of an image that has only one.
PageVector<float> PadPixels(const Image& rgb, std::int32_t* height) {
  const float* from = rgb.As<float>();
  const std::size_t count = rgb.PixelCount();
  *height = std::max(rgb.height, 2);
  PageVector<float> out(std::size_t(*height) * std::size_t(rgb.width) * 4, 0.0f);
  for (std::size_t i = 0; i < out.size() / 4; ++i) {
    std::copy_n(from + 3 * (i % count), 3, out.data() + 4 * i);
  }
  return out;
}

// Halves the image, whose sides are even. The four pixels are not weighted, as they subtend nearly the same angle.
PageVector<float> HalveImage(const PageVector<float>& in, std::int32_t width, std::int32_t height) {
  const std::size_t w = std::size_t(width) / 2, h = std::size_t(height) / 2;
  PageVector<float> out(w * h * 4);
  ParallelFor(h, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const float* top = in.data() + 2 * y * std::size_t(width) * 4;
      const float* bottom = top + std::size_t(width) * 4;
      float* to = out.data() + y * w * 4;
      for (std::size_t x = 0; x < w; ++x) {
        for (std::size_t c = 0; c < 4; ++c) {
          to[4 * x + c] = 0.25f * ((top[8 * x + c] + top[8 * x + 4 + c]) + (bottom[8 * x + c] + bottom[8 * x + 4 + c]));
        }
      }
    }
  });
  return out;
}

// The largest level of the chain: means of the four texels around each cell.
void FillCells(EnvironmentMap* map, const Level& from, float* texels, const Cells& to) {
  ParallelFor(std::size_t(to.size), 32, [&](std::size_t begin, std::size_t end) {
    for (auto y = std::int32_t(begin); y < std::int32_t(end); ++y) {
      const float* top = RowOf(map, from, y);
      const float* bottom = RowOf(map, from, y + 1);
      float* out = RowOf(texels, to, y);
      for (std::int32_t i = 0; i < 4 * to.size; ++i)
        out[i] = 0.25f * ((top[i] + top[i + 4]) + (bottom[i] + bottom[i + 4]));
    }
  });
  FillBorder(texels, to);
}

// The next smaller level: means of 2 x 2 texels weighted by solid angle. The solid angles are summed.
void HalveSquare(float* texels, const Cells& from, const Cells& to) {
  ParallelFor(std::size_t(to.size), 32, [&](std::size_t begin, std::size_t end) {
    for (auto y = std::int32_t(begin); y < std::int32_t(end); ++y) {
      const float* top = RowOf(texels, from, 2 * y);
      const float* bottom = RowOf(texels, from, 2 * y + 1);
      float* out = RowOf(texels, to, y);
      for (std::int32_t x = 0; x < to.size; ++x) {
        const float* p[4] = {top + 8 * x, top + 8 * x + 4, bottom + 8 * x, bottom + 8 * x + 4};
        const float total = (p[0][3] + p[1][3]) + (p[2][3] + p[3][3]);
        for (int c = 0; c < 3; ++c) {
          const float sum = (p[0][c] * p[0][3] + p[1][c] * p[1][3]) + (p[2][c] * p[2][3] + p[3][c] * p[3][3]);
          out[4 * x + c] = sum / total;
        }
        out[4 * x + 3] = total;
      }
    }
  });
  FillBorder(texels, to);
}

// Sample directions of the GGX lobe whose view and normal are +Z, each with the level of `chain` whose texels are as
// large as the sample's share of the lobe. This is filtered importance sampling (Krivanek and Colbert, 2008, Real-time
// Shading with Filtered Importance Sampling, equation 12), without their bias of one level: bilinear filtering makes
// neighbouring samples overlap anyway, and the bias cost 8 % of a small lamp's peak. Half vectors are distributed as
// GGX, from Hammersley points; the weight of a direction is n_dot_l (Karis, 2013).
std::vector<LobeSample> MakeLobe(double alpha, int count, const std::vector<Cells>& chain) {
  std::vector<LobeSample> samples;
  const double base_solid_angle = 4.0 * kPiDouble / (double(chain[0].size) * double(chain[0].size));
  double total = 0.0;
  for (int i = 0; i < count; ++i) {
    double radical_inverse = 0.0, digit = 0.5;
    for (int bits = i; bits != 0; bits >>= 1, digit *= 0.5) radical_inverse += digit * (bits & 1);
    const double xi = (i + 0.5) / count;
    const double phi = 2.0 * kPiDouble * (radical_inverse + 0.5 / count);
    const double cos2 = (1.0 - xi) / (1.0 + (alpha * alpha - 1.0) * xi);
    const double n_dot_l = 2.0 * cos2 - 1.0;
    if (n_dot_l <= 0.0) continue;
    const double sin_l = 2.0 * std::sqrt(cos2 * (1.0 - cos2));
    const double t = cos2 * (alpha * alpha - 1.0) + 1.0;
    const double pdf = alpha * alpha / (kPiDouble * t * t) * 0.25;  // D n_dot_h / (4 v_dot_h), where v = n
    const double texels = 1.0 / (count * pdf) / base_solid_angle;
    std::size_t level = 0;
    // The factor sqrt(2) rounds to the nearest level.
    for (double edge2 = 2.0; level + 1 < chain.size() && texels > edge2; edge2 *= 4.0) ++level;
    LobeSample s;
    s.x = static_cast<float>(sin_l * Cos(phi));
    s.y = static_cast<float>(sin_l * Sin(phi));
    s.z = static_cast<float>(n_dot_l);
    s.weight = static_cast<float>(n_dot_l);
    s.size = chain[level].size;
    s.origin = chain[level].Origin();
    total += n_dot_l;
    samples.push_back(s);
  }
  for (LobeSample& s : samples) s.weight = static_cast<float>(s.weight / total);
  return samples;
}

glm::dvec3 DirectionOfCell(std::int32_t i, std::int32_t j, std::int32_t size) {
  const double u = 2.0 * (i + 0.5) / size - 1.0;
  const double v = 2.0 * (j + 0.5) / size - 1.0;
  const double y = 1.0 - std::fabs(u) - std::fabs(v);
  const double x = y < 0.0 ? std::copysign(1.0 - std::fabs(v), u) : u;
  const double z = y < 0.0 ? std::copysign(1.0 - std::fabs(u), v) : v;
  return glm::dvec3(x, y, z) / std::sqrt(x * x + y * y + z * z);
}

// The light of each cell of `coarse` gets the direction of the centroid of the light of its cells in `fine`, so that
// the position of a sun is kept to a fraction of a coarse cell.
std::vector<SourceTexel> MakeSource(const float* texels, const Cells& fine, const Cells& coarse) {
  struct Moments {
    glm::dvec3 light{0.0}, area{0.0};
  };
  const std::int32_t ratio = fine.size / coarse.size;
  std::vector<Moments> moments(std::size_t(coarse.size) * std::size_t(coarse.size));
  for (std::int32_t j = 0; j < fine.size; ++j) {
    const float* row = texels + fine.Origin() + std::ptrdiff_t(j) * (fine.size + 2) * 4;
    for (std::int32_t i = 0; i < fine.size; ++i) {
      const float* p = row + 4 * i;
      const glm::dvec3 area = DirectionOfCell(i, j, fine.size) * double(p[3]);
      Moments& m = moments[std::size_t(j / ratio * coarse.size + i / ratio)];
      m.area += area;
      m.light += area * (double(p[0]) + double(p[1]) + double(p[2]));
    }
  }
  const auto unit = [](const glm::dvec3& v) { return glm::vec3(v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)); };
  std::vector<SourceTexel> source;
  source.reserve(moments.size());
  for (std::int32_t j = 0; j < coarse.size; ++j) {
    const float* row = texels + coarse.Origin() + std::ptrdiff_t(j) * (coarse.size + 2) * 4;
    for (std::int32_t i = 0; i < coarse.size; ++i) {
      const Moments& m = moments[source.size()];
      const glm::vec3 center = unit(m.area);
      const glm::vec3 light = m.light == glm::dvec3(0.0) ? center : unit(m.light);
      const float* p = row + 4 * i;
      source.push_back({light.x, light.y, light.z, center.x, center.y, center.z, p[3], p[0] * p[3], p[1] * p[3],
                        p[2] * p[3]});
    }
  }
  return source;
}

// Levels below kFirstConvolved are importance sampled. The others have lobes wide enough to be summed over all texels
// of a small map.
constexpr int kFirstConvolved = 4;
constexpr std::int32_t kConvolvedSize = 32;
static_assert(kFirstConvolved + kConvolvedLobes + 1 == EnvironmentMap::kLevels);
static_assert(kConvolvedSize == EnvironmentMap::kIrradianceSize);
constexpr std::int32_t kNominalSize[EnvironmentMap::kLevels] = {
    0, 256, 128, 64, kConvolvedSize, kConvolvedSize, kConvolvedSize, kConvolvedSize, kConvolvedSize};
constexpr int kSampleFactor[kFirstConvolved] = {0, 1, 2, 4};
constexpr std::int32_t kSourceSize = 32, kCentroidSize = 128;
constexpr std::int32_t kSmallestBase = 64;
constexpr std::int32_t kSmallestOfChain = 8;  // smaller levels are too distorted for bilinear filtering

double AlphaOfLevel(int level) {
  const double perceptual_roughness = double(level) / (EnvironmentMap::kLevels - 1);
  return perceptual_roughness * perceptual_roughness;
}

void FillSampledLevels(EnvironmentMap* map, const PageVector<float>& chain_texels, const std::vector<Cells>& chain,
                       int samples) {
  std::array<std::vector<LobeSample>, kFirstConvolved> lobes;
  struct Row {
    int level;
    std::int32_t row;
  };
  std::vector<Row> rows;
  for (int k = 1; k < kFirstConvolved; ++k) {
    lobes[k] = MakeLobe(AlphaOfLevel(k), samples * kSampleFactor[k], chain);
    for (std::int32_t row = 0; row <= map->levels[k].size; ++row) rows.push_back({k, row});
  }
  ParallelFor(rows.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& lobe = lobes[rows[i].level];
      const Level& level = map->levels[rows[i].level];
      FilterLobeRow({chain_texels.data(), lobe.data(), std::int32_t(lobe.size()), level.size, rows[i].row,
                     RowOf(map, level, rows[i].row)});
    }
  });
}

// Fills the levels of high roughness.
void FillConvolvedLevels(EnvironmentMap* map, const std::vector<SourceTexel>& source) {
  ParallelFor(std::size_t(kConvolvedSize) + 1, 2, [&](std::size_t begin, std::size_t end) {
    for (auto row = std::int32_t(begin); row < std::int32_t(end); ++row) {
      ConvolveRowTask task{source.data(), std::int32_t(source.size()), {}, kConvolvedSize, row, {}};
      for (int k = 0; k <= kConvolvedLobes; ++k) {
        if (k < kConvolvedLobes) task.alpha[k] = static_cast<float>(AlphaOfLevel(kFirstConvolved + k));
        task.out[k] = RowOf(map, map->levels[kFirstConvolved + k], row);
      }
      ConvolveRow(task);
    }
  });
}

// Fills the irradiance map. By convolution it equals the roughest level, which is radiance weighted by the cosine.
void FillIrradiance(EnvironmentMap* map, const std::vector<SourceTexel>& source, IrradianceMethod method) {
  if (method == IrradianceMethod::SphericalHarmonics) {
    FillIrradianceFromHarmonics(source, map->irradiance.size, RowOf(map, map->irradiance, 0));
    return;
  }
  const float* roughest = RowOf(map, map->levels[EnvironmentMap::kLevels - 1], 0);
  std::copy_n(roughest, (kConvolvedSize + 1) * (kConvolvedSize + 1) * 4, RowOf(map, map->irradiance, 0));
}

}  // namespace

// Gives the equator about as many texels as the image's width: in an octahedral map it is four half-edges at 45
// degrees.
std::int32_t SharpestLevelSize(std::int32_t image_width, std::int32_t max_size) {
  std::int32_t base = kSmallestBase;
  while (base * 2 <= image_width / 2 && base * 2 <= max_size) base *= 2;
  return base;
}

std::size_t AssignLevels(std::int32_t base, EnvironmentMap& map) {
  std::int32_t floats = 0;
  const auto place = [&floats](std::int32_t size) {
    const Level level{size, floats};
    floats += (size + 1) * (size + 1) * 4;
    return level;
  };
  for (int k = 0; k < EnvironmentMap::kLevels; ++k) {
    map.levels[k] = place(k == 0 ? base : std::min(base / 2, kNominalSize[k]));
    map.level_offset[k] = map.levels[k].offset;
    map.level_size[k] = static_cast<float>(map.levels[k].size);
  }
  map.irradiance = place(EnvironmentMap::kIrradianceSize);
  return std::size_t(floats);
}

void LayOutLevels(std::int32_t base, EnvironmentMap& map) {
  map.texels.assign(AssignLevels(base, map), 0.0f);
  map.texel_data = map.texels.data();
}

std::shared_ptr<const EnvironmentMap> PrefilterEnvironment(const Image& equirectangular,
                                                           const EnvironmentOptions& options) {
  // Kernels use 32-bit indices; the limits are the same as for decoded images.
  const std::int64_t pixels = std::int64_t{equirectangular.width} * equirectangular.height;
  if (equirectangular.width > kMaxImageSide || equirectangular.height > kMaxImageSide ||
      pixels > std::int64_t{kMaxImagePixels}) {
    throw Error(ErrorCode::OutOfMemory,
                std::to_string(equirectangular.width) + " x " + std::to_string(equirectangular.height) +
                    " pixels are more than the limit of " + std::to_string(kMaxImageSide) + " a side and " +
                    std::to_string(kMaxImagePixels) + " in all",
                "environment", "scale the picture down");
  }
  CheckImage(equirectangular, "environment");
  auto map = std::make_shared<EnvironmentMap>();
  std::int32_t width = equirectangular.width, height = 0;
  PageVector<float> image = PadPixels(ToLinearRgb32F(equirectangular, &map->repaired_values), &height);
  if (options.keep_image) {
    map->image = image;
    map->image_width = width;
    map->image_height = height;
    map->image_data = map->image.data();
  }

  const std::int32_t base = SharpestLevelSize(width, options.max_size);
  while (width / 4 >= base && width % 2 == 0 && height % 2 == 0 && height >= 4) {
    image = HalveImage(image, width, height);
    width /= 2;
    height /= 2;
  }

  LayOutLevels(base, *map);

  ParallelFor(std::size_t(base) + 1, 8, [&](std::size_t begin, std::size_t end) {
    for (auto row = std::int32_t(begin); row < std::int32_t(end); ++row) {
      FillOctahedronRow({image.data(), width, height, base, row, RowOf(map.get(), map->levels[0], row)});
    }
  });

  std::vector<Cells> chain;
  std::int32_t chain_floats = 0;
  for (std::int32_t size = base; size >= kSmallestOfChain; size /= 2) {
    chain.push_back({size, chain_floats});
    chain_floats += chain.back().Floats();
  }
  PageVector<float> chain_texels(std::size_t(chain_floats), 0.0f);
  FillCells(map.get(), map->levels[0], chain_texels.data(), chain[0]);
  for (std::size_t k = 1; k < chain.size(); ++k) HalveSquare(chain_texels.data(), chain[k - 1], chain[k]);

  FillSampledLevels(map.get(), chain_texels, chain, options.samples);
  const auto level_of = [&](std::int32_t size) {
    return *std::find_if(chain.begin(), chain.end(), [&](const Cells& c) { return c.size <= size; });
  };
  const std::vector<SourceTexel> source =
      MakeSource(chain_texels.data(), level_of(kCentroidSize), level_of(kSourceSize));
  FillConvolvedLevels(map.get(), source);
  FillIrradiance(map.get(), source, options.irradiance);
  return map;
}

}  // namespace facet

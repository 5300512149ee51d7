#include "light/environment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "image/convert.h"
#include "light/environment_kernels.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPiDouble = 3.14159265358979324;

using Level = EnvironmentMap::Level;

std::int32_t SquareFloats(std::int32_t size) { return (size + 2) * (size + 2) * 4; }

std::int32_t OriginOf(const Level& level) { return level.offset + (level.size + 3) * 4; }

float* RowOf(float* texels, const Level& level, std::int32_t row) {
  return texels + OriginOf(level) + std::ptrdiff_t(row) * (level.size + 2) * 4;
}

// Copies each border texel from its neighbour across the fold: beyond an edge the map goes on mirrored along that edge.
void FillBorder(float* texels, const Level& level) {
  const std::int32_t n = level.size;
  const auto at = [&](std::int32_t i, std::int32_t j) { return RowOf(texels, level, j) + i * 4; };
  const auto copy = [](const float* from, float* to) { std::copy(from, from + 4, to); };
  for (std::int32_t k = 0; k < n; ++k) {
    copy(at(n - 1 - k, 0), at(k, -1));
    copy(at(n - 1 - k, n - 1), at(k, n));
    copy(at(0, n - 1 - k), at(-1, k));
    copy(at(n - 1, n - 1 - k), at(n, k));
  }
  // The four corners of the square are one direction, -Y: each one's diagonal neighbour is the opposite corner.
  copy(at(n - 1, n - 1), at(-1, -1));
  copy(at(0, n - 1), at(n, -1));
  copy(at(n - 1, 0), at(-1, n));
  copy(at(0, 0), at(n, n));
}

// RGB to 4 floats a pixel; at least two rows.
std::vector<float> PadPixels(const Image& rgb, std::int32_t* height) {
  const float* from = rgb.As<float>();
  const std::size_t count = rgb.PixelCount();
  *height = std::max(rgb.height, 2);
  std::vector<float> out(std::size_t(*height) * std::size_t(rgb.width) * 4, 0.0f);
  for (std::size_t i = 0; i < out.size() / 4; ++i) {
    std::copy_n(from + 3 * (i % count), 3, out.data() + 4 * i);
  }
  return out;
}

// Half the size; both sizes are even. Neighbouring pixels subtend nearly the same angle.
std::vector<float> HalvePicture(const std::vector<float>& in, std::int32_t width, std::int32_t height) {
  const std::size_t w = std::size_t(width) / 2, h = std::size_t(height) / 2;
  std::vector<float> out(w * h * 4);
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

// Means of 2 x 2 texels weighted by solid angle, which is the fourth number and is added up.
void HalveSquare(float* texels, const Level& from, const Level& to) {
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

// Directions about +Z distributed as GGX reflects light when view and normal are +Z, each with the square of `chain`
// whose texels are as large as its share of the lobe: filtered importance sampling (Krivanek and Colbert, 2008,
// Real-time Shading with Filtered Importance Sampling, equation 12; their bias of one level is kept). Half vectors are
// taken from GGX's distribution at Hammersley's points; a direction's weight is n_dot_l (Karis, 2013).
std::vector<LobeSample> MakeLobe(double alpha, int count, const std::vector<Level>& chain) {
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
    const double texels = 4.0 / (count * pdf) / base_solid_angle;   // 4: the bias
    std::size_t level = 0;
    // sqrt(2) below the next level's edge length rounds the level to the nearest.
    for (double edge2 = 2.0; level + 1 < chain.size() && texels > edge2; edge2 *= 4.0) ++level;
    LobeSample s;
    s.x = static_cast<float>(sin_l * Cos(phi));
    s.y = static_cast<float>(sin_l * Sin(phi));
    s.z = static_cast<float>(n_dot_l);
    s.weight = static_cast<float>(n_dot_l);
    s.size = chain[level].size;
    s.origin = OriginOf(chain[level]);
    total += n_dot_l;
    samples.push_back(s);
  }
  for (LobeSample& s : samples) s.weight = static_cast<float>(s.weight / total);
  return samples;
}

std::vector<SourceTexel> MakeSource(const float* texels, const Level& level) {
  std::vector<SourceTexel> source;
  source.reserve(std::size_t(level.size) * std::size_t(level.size));
  for (std::int32_t j = 0; j < level.size; ++j) {
    const float* row = texels + OriginOf(level) + std::ptrdiff_t(j) * (level.size + 2) * 4;
    for (std::int32_t i = 0; i < level.size; ++i) {
      const double u = 2.0 * (i + 0.5) / level.size - 1.0;
      const double v = 2.0 * (j + 0.5) / level.size - 1.0;
      const double y = 1.0 - std::fabs(u) - std::fabs(v);
      const double x = y < 0.0 ? std::copysign(1.0 - std::fabs(v), u) : u;
      const double z = y < 0.0 ? std::copysign(1.0 - std::fabs(u), v) : v;
      const double length = std::sqrt(x * x + y * y + z * z);
      const float* p = row + 4 * i;
      source.push_back({static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length),
                        p[3], p[0] * p[3], p[1] * p[3], p[2] * p[3]});
    }
  }
  return source;
}

// Levels below kFirstConvolved are sampled, the others are rough enough to be summed over every texel of a small map.
constexpr int kFirstConvolved = 5;
constexpr std::int32_t kNominalSize[EnvironmentMap::kLevels] = {0, 256, 128, 64, 64, 32, 32, 32, 32};
constexpr int kSampleCount[kFirstConvolved] = {0, 32, 64, 64, 128};
constexpr std::int32_t kSourceSize = 64;
constexpr std::int32_t kSmallestBase = 64;
constexpr std::int32_t kSmallestOfChain = 8;  // coarser squares bend too much for bilinear reading

double AlphaOfLevel(int level) {
  const double perceptual_roughness = double(level) / (EnvironmentMap::kLevels - 1);
  return perceptual_roughness * perceptual_roughness;
}

void FillSampledLevels(EnvironmentMap* map, const std::vector<float>& chain_texels, const std::vector<Level>& chain) {
  std::array<std::vector<LobeSample>, kFirstConvolved> lobes;
  struct Row {
    int level;
    std::int32_t row;
  };
  std::vector<Row> rows;
  for (int k = 1; k < kFirstConvolved; ++k) {
    lobes[k] = MakeLobe(AlphaOfLevel(k), kSampleCount[k], chain);
    for (std::int32_t row = 0; row < map->levels[k].size; ++row) rows.push_back({k, row});
  }
  ParallelFor(rows.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& lobe = lobes[rows[i].level];
      const Level& level = map->levels[rows[i].level];
      FilterLobeRow({chain_texels.data(), lobe.data(), std::int32_t(lobe.size()), level.size, rows[i].row,
                     RowOf(map->texels.data(), level, rows[i].row)});
    }
  });
  for (int k = 1; k < kFirstConvolved; ++k) FillBorder(map->texels.data(), map->levels[k]);
}

void FillConvolvedLevels(EnvironmentMap* map, const std::vector<SourceTexel>& source) {
  constexpr int kCount = EnvironmentMap::kLevels - kFirstConvolved;
  static_assert(kCount + 1 <= kMaxConvolutions && EnvironmentMap::kIrradianceSize == 32);
  const Level* squares[kCount + 1];
  for (int k = 0; k < kCount; ++k) squares[k] = &map->levels[kFirstConvolved + k];
  squares[kCount] = &map->irradiance;
  float* texels = map->texels.data();
  ParallelFor(EnvironmentMap::kIrradianceSize, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      ConvolveRowTask task{source.data(), std::int32_t(source.size()), kCount + 1, {},
                           EnvironmentMap::kIrradianceSize, std::int32_t(row), {}};
      for (int k = 0; k <= kCount; ++k) {
        task.alpha[k] = k < kCount ? static_cast<float>(AlphaOfLevel(kFirstConvolved + k)) : 0.0f;
        task.out[k] = RowOf(texels, *squares[k], std::int32_t(row));
      }
      ConvolveRow(task);
    }
  });
  for (const Level* square : squares) FillBorder(texels, *square);
}

}  // namespace

std::shared_ptr<const EnvironmentMap> PrefilterEnvironment(const Image& equirectangular,
                                                           const EnvironmentOptions& options) {
  CheckImage(equirectangular, "environment");
  auto map = std::make_shared<EnvironmentMap>();
  std::int32_t width = equirectangular.width, height = 0;
  std::vector<float> picture =
      PadPixels(ToLinearRgb32F(equirectangular, &map->repaired_values), &height);
  if (options.keep_picture) {
    map->picture = picture;
    map->picture_width = width;
    map->picture_height = height;
    map->picture_data = map->picture.data();
  }

  // About as many texels around as the picture has: an octahedral map's equator is four half-edges of 45 degrees tilt.
  std::int32_t base = kSmallestBase;
  while (base * 2 <= width / 2 && base * 2 <= options.max_size) base *= 2;
  while (width / 4 >= base && width % 2 == 0 && height % 2 == 0 && height >= 4) {
    picture = HalvePicture(picture, width, height);
    width /= 2;
    height /= 2;
  }

  // The levels, one after the other, then the irradiance.
  std::int32_t floats = 0;
  const auto place = [&floats](std::int32_t size) {
    const Level level{size, floats};
    floats += SquareFloats(size);
    return level;
  };
  for (int k = 0; k < EnvironmentMap::kLevels; ++k) {
    map->levels[k] = place(k == 0 ? base : std::min(base, kNominalSize[k]));
    map->level_stride[k] = map->levels[k].size + 2;
    map->level_offset[k] = OriginOf(map->levels[k]);
    map->level_size[k] = static_cast<float>(map->levels[k].size);
  }
  map->irradiance = place(EnvironmentMap::kIrradianceSize);
  map->texels.assign(std::size_t(floats), 0.0f);
  map->texel_data = map->texels.data();

  // The chain of ever smaller squares that the lobes are read from; its first is level 0.
  std::vector<Level> chain;
  std::int32_t chain_floats = 0;
  for (std::int32_t size = base; size >= kSmallestOfChain; size /= 2) {
    chain.push_back({size, chain_floats});
    chain_floats += SquareFloats(size);
  }
  std::vector<float> chain_texels(std::size_t(chain_floats), 0.0f);
  ParallelFor(std::size_t(base), 8, [&](std::size_t begin, std::size_t end) {
    for (auto row = std::int32_t(begin); row < std::int32_t(end); ++row) {
      FillOctahedronRow({picture.data(), width, height, base, row, RowOf(chain_texels.data(), chain[0], row)});
    }
  });
  FillBorder(chain_texels.data(), chain[0]);
  for (std::size_t k = 1; k < chain.size(); ++k) HalveSquare(chain_texels.data(), chain[k - 1], chain[k]);
  std::copy_n(chain_texels.begin(), SquareFloats(base), map->texels.begin());

  FillSampledLevels(map.get(), chain_texels, chain);
  const auto source_level = std::find_if(chain.begin(), chain.end(), [](const Level& l) { return l.size == kSourceSize; });
  FACET_CHECK(source_level != chain.end());
  FillConvolvedLevels(map.get(), MakeSource(chain_texels.data(), *source_level));
  return map;
}

}  // namespace facet

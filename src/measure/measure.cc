#include "measure/measure.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "compare/flip.h"
#include "facet/compare.h"
#include "image/convert.h"

namespace facet {
namespace {

// A line like "VmHWM:    1234 kB" of this process's status in bytes, or 0 if it is missing.
std::size_t StatusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kibibytes = 0;
    if (word == key + ":" && status >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

// Sums up the differences of R, G and B.
class ErrorSum {
 public:
  void Add(const glm::dvec3& value, const glm::dvec3& reference) {
    const glm::dvec3 difference = value - reference;
    squares_ += glm::dot(difference, difference);
    reference_squares_ += glm::dot(reference, reference);
    for (int c = 0; c < 3; ++c) largest_ = std::max(largest_, std::fabs(difference[c]));
    numbers_ += 3.0;
  }
  void Add(const ErrorSum& other) {
    squares_ += other.squares_;
    reference_squares_ += other.reference_squares_;
    largest_ = std::max(largest_, other.largest_);
    numbers_ += other.numbers_;
  }
  double Squares() const { return squares_; }
  double ReferenceSquares() const { return reference_squares_; }
  FilmError Result() const {
    FilmError error;
    error.rmse = std::sqrt(squares_ / std::max(numbers_, 1.0));
    error.relative_rmse = squares_ > 0.0 ? std::sqrt(squares_ / std::max(reference_squares_, 1e-300)) : 0.0;
    error.largest = largest_;
    return error;
  }

 private:
  double squares_ = 0.0, reference_squares_ = 0.0, largest_ = 0.0, numbers_ = 0.0;
};

// The means over squares of n x n of width x height `pixels`.
template <class Pixel>
std::vector<Pixel> BoxMeans(const Pixel* pixels, int width, int height, int n) {
  const int w = width / n, h = height / n;
  std::vector<Pixel> means(std::size_t(w) * std::size_t(h), Pixel(0.0f));
  for (int y = 0; y < h * n; ++y) {
    for (int x = 0; x < w * n; ++x) {
      means[std::size_t(y / n) * std::size_t(w) + std::size_t(x / n)] +=
          pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] / float(n * n);
    }
  }
  return means;
}

// The standard error of the relative RMSE over blocks that are `share` of the image, as an estimate for all of it. From
// the variance of a ratio estimate (Cochran, 1977, Sampling Techniques, section 2.11) as if the blocks were chosen
// independently; they are spread evenly, which makes the actual error smaller.
double StandardError(const std::vector<ErrorSum>& blocks, const ErrorSum& all, double share) {
  if (share >= 1.0 || blocks.size() < 2 || !(all.Squares() > 0.0 && all.ReferenceSquares() > 0.0)) return 0.0;
  const double ratio = all.Squares() / all.ReferenceSquares(), count = double(blocks.size());
  double off2 = 0.0;
  for (const ErrorSum& block : blocks) {
    const double off = block.Squares() - ratio * block.ReferenceSquares();
    off2 += off * off;
  }
  const double of_ratio = std::sqrt((1.0 - share) * count / (count - 1.0) * off2) / all.ReferenceSquares();
  return of_ratio / (2.0 * std::sqrt(ratio));
}

// Calls row(first, place) for each row of a part, with the indices of its first pixel in the image, which is `width`
// wide, and in the part itself.
template <class Row>
void ForEachRow(const PixelBlock& part, int width, const Row& row) {
  for (int y = 0; y < part.height; ++y) {
    row(std::size_t(part.y + y) * std::size_t(width) + std::size_t(part.x), std::size_t(y) * std::size_t(part.width));
  }
}

Image PartOf(const Image& rgba, const PixelBlock& part) {
  Image out{part.width, part.height, 4, ChannelType::F32, Encoding::Linear, {}};
  constexpr std::size_t kPixel = 4 * sizeof(float);
  out.bytes.resize(out.PixelCount() * kPixel);
  ForEachRow(part, rgba.width, [&](std::size_t first, std::size_t place) {
    std::memcpy(out.bytes.data() + place * kPixel, rgba.bytes.data() + first * kPixel,
                std::size_t(part.width) * kPixel);
  });
  return out;
}

bool IsOpaque(const Image& rgba) {
  const float* pixels = rgba.As<float>();
  for (std::size_t i = 0; i < rgba.PixelCount(); ++i) {
    if (pixels[4 * i + 3] != 1.0f) return false;
  }
  return true;
}

// At most the shorter side, so that very long images keep at least one pixel in it.
int Divisor(int width, int height, int longest) {
  const int n = (std::max(width, height) + longest - 1) / longest;
  return std::min({n, width, height});
}

}  // namespace

std::size_t PeakBytes(const std::function<void()>& body) {
  malloc_trim(0);  // otherwise memory freed by earlier renderings hides growth
  const std::size_t before = StatusBytes("VmRSS");
  bool reset = false;
  {
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5";  // resets the peak; see proc(5) of Linux
    clear.flush();
    reset = clear.good();
  }
  body();
  const std::size_t peak = StatusBytes("VmHWM");
  return reset && before > 0 && peak > before ? peak - before : 0;
}

std::vector<PointTime> TimesOf(const std::vector<std::vector<double>>& rounds) {
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  std::vector<double> totals;
  for (const std::vector<double>& round : rounds) totals.push_back(std::accumulate(round.begin(), round.end(), 0.0));
  const double usual = median(totals);
  std::vector<PointTime> times(rounds.front().size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::vector<double> runs, shares;
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      runs.push_back(rounds[k][i]);
      shares.push_back(totals[k] > 0.0 ? rounds[k][i] / totals[k] : 0.0);
    }
    const auto [low, high] = std::minmax_element(runs.begin(), runs.end());
    times[i] = {std::clamp(median(shares) * usual, *low, *high), *low, *high};
  }
  return times;
}

FilmError ErrorOf(const Film& film, const ReferenceFilm& reference) {
  std::vector<ErrorSum> blocks(reference.blocks.size());
  ErrorSum all;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const PixelBlock& block = reference.blocks[i];
    ForEachRow(block, film.width, [&](std::size_t first, std::size_t) {
      for (std::size_t at = first; at < first + std::size_t(block.width); ++at) {
        blocks[i].Add(glm::dvec3(film.pixels[at]), glm::dvec3(reference.pixels[at]));
      }
    });
    all.Add(blocks[i]);
  }
  FilmError error = all.Result();
  error.standard_error = StandardError(blocks, all, double(reference.known_pixels) / double(reference.pixels.size()));
  return error;
}

FilmError ErrorOf(const Film& film, const Film& reference) {
  ErrorSum sum;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    sum.Add(glm::dvec3(film.pixels[i]), glm::dvec3(reference.pixels[i]));
  }
  return sum.Result();
}

Film Reduced(const Film& film, int longest) {
  const int n = Divisor(film.width, film.height, longest);
  Film reduced{film.width / n, film.height / n, BoxMeans(film.pixels.data(), film.width, film.height, n)};
  if (!film.through.empty()) reduced.through = BoxMeans(film.through.data(), film.width, film.height, n);
  return reduced;
}

FlipJudge::FlipJudge(const ReferenceFilm& reference, const Image& encoded)
    : light_(ToLinearRgba32F(encoded)),
      parts_(reference.blocks),
      known_pixels_(reference.known_pixels),
      whole_(reference.whole) {
  if (whole_) parts_ = {{0, 0, reference.width, reference.height}};
}

FlipJudge::Verdict FlipJudge::Judge(const Image& encoded) const {
  const Image light = ToLinearRgba32F(encoded);
  Verdict verdict;
  verdict.errors.assign(light.PixelCount(), 0.0f);
  std::vector<double> sums(parts_.size(), 0.0);
  ParallelFor(parts_.size(), 1, [&](std::size_t i, std::size_t) {
    const PixelBlock& part = parts_[i];
    const Image a = PartOf(light_, part), b = PartOf(light, part);
    // The larger error over black and over white, as in CompareImages().
    std::vector<float> errors = FlipErrors(a, b, {kDefaultPixelsPerDegree, 0.0f, {}});
    if (!IsOpaque(a) || !IsOpaque(b)) {
      const std::vector<float> over_white = FlipErrors(a, b, {kDefaultPixelsPerDegree, 1.0f, {}});
      for (std::size_t k = 0; k < errors.size(); ++k) errors[k] = std::max(errors[k], over_white[k]);
    }
    for (const float error : errors) sums[i] += double(error);
    ForEachRow(part, light.width, [&](std::size_t first, std::size_t place) {
      std::copy_n(errors.data() + place, part.width, verdict.errors.data() + first);
    });
  });
  for (const double sum : sums) verdict.mean += sum / double(known_pixels_);
  return verdict;
}

Image FlipJudge::Map(const Verdict& verdict, int longest) const {
  const int width = light_.width, height = light_.height, n = Divisor(width, height, longest);
  std::vector<float> known(verdict.errors.size(), 0.0f);
  for (const PixelBlock& part : parts_) {
    ForEachRow(part, width,
               [&](std::size_t first, std::size_t) { std::fill_n(known.data() + first, part.width, 1.0f); });
  }
  std::vector<float> means = BoxMeans(verdict.errors.data(), width, height, n);
  const std::vector<float> shares = BoxMeans(known.data(), width, height, n);
  for (std::size_t i = 0; i < means.size(); ++i) means[i] = shares[i] > 0.0f ? means[i] / shares[i] : 0.0f;

  ImageDifference difference;
  difference.width = width / n;
  difference.height = height / n;
  difference.flip_map = {width / n, height / n, 1, ChannelType::F32, Encoding::Linear, {}};
  const auto* bytes = reinterpret_cast<const std::byte*>(means.data());
  difference.flip_map.bytes.assign(bytes, bytes + means.size() * sizeof(float));
  Image map = HeatMap(difference);
  if (whole_) return map;
  map = WithChannels(map, 4);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i] > 0.0f)) map.bytes[4 * i + 3] = std::byte{0};
  }
  return map;
}

}  // namespace facet

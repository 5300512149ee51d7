#include "report/measure.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace facet {
namespace {

// A line like "VmHWM:    1234 kB" of this process' status, in bytes; 0 where there is none.
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

// The means of `pixels`, width x height of them, over squares of n x n.
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

// A picture may be much longer than wide: no side may vanish.
int Divisor(int width, int height, int longest) {
  const int n = (std::max(width, height) + longest - 1) / longest;
  return std::min({n, width, height});
}

}  // namespace

std::size_t PeakBytes(const std::function<void()>& body) {
  malloc_trim(0);  // what earlier renderings gave back is not counted as there already
  const std::size_t before = StatusBytes("VmRSS");
  bool reset = false;
  {
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5";  // the peak begins anew (Linux' proc(5))
    clear.flush();
    reset = clear.good();
  }
  body();
  const std::size_t peak = StatusBytes("VmHWM");
  return reset && before > 0 && peak > before ? peak - before : 0;
}

FilmError ErrorOf(const Film& film, const ReferenceFilm& reference) {
  ErrorSum sum;
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    sum.Add(glm::dvec3(film.pixels[i]), glm::dvec3(reference.pixels[i]));
  }
  return sum.Result();
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
  return {film.width / n, film.height / n, BoxMeans(film.pixels.data(), film.width, film.height, n)};
}

Image Reduced(const Image& image, int longest) {
  const int n = Divisor(image.width, image.height, longest);
  const std::vector<float> means = BoxMeans(image.As<float>(), image.width, image.height, n);
  Image reduced{image.width / n, image.height / n, 1, ChannelType::F32, image.encoding, {}};
  const auto* bytes = reinterpret_cast<const std::byte*>(means.data());
  reduced.bytes.assign(bytes, bytes + means.size() * sizeof(float));
  return reduced;
}

}  // namespace facet

// From the film to files: exposures and numbers at the ends of what files hold.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "image/image_test_util.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

const float kValues[] = {0.0f, 1e-44f, 1e-38f, 1e-30f, 1e-6f, 0.18f, 1.0f, 65504.0f, 65536.0f, 1e6f, 1e30f, 3.4e38f};

Film ValuesFilm(float alpha) {
  Film film;
  for (const float v : kValues) film.pixels.emplace_back(v * alpha, v * alpha * 0.5f, 0.0f, alpha);
  film.width = int(film.pixels.size());
  film.height = 1;
  return film;
}

bool AllFinite(const Image& image) {
  for (std::size_t i = 0; i < image.PixelCount() * std::size_t(image.channels); ++i) {
    if (!std::isfinite(image.As<float>()[i])) return false;
  }
  return true;
}

// Exposure multiplies by a power of two, which is exact; what overflows is the largest float, what underflows rounds to
// a subnormal number or 0: half a unit of 2^-149, or 2^-24 of the smallest normal number, against which it counts. In
// bytes, tone curves keep order: brighter light is never a smaller code.
Measured MeasureExposure() {
  Measured m;
  const Film film = ValuesFilm(1.0f);
  for (const double ev : {-200.0, -60.0, -1.0, 0.0, 1.0, 60.0, 200.0}) {
    DisplaySettings settings;
    settings.exposure_ev = ev;
    const Image file = EncodeFilm(film, settings, ChannelType::F32);
    m.Expect(AllFinite(file), "an exposed number is not finite");
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      const double clamped_ev = std::fmax(-126.0, std::fmin(126.0, ev));
      const double exact = std::ldexp(double(film.pixels[i].r), int(clamped_ev));
      const double want = std::fmin(exact, double(std::numeric_limits<float>::max()));
      m.Error(std::fabs(double(file.As<float>()[4 * i]) - want) / std::fmax(want, 0x1p-126));
    }
    for (const ToneMap tone_map :
         {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::AgX, ToneMap::Neutral, ToneMap::Filmic,
          ToneMap::Generic, ToneMap::Gt7, ToneMap::AgXGolden, ToneMap::AgXPunchy}) {
      settings.tone_map = tone_map;
      Film grey = film;
      for (glm::vec4& p : grey.pixels) p.g = p.b = p.r;
      const Image bytes = EncodeFilm(grey, settings, ChannelType::U8);
      for (std::size_t i = 1; i < grey.pixels.size(); ++i) {
        m.Expect(bytes.As<std::uint8_t>()[4 * i] >= bytes.As<std::uint8_t>()[4 * i - 4],
                 "more light is a darker code with tone curve " + std::to_string(int(tone_map)) + " at " +
                     std::to_string(ev) + " EV");
      }
    }
  }
  return m;
}

// Colour is divided by alpha, however small. Bound: the film's product and this quotient round once each; subnormal
// products have fewer digits and are left out.
Measured MeasureTinyAlpha() {
  Measured m;
  for (const float alpha : {1.0f, 1e-3f, 1e-10f, 1e-30f, 1e-44f}) {
    const Film film = ValuesFilm(alpha);
    const Image file = EncodeFilm(film, {}, ChannelType::F32);
    m.Expect(AllFinite(file), "an unpremultiplied number is not finite");
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      if (film.pixels[i].r < 1e-37f || alpha < 1e-37f) continue;
      const double want = double(kValues[i]);
      m.Error(std::fabs(double(file.As<float>()[4 * i]) - want) / want);
    }
  }
  return m;
}

// Files of floats hold 32 bits a number: light above 65504, where half floats end, comes back with its bits.
Measured MeasureFloatFiles() {
  Measured m;
  const Image image = EncodeFilm(ValuesFilm(1.0f), {}, ChannelType::F32);
  const TemporaryFolder folder;
  for (const char* name : {"light.exr", "light.tif"}) {
    try {
      WriteImage(folder / name, image);
      const Image back = LoadImage(folder / name);
      m.Expect(back.type == ChannelType::F32 && back.bytes.size() == image.bytes.size(), "not read as floats");
      if (back.bytes.size() != image.bytes.size()) continue;
      for (std::size_t i = 0; i < image.PixelCount() * 4; ++i) {
        m.Error(std::fabs(double(back.As<float>()[i]) - double(image.As<float>()[i])));
      }
    } catch (const facet::Error& error) {
      if (error.code() == ErrorCode::MissingModule) {
        m.skipped = error.what();
      } else {
        m.Expect(false, error.what());
      }
    }
  }
  return m;
}

}  // namespace

std::vector<Case> FilmCases() {
  return {
      {"files", "exposure by -200 to 200 EV, ±60 among them", "infinite factors; 0 · infinity; codes that wrap round",
       "factors within 2^±126; what overflows is the largest float", "relative", 0x1p-24, MeasureExposure},
      {"files", "alpha down to 1e-44", "division by nearly 0 gives infinity or NaN",
       "the quotient of what was multiplied, the largest float at most", "relative", 0x1p-22, MeasureTinyAlpha},
      {"files", "light of 1e-38 to 3.4e38 in EXR and TIFF", "half floats: infinite above 65504, 0 below 6e-8",
       "32-bit floats are written", "difference", 0.0, MeasureFloatFiles},
  };
}

}  // namespace facet::stability

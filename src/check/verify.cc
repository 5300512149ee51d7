#include "facet/verify.h"

#include <algorithm>
#include <cstring>

#include "base/input_file.h"
#include "base/memory_budget.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "facet/compare.h"
#include "facet/error.h"
#include "facet/load.h"
#include "facet/render.h"
#include "image/codec.h"
#include "settings/provenance.h"
#include "settings/render_request.h"

namespace facet {
namespace {

// The settings that are stored in a picture file. Throws Error(InvalidInput).
RenderRequest ReadRequest(const Provenance& provenance, const std::string& picture) {
  RenderRequest request;
  for (const auto& [name, text] : provenance.settings) {
    try {
      SetOption(request, name, "facet:settings", text);
    } catch (const Error& error) {
      throw Error(ErrorCode::InvalidInput, std::string("facet:settings: ") + error.message(), picture,
                  "it was written by facet " + Printable(provenance.version) + ", or changed");
    }
  }
  return request;
}

// Finds the bounding rectangle of the differing pixels. Both images have the same size and format.
void FindRectangle(const Image& a, const Image& b, Verification& v) {
  const std::size_t pixel_bytes = std::size_t(a.channels) * SizeOf(a.type);
  v.left = a.width;
  v.top = a.height;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::size_t at = (std::size_t(y) * std::size_t(a.width) + std::size_t(x)) * pixel_bytes;
      if (std::memcmp(&a.bytes[at], &b.bytes[at], pixel_bytes) == 0) continue;
      v.left = std::min(v.left, x);
      v.top = std::min(v.top, y);
      v.right = std::max(v.right, x);
      v.bottom = y;
    }
  }
}

Verification Verify(const std::filesystem::path& picture, const std::filesystem::path& scene,
                    const VerifySettings& settings) {
  MemoryBudget budget(settings.load.memory_limit);
  const MemoryBudget::Scope scope(budget);
  const std::string name = Printable(picture.string());
  const Bytes file = ReadFile(picture);
  const Provenance provenance = ReadProvenance(file.Span(), name);
  RenderRequest request = ReadRequest(provenance, name);
  NamedBy named_by{scene, settings.load.root};
  if (settings.environment && !request.environment) {
    throw Error(ErrorCode::InvalidUsage, "no environment's picture lit it", name, "leave the environment out");
  }
  if (settings.materials && !request.materials) {
    throw Error(ErrorCode::InvalidUsage, "no material file changed it", name, "leave the material file out");
  }
  if (settings.environment || settings.materials) {
    // What the user does not name is still the picture's to name.
    const auto resolve = [&](const auto& given, std::optional<std::filesystem::path>& named) {
      if (named) named = given ? *given : DataPath(scene, *named, named_by.root);
    };
    resolve(settings.environment, request.environment);
    resolve(settings.materials, request.materials);
    named_by = {};
  }
  const Image before = DecodeStored(file.Span(), name);
  if (before.type == ChannelType::F32) request.type = ChannelType::F32;
  const RenderInputs inputs = LoadInputs(scene, request, settings.load, named_by);
  RenderStats stats;
  const Film film = Render(inputs.loaded.scene, inputs.settings, &stats);
  const bool is_exr = before.type == ChannelType::F32;
  const Image encoded = EncodeFilm(film, request.display, request.type);
  const Image now = is_exr ? StoredForm("picture.exr", encoded) : encoded;
  if (before.width != now.width || before.height != now.height || before.channels != now.channels ||
      before.type != now.type) {
    throw Error(ErrorCode::InvalidInput, "its pixels are not of the size and kind that its settings say", name,
                "the file was changed by another program");
  }

  Verification v;
  v.warnings = inputs.loaded.report.warnings;
  v.warnings.insert(v.warnings.end(), stats.warnings.begin(), stats.warnings.end());
  v.written_by = provenance.version;
  v.scene = provenance.scene;
  v.intact = HashImage(before) == provenance.pixels;
  v.film_before = provenance.film;
  v.film_now = HashFilm(film);
  v.film_equal = v.film_before == v.film_now;
  v.pixels = before.PixelCount();
  if (before.bytes == now.bytes) return v;
  const ImageDifference difference = CompareImages(before, now, {.memory_limit = settings.load.memory_limit});
  v.differing_pixels = difference.differing_pixels;
  v.max_difference = difference.max_difference;
  v.max_x = difference.max_x;
  v.max_y = difference.max_y;
  FindRectangle(before, now, v);
  return v;
}

}  // namespace

Verification VerifyPicture(const std::filesystem::path& picture, const std::filesystem::path& scene,
                           const VerifySettings& settings) {
  Verification verification;
  RunWithThreads(settings.threads, [&] { verification = Verify(picture, scene, settings); });
  return verification;
}

}  // namespace facet

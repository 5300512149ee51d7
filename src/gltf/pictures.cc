#include "gltf/pictures.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "gltf/extensions.h"
#include "gltf/uri.h"
#include "image/codec.h"
#include "image/probe.h"

namespace facet::gltf {
namespace {

// A picture in memory: a slice of the file, or of a data URI's bytes.
class EncodedImage final : public ImageSource {
 public:
  EncodedImage(Bytes bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {}
  Image Decode() const override { return DecodeImage(bytes_.Span(), name_); }
  void DecodeRows(const RowReceiver& receive) const override { DecodeImageRows(bytes_.Span(), name_, receive); }
  std::string Name() const override { return name_; }
  std::optional<ImageHeader> Header() const override { return ProbeImage(bytes_.Span()); }

 private:
  Bytes bytes_;
  std::string name_;
};

// A picture in a file of its own, read when it is decoded.
class ImageFile final : public ImageSource {
 public:
  explicit ImageFile(std::filesystem::path path) : path_(std::move(path)) {}
  Image Decode() const override { return DecodeImage(ReadWholeFile(path_).Span(), Name()); }
  void DecodeRows(const RowReceiver& receive) const override {
    DecodeImageRows(ReadWholeFile(path_).Span(), Name(), receive);
  }
  std::string Name() const override { return path_.string(); }
  std::optional<ImageHeader> Header() const override;

 private:
  std::filesystem::path path_;
};

std::optional<ImageHeader> ImageFile::Header() const {
  try {
    // The first piece is enough unless a JPEG's or PNG's colour profile or previews come before what is looked for.
    for (const std::size_t most : {std::size_t(1) << 16, std::numeric_limits<std::size_t>::max()}) {
      std::uintmax_t file_size = 0;
      const Bytes start = ReadFileStart(path_, most, &file_size);
      std::optional<ImageHeader> header = ProbeImage(start.Span());
      if (!header) return header;
      header->bytes = static_cast<std::size_t>(file_size);
      const bool known = header->width > 0 && header->height > 0 && header->channels > 0;
      if (known || start.size >= file_size || most > file_size) return header;
    }
  } catch (const Error&) {  // Decode() is the one to say so
  }
  return std::nullopt;
}

// A picture that is not there.
class MissingImage final : public ImageSource {
 public:
  MissingImage(std::string name, std::string reason) : name_(std::move(name)), reason_(std::move(reason)) {}
  Image Decode() const override { throw Error(ErrorCode::InvalidInput, reason_, name_); }
  std::string Name() const override { return name_; }

 private:
  std::string name_, reason_;
};

std::shared_ptr<const ImageSource> ReadSource(Context& context, BufferStore& buffers, const Json& object,
                                              std::size_t index, const Place& place) {
  const std::string name = "image " + std::to_string(index) + " of " + context.file_name;
  const auto missing = [&](const std::string& reason) {
    context.Warn(place, reason + "; what it should show stays white");
    return std::make_shared<MissingImage>(name, reason);
  };
  if (const Json* view = Find(object, "bufferView")) {
    if (!buffers.HasData(view->get<int>())) return missing("the image's buffer has no data");
    return std::make_shared<EncodedImage>(buffers.View(view->get<int>()), name);
  }
  const auto uri = StringAt(object, "uri", place);
  if (!uri) return missing("the image has neither a uri nor a bufferView");
  if (IsDataUri(*uri)) {
    auto bytes = DecodeDataUri(*uri);
    if (!bytes) return missing("the image's data URI is malformed");
    return std::make_shared<EncodedImage>(*std::move(bytes), name);
  }
  auto path = ResolveRelative(context.path.parent_path(), *uri);
  if (!path) return missing("the image's uri \"" + *uri + "\" is not a relative path");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(*path, ignored)) {
    return missing("the image file \"" + path->string() + "\" does not exist");
  }
  return std::make_shared<ImageFile>(*std::move(path));
}

Wrap WrapOf(int value) {
  switch (value) {
    case 33071: return Wrap::ClampToEdge;
    case 33648: return Wrap::MirroredRepeat;
    default: return Wrap::Repeat;
  }
}

Sampler ReadSampler(const tinygltf::Sampler& from) {
  Sampler sampler;
  sampler.wrap_u = WrapOf(from.wrapS);
  sampler.wrap_v = WrapOf(from.wrapT);
  if (from.magFilter == 9728) sampler.magnification = Filter::Nearest;
  switch (from.minFilter) {
    case 9728: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::None; break;
    case 9729: sampler.minification = Filter::Linear, sampler.mip = MipFilter::None; break;
    case 9984: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::Nearest; break;
    case 9985: sampler.minification = Filter::Linear, sampler.mip = MipFilter::Nearest; break;
    case 9986: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::Linear; break;
    default: break;
  }
  return sampler;
}

}  // namespace

void ReadImages(Context& context, BufferStore& buffers, Scene& scene) {
  const Json* list = Find(context.document.root, "images");
  const Place list_place(context.place, "images");
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const Json& object = (*list)[i];
    const Place place(list_place, i);
    scene.images.push_back({NameOf(object, place), ReadSource(context, buffers, object, i, place)});
  }
}

void ReadTextures(Context& context, Scene& scene) {
  const Place list_place(context.place, "textures");
  for (std::size_t i = 0; i < context.document.core.textures.size(); ++i) {
    const auto& from = context.document.core.textures[i];
    const Json& object = context.Object("textures", i);
    const Place place(list_place, i);
    Texture texture;
    texture.name = from.name;
    texture.image = from.source;
    if (from.sampler >= 0) {
      texture.sampler = ReadSampler(context.document.core.samplers[static_cast<std::size_t>(from.sampler)]);
    }
    const Place extensions_place(place, "extensions");
    if (const Json* webp = ExtensionOf(object, "EXT_texture_webp", place)) {
      const int source =
          IndexAt(*webp, "source", scene.images.size(), "images", Place(extensions_place, "EXT_texture_webp"));
      // Where the file offers both, the PNG or JPEG shows the same and needs no further module.
      if (texture.image < 0) texture.image = source;
    }
    if (texture.image < 0) {
      const Json* extensions = ObjectAt(object, "extensions", place);
      std::string names;
      if (extensions) {
        for (const auto& item : extensions->items()) {
          if (!IsSupported(item.key())) names += (names.empty() ? "" : ", ") + item.key();
        }
      }
      context.Warn(place, names.empty() ? "the texture has no image; it stays white"
                                        : "the texture's image needs " + names + "; it stays white");
    }
    scene.textures.push_back(std::move(texture));
  }
}

}  // namespace facet::gltf

#include "gltf/pictures.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "base/memory_budget.h"
#include "gltf/extensions.h"
#include "gltf/recognize.h"
#include "gltf/uri.h"
#include "image/codec.h"

namespace facet::gltf {
namespace {

// Throws Error(InvalidInput) for bytes that cannot be an image, such as the pointer files of Git LFS or a server's
// error page.
void RefuseForeign(std::span<const std::byte> bytes, const std::string& name) {
  const auto foreign = RecognizeForeign({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!foreign || foreign->is_picture) return;
  throw Error(ErrorCode::InvalidInput, "not a picture, but " + foreign->what, name, foreign->hint);
}

Image DecodeTexture(std::span<const std::byte> bytes, const std::string& name,
                    ImageFormats formats = ImageFormats::Gltf) {
  if (!ProbeImage(bytes)) RefuseForeign(bytes, name);
  return DecodeImage(bytes, name, formats);
}

void DecodeTextureRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive,
                       ImageFormats formats = ImageFormats::Gltf) {
  if (!ProbeImage(bytes)) RefuseForeign(bytes, name);
  DecodeImageRows(bytes, name, receive, formats);
}

// An encoded image in memory: a slice of the glTF file, or the bytes of a data URI.
class EncodedImage final : public ImageSource {
 public:
  EncodedImage(Bytes bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {}
  Image Decode() const override { return DecodeTexture(bytes_.Span(), name_); }
  void DecodeRows(const RowReceiver& receive) const override { DecodeTextureRows(bytes_.Span(), name_, receive); }
  std::string Name() const override { return name_; }
  std::optional<ImageHeader> Header() const override { return ProbeImage(bytes_.Span()); }
  std::size_t BytesHeld() const override { return bytes_.is_mapped ? 0 : bytes_.size; }

 private:
  Bytes bytes_;
  std::string name_;
};

// An image in a separate file, which is read when it is decoded.
class ImageFile final : public ImageSource {
 public:
  ImageFile(std::filesystem::path path, ImageFormats formats) : path_(std::move(path)), formats_(formats) {}
  Image Decode() const override {
    const Content content(path_);
    return DecodeTexture(content.bytes.Span(), Name(), formats_);
  }
  void DecodeRows(const RowReceiver& receive) const override {
    const Content content(path_);
    DecodeTextureRows(content.bytes.Span(), Name(), receive, formats_);
  }
  std::string Name() const override { return path_.string(); }
  std::optional<ImageHeader> Header() const override;
  bool MayChange() const override { return true; }

 private:
  // Charged while it is needed. Not mapped, because it is read only once, sequentially.
  struct Content {
    explicit Content(const std::filesystem::path& path, std::size_t most = std::numeric_limits<std::size_t>::max())
        : bytes(ReadFile(path, {.regular_only = true, .most = most}, &file_size)),
          lease(MemoryLease::Adopt(bytes.size, kFilesCharge)) {}
    std::uintmax_t file_size = 0;
    Bytes bytes;
    MemoryLease lease;
  };

  std::filesystem::path path_;
  ImageFormats formats_;
};

std::optional<ImageHeader> ImageFile::Header() const {
  try {
    // The first piece is enough unless colour profiles or previews in a JPEG or PNG precede the header.
    for (const std::size_t most : {std::size_t(1) << 16, std::numeric_limits<std::size_t>::max()}) {
      const Content start(path_, most);
      std::optional<ImageHeader> header = ProbeImage(start.bytes.Span());
      if (!header) return header;
      header->bytes = static_cast<std::size_t>(start.file_size);
      const bool known = header->width > 0 && header->height > 0 && header->channels > 0;
      if (known || start.bytes.size >= start.file_size) return header;
    }
  } catch (const Error&) {  // Decode() will report it
  }
  return std::nullopt;
}

// An image that does not exist.
class MissingImage final : public ImageSource {
 public:
  MissingImage(std::string name, std::string reason) : name_(std::move(name)), reason_(std::move(reason)) {}
  Image Decode() const override { throw Error(ErrorCode::InvalidInput, reason_, name_); }
  std::string Name() const override { return name_; }

 private:
  std::string name_, reason_;
};

// Throws Error if there is no image.
std::shared_ptr<const ImageSource> OpenSource(Context& context, BufferStore& buffers, const Json& object,
                                              const std::string& name, const Place& place) {
  const int view = IndexAt(object, "bufferView", context.document.Count("bufferViews"), "bufferViews", place);
  if (view >= 0) {
    if (!buffers.HasData(view)) Fail(place, "the image's buffer has no data");
    return std::make_shared<EncodedImage>(buffers.Read(view), name);
  }
  const auto uri = StringAt(object, "uri", place);
  if (!uri) Fail(place, "the image has neither a uri nor a bufferView");
  if (IsDataUri(*uri)) {
    auto bytes = DecodeDataUri(*uri);
    if (!bytes) Fail(place, "the image's data URI is malformed");
    return std::make_shared<EncodedImage>(*std::move(bytes), name);
  }
  std::filesystem::path path = context.files.Find(*uri, Place(place, "uri"));
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    const bool is_there = std::filesystem::exists(path, ignored);
    Fail(place, "the image file \"" + path.string() + (is_there ? "\" is not a regular file" : "\" does not exist"));
  }
  return std::make_shared<ImageFile>(std::move(path), ImageFormats::Gltf);
}

Wrap WrapOf(int value) {
  switch (value) {
    case 33071: return Wrap::ClampToEdge;
    case 33648: return Wrap::MirroredRepeat;
    default: return Wrap::Repeat;
  }
}

Sampler ReadSampler(const Json& object, const Place& place) {
  const auto wrap = [&](const char* key) {
    return WrapOf(LenientOneOf(object, key, {33071, 33648, 10497}, place).value_or(10497));
  };
  Sampler sampler;
  sampler.wrap_u = wrap("wrapS");
  sampler.wrap_v = wrap("wrapT");
  if (LenientOneOf(object, "magFilter", {9728, 9729}, place) == 9728) sampler.magnification = Filter::Nearest;
  switch (LenientOneOf(object, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987}, place).value_or(9987)) {
    case 9728: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::None; break;
    case 9729: sampler.minification = Filter::Linear, sampler.mip = MipFilter::None; break;
    case 9984: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::Nearest; break;
    case 9985: sampler.minification = Filter::Linear, sampler.mip = MipFilter::Nearest; break;
    case 9986: sampler.minification = Filter::Nearest, sampler.mip = MipFilter::Linear; break;
    default: break;
  }
  return sampler;
}

// Warns that a texture has no image, and says why.
void WarnOfNoImage(const Json& object, const Place& place) {
  std::string names;
  if (const Json* extensions = LenientObject(object, "extensions", place)) {
    for (const auto& item : extensions->items()) {
      if (!IsSupported(item.key())) names += (names.empty() ? "" : ", ") + item.key();
    }
  }
  place.Warn(names.empty() ? "the texture has no image; it stays white"
                           : "the texture's image needs " + names + "; it stays white");
}

}  // namespace

std::shared_ptr<const ImageSource> OpenPicture(const std::filesystem::path& path) {
  return std::make_shared<ImageFile>(path, ImageFormats::Any);
}

std::vector<bool> ReadImages(Context& context, BufferStore& buffers, Scene& scene) {
  const Place list_place(context.place, "images");
  constexpr std::size_t kSource = 256;  // an ImageSource with its name
  context.Charge(context.document.Count("images"), sizeof(SceneImage) + kSource, list_place);
  scene.images.reserve(context.document.Count("images"));
  std::vector<bool> there;
  for (std::size_t i = 0; i < context.document.Count("images"); ++i) {
    const Json& object = context.Object("images", i);
    const Place place(list_place, i);
    const std::string name = "image " + std::to_string(i) + " of " + context.file_name;
    std::shared_ptr<const ImageSource> source;
    there.push_back(true);
    try {
      source = OpenSource(context, buffers, object, name, place);
    } catch (const Error& error) {
      if (IsFatal(error)) throw;
      place.Warn("what it should show stays white", error);
      source = std::make_shared<MissingImage>(name, error.message());
      there.back() = false;
    }
    scene.images.push_back({NameOf(object, place), std::move(source)});
  }
  return there;
}

void ReadTextures(Context& context, const std::vector<bool>& images, Scene& scene) {
  const Place samplers_place(context.place, "samplers"), textures_place(context.place, "textures");
  context.Charge(context.document.Count("samplers"), sizeof(Sampler), samplers_place);
  context.Charge(context.document.Count("textures"), sizeof(Texture), textures_place);
  scene.textures.reserve(context.document.Count("textures"));
  std::vector<Sampler> samplers;
  for (std::size_t i = 0; i < context.document.Count("samplers"); ++i) {
    samplers.push_back(ReadSampler(context.Object("samplers", i), Place(samplers_place, i)));
  }
  for (std::size_t i = 0; i < context.document.Count("textures"); ++i) {
    const Json& object = context.Object("textures", i);
    const Place place(textures_place, i);
    Texture texture;
    texture.name = NameOf(object, place);
    texture.image = LenientIndex(object, "source", images.size(), "images", place);
    const int sampler = LenientIndex(object, "sampler", samplers.size(), "samplers", place);
    if (sampler >= 0) texture.sampler = samplers[static_cast<std::size_t>(sampler)];
    const Place extensions_place(place, "extensions");
    if (const Json* webp = ExtensionOf(object, "EXT_texture_webp", place)) {
      const int source =
          LenientIndex(*webp, "source", images.size(), "images", Place(extensions_place, "EXT_texture_webp"));
      // Where the file offers both, the PNG or JPEG shows the same and needs no further module.
      const bool has_image = texture.image >= 0 && images[static_cast<std::size_t>(texture.image)];
      if (!has_image && source >= 0) texture.image = source;
    }
    if (texture.image < 0) WarnOfNoImage(object, place);
    // A missing image has been reported already.
    if (texture.image >= 0 && !images[static_cast<std::size_t>(texture.image)]) texture.image = -1;
    scene.textures.push_back(std::move(texture));
  }
}

}  // namespace facet::gltf

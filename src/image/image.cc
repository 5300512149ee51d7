#include "facet/image.h"

#include <span>
#include <string>
#include <utility>

#include "image/hash_image.h"

namespace facet {
namespace {

class MemoryImage final : public ImageSource {
 public:
  MemoryImage(Image image, std::string name) : image_(std::move(image)), name_(std::move(name)) {}
  Image Decode() const override { return image_; }
  void DecodeRows(const RowReceiver& receive) const override { receive(image_, image_.height); }
  std::string Name() const override { return name_; }
  std::optional<ImageHeader> Header() const override {
    const int bits = 8 * static_cast<int>(SizeOf(image_.type));
    return ImageHeader{{}, image_.width, image_.height, image_.channels, bits, image_.bytes.size()};
  }
  std::size_t BytesHeld() const override { return image_.bytes.size(); }

 private:
  Image image_;
  std::string name_;
};

}  // namespace

void ImageSource::DecodeRows(const RowReceiver& receive) const {
  const Image whole = Decode();
  receive(whole, whole.height);
}

std::shared_ptr<const ImageSource> MakeImageSource(Image image, std::string name) {
  return std::make_shared<MemoryImage>(std::move(image), std::move(name));
}

Sha256 BeginImageHash(const Image& form) {
  Sha256 hash;
  hash.Add("facet image " + std::to_string(form.width) + " " + std::to_string(form.height) + " " +
           std::to_string(form.channels) + " " + std::to_string(8 * SizeOf(form.type)) +
           (form.encoding == Encoding::Srgb ? " srgb\n" : " linear\n"));
  return hash;
}

Digest HashImage(const Image& image) {
  Sha256 hash = BeginImageHash(image);
  hash.Add(std::span(image.bytes));
  return hash.Finish();
}

}  // namespace facet

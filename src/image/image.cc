#include "facet/image.h"

#include <utility>

namespace facet {
namespace {

class MemoryImage final : public ImageSource {
 public:
  MemoryImage(Image image, std::string name) : image_(std::move(image)), name_(std::move(name)) {}
  Image Decode() const override { return image_; }
  std::string Name() const override { return name_; }

 private:
  Image image_;
  std::string name_;
};

}  // namespace

std::shared_ptr<const ImageSource> MakeImageSource(Image image, std::string name) {
  return std::make_shared<MemoryImage>(std::move(image), std::move(name));
}

}  // namespace facet

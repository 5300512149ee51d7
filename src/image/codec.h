// Images as files: decoding from memory, encoding to memory. What formats there are stands in formats.cc; those without
// a codec of facet's own go through the OpenImageIO module (see oiio_loader.h), which is opened when the first such
// file comes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"
#include "facet/image.h"

namespace facet {

// The largest picture that is decoded: pixels along a side, and pixels in all.
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::size_t kMaxImagePixels = std::size_t(1) << 28;

// What may be decoded. Gltf: what glTF 2.0 and its extensions allow, PNG, JPEG and WebP; nothing else reaches
// OpenImageIO from a file that anybody may have made.
enum class ImageFormats : std::uint8_t { Any, Gltf };

// The header of a file of which `bytes` are all, or the start: what is not among them is 0, and `ImageHeader::bytes` is
// the size of `bytes`. Nothing is decoded and no checksum is verified; sizes beyond int are 0. nullopt: a format whose
// header facet does not read, or none. Takes time linear in the size of `bytes`, and throws nothing.
std::optional<ImageHeader> ProbeImage(std::span<const std::byte> bytes);

// Decodes a whole file of any format that facet or OpenImageIO reads; the format is told by content, never by name.
// Channels and depth are the file's (a palette becomes RGB or RGBA, grey of 1, 2 and 4 bits becomes 8, PNG of 16 bits
// stays U16, CMYK becomes RGB); alpha is straight. PNG, JPEG and WebP are Encoding::Srgb and HDR is Encoding::Linear:
// as glTF 2.0 demands, gamma chunks, colour profiles and orientation tags are ignored. `name` is what messages call the
// image. What is needed while decoding is charged to the current memory budget. Thread-safe. Throws Error: InvalidInput
// (broken, cut off, or of no format that is allowed), OutOfMemory (larger than the limits above or the budget),
// MissingModule (the format needs OpenImageIO and its module is not there).
Image DecodeImage(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats = ImageFormats::Any);

// The same in pieces of some rows. PNG (unless it is interlaced) and JPEG never have more than one of them in memory.
void DecodeImageRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive,
                     ImageFormats formats = ImageFormats::Any);

// A PNG file of an image of type U8 or U16 (Encoding::Srgb adds the sRGB chunk; Linear adds gAMA 1.0). `text` are
// keyword and value pairs in UTF-8: tEXt where ASCII suffices, iTXt otherwise. The bytes are a function of the
// arguments (and of the version of libdeflate). Throws Error: InvalidUsage (F32, a wrong byte count, or a bad keyword).
using ImageText = std::vector<std::array<std::string, 2>>;
std::vector<std::byte> EncodePng(const Image& image, const ImageText& text = {});

// The same with a text that takes time to make: it is made while another thread compresses the pixels.
std::vector<std::byte> EncodePng(const Image& image, const std::function<ImageText()>& make_text);

// A PNG file whose rows come a band after the other and are not kept; compressed by zlib, on all threads. It appears
// when it is finished; see base/output_file.h.
class PngStream {
 public:
  // `form`: the whole picture's size and kind, as EncodePng takes them; its bytes are not looked at. `path`: a plain
  // file. Throws Error: InvalidUsage as EncodePng, OutputFailed.
  PngStream(const std::filesystem::path& path, const Image& form, const ImageText& text);

  // The next rows, while another thread does what `meanwhile` says. Throws Error: OutputFailed; InvalidUsage for rows
  // of another form, or too many.
  void Add(const Image& rows, const std::function<void()>& meanwhile);

  // Ends the file when all rows are there; `text`, as long as the first one in each part, takes its place.
  // Throws Error: OutputFailed; InvalidUsage where rows are missing or the text is longer or shorter.
  void Finish(const ImageText& text);

 private:
  std::string name_;
  Image form_;
  std::vector<unsigned char> above_;  // the last row
  OutputFile file_;
  int next_row_ = 0;
  std::size_t head_size_ = 0;   // bytes before the pixels
  std::uint32_t checksum_ = 1;  // Adler-32 of the rows so far
};

// WriteImage of facet/image.h with a text that is made of the image as it stands in the file (see StoredForm). PNG and
// EXR hold it; other formats have no use for it and do not make it.
using TextMaker = std::function<ImageText(const Image& stored)>;
void WriteImageWithText(const std::filesystem::path& path, const Image& image, const TextMaker& make_text);

// What the format that `path` names holds of an image: of .exr linear light, multiplied by alpha. Throws
// Error(InvalidUsage) as WriteImage.
Image StoredForm(const std::filesystem::path& path, const Image& image);

// An image file as it stands there: DecodeImage(), but that EXR stays multiplied by alpha. Throws as DecodeImage.
Image DecodeStored(std::span<const std::byte> bytes, const std::string& name);

// The texts before the pixels of a PNG or OpenEXR file, keyword to value in UTF-8; of equal keywords the first counts.
// `name` is what messages call the picture. Throws Error(InvalidInput).
std::map<std::string, std::string> ReadImageText(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet

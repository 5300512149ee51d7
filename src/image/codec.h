// Image codecs: decoding of files in memory, encoding to memory. formats.cc has the table of formats. Formats for which
// facet has no codec are handled by the OpenImageIO module (see oiio_loader.h), which is loaded when it is first
// needed.
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

// The largest image that is decoded: pixels along a side, and in all.
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::size_t kMaxImagePixels = std::size_t(1) << 28;

// The formats that may be decoded. Gltf: those that glTF 2.0 and its extensions allow (PNG, JPEG, WebP), so that files
// from unknown sources do not reach the many decoders of OpenImageIO.
enum class ImageFormats : std::uint8_t { Any, Gltf };

// Reads the header of an image file from `bytes`, which may be only the start of the file: fields that lie beyond are
// 0, and `ImageHeader::bytes` is the size of `bytes`. Does not decode anything or verify checksums; sizes that do not
// fit an int are 0. nullopt: an unknown format, or one whose header facet does not read. Takes time linear in the size
// of `bytes`. Does not throw.
std::optional<ImageHeader> ProbeImage(std::span<const std::byte> bytes);

// Decodes a file of any format that facet or OpenImageIO reads. The format is recognised by the content, not by the
// name. Channels and depth are those of the file (palettes become RGB or RGBA, grey of 1, 2 and 4 bits becomes 8 bits,
// PNG of 16 bits stays U16, CMYK becomes RGB); alpha is straight. PNG, JPEG and WebP are Encoding::Srgb, HDR is
// Encoding::Linear: as glTF 2.0 demands, gamma chunks, colour profiles and orientation tags are ignored. `name`: of the
// image, for messages. Memory for decoding is charged to the current memory budget. Thread-safe. Throws Error:
// InvalidInput (broken, truncated, or of a format that is not allowed), OutOfMemory (beyond the limits above or the
// budget), MissingModule (OpenImageIO is needed and its module is not installed).
Image DecodeImage(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats = ImageFormats::Any);

// Decodes in pieces of some rows. For PNG (unless interlaced) and JPEG, only one piece is in memory at a time.
void DecodeImageRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive,
                     ImageFormats formats = ImageFormats::Any);

// Encodes an image of type U8 or U16 as PNG (Encoding::Srgb adds the sRGB chunk, Linear adds gAMA 1.0). `text`: pairs
// of keyword and value in UTF-8, stored as tEXt if they are ASCII, otherwise as iTXt. The bytes depend on the arguments
// (and the version of libdeflate) only. Throws Error: InvalidUsage (F32, a wrong number of bytes, or a bad keyword).
using ImageText = std::vector<std::array<std::string, 2>>;
std::vector<std::byte> EncodePng(const Image& image, const ImageText& text = {});

// The same with a text that takes time to compute: it is computed while other threads compress the pixels.
std::vector<std::byte> EncodePng(const Image& image, const std::function<ImageText()>& make_text);

// Writes a PNG file from bands of rows, which are not kept in memory; zlib compresses them on all threads. The file
// appears when it is finished; see base/output_file.h.
class PngStream {
 public:
  // `form`: the size and format of the whole image, as for EncodePng(); its bytes are not read. `path`: a regular file.
  // Throws Error: InvalidUsage as EncodePng(), OutputFailed.
  PngStream(const std::filesystem::path& path, const Image& form, const ImageText& text);

  // Writes the next rows while another thread runs `meanwhile`. Throws Error: OutputFailed; InvalidUsage for rows of
  // another format or for too many rows.
  void Add(const Image& rows, const std::function<void()>& meanwhile);

  // Finishes the file after all rows. `text` replaces the text given first, and each part must be as long as before.
  // Throws Error: OutputFailed; InvalidUsage if rows are missing or the text has another length.
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

// WriteImage() of facet/image.h with a text that is computed from the image as it is stored (see StoredForm). Only PNG
// and EXR store texts; for other formats it is not computed.
using TextMaker = std::function<ImageText(const Image& stored)>;
void WriteImageWithText(const std::filesystem::path& path, const Image& image, const TextMaker& make_text);

// The image as the format of `path` stores it: for .exr, linear light premultiplied by alpha. Throws
// Error(InvalidUsage) as WriteImage().
Image StoredForm(const std::filesystem::path& path, const Image& image);

// Decodes an image as it is stored: as DecodeImage(), except that EXR stays premultiplied by alpha. Throws the same.
Image DecodeStored(std::span<const std::byte> bytes, const std::string& name);

// Reads the texts that precede the pixels of a PNG or OpenEXR file: keyword to value, in UTF-8. The first of equal
// keywords counts. `name`: of the file, for messages. Throws Error(InvalidInput).
std::map<std::string, std::string> ReadImageText(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet

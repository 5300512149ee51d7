// Pictures as files: decoding from memory, encoding to memory. PNG, JPEG and Radiance HDR are read here; every other
// format goes through the OpenImageIO module (see oiio_loader.h), which is opened when the first such file comes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "facet/image.h"

namespace facet {

// The largest picture that is decoded: pixels along a side, and pixels in all.
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::size_t kMaxImagePixels = std::size_t(1) << 28;

// Decodes a whole file of any format that facet or OpenImageIO reads; the format is told by content, never by name.
// Channels and depth are the file's (a palette becomes RGB or RGBA, grey of 1, 2 and 4 bits becomes 8, PNG of 16 bits
// stays U16, CMYK becomes RGB); alpha is straight. PNG and JPEG are Encoding::Srgb and HDR is Encoding::Linear: as
// glTF 2.0 demands, gamma chunks, colour profiles and orientation tags are ignored.
// `name` is what messages call the picture. Thread-safe.
// Throws Error: InvalidInput (broken, cut off, or of no known format), OutOfMemory (larger than the limits above),
// MissingModule (the format needs OpenImageIO and its module is not there).
Image DecodeImage(std::span<const std::byte> bytes, const std::string& name);

// The same in pieces of some rows. PNG (unless it is interlaced) and JPEG never have more than one of them in memory.
void DecodeImageRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive);

// A PNG file of an image of type U8 or U16 (Encoding::Srgb adds the sRGB chunk; Linear adds gAMA 1.0). `text` are
// keyword and value pairs in UTF-8: tEXt where ASCII suffices, iTXt otherwise. The bytes are a function of the
// arguments (and of the version of libdeflate). Throws Error: InvalidUsage (F32, a wrong byte count, or a bad keyword).
using PngText = std::vector<std::array<std::string, 2>>;
std::vector<std::byte> EncodePng(const Image& image, const PngText& text = {});

// The same with a text that takes time to make: it is made while another thread compresses the pixels.
std::vector<std::byte> EncodePng(const Image& image, const std::function<PngText()>& make_text);

// A PNG file whose rows come a band after the other and are not kept; compressed by zlib, on all threads.
class PngStream {
 public:
  // `form`: the whole picture's size and kind, as EncodePng takes them; its bytes are not looked at. `name`: what
  // messages call the file. Throws Error: InvalidUsage as EncodePng, OutputFailed.
  PngStream(const std::filesystem::path& path, const std::string& name, const Image& form, const PngText& text);

  // The next rows, while another thread does what `meanwhile` says. Throws Error: OutputFailed; InvalidUsage for rows
  // of another form, or too many.
  void Add(const Image& rows, const std::function<void()>& meanwhile);

  // Ends the file when all rows are there; `text`, as long as the first one in each part, takes its place.
  // Throws Error: OutputFailed; InvalidUsage where rows are missing or the text is longer or shorter.
  void Finish(const PngText& text);

 private:
  void Write(std::span<const std::byte> bytes);
  [[noreturn]] void Fail() const;

  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  Image form_;
  std::vector<unsigned char> above_;  // the last row
  int next_row_ = 0;
  std::size_t head_size_ = 0;   // bytes before the pixels
  std::uint32_t checksum_ = 1;  // Adler-32 of the rows so far
};

// WriteImage of facet/film.h with such a text. Formats other than PNG have no use for it and do not make it.
void WriteImageWithText(const std::filesystem::path& path, const Image& image,
                        const std::function<PngText()>& make_text);

// The text chunks before the pixels of a PNG file, keyword to value in UTF-8; of equal keywords the first counts.
// `name` is what messages call the picture. Throws Error(InvalidInput).
std::map<std::string, std::string> ReadPngText(std::span<const std::byte> bytes, const std::string& name);

// Calls write(temporary path in the same folder), then gives that file the name `path`: it appears whole or not at
// all, and an existing file stays as it was when anything fails. Throws what `write` throws, or Error(OutputFailed).
void WriteFileWhole(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

// The same for bytes in memory, and for such that follow one another in the file.
void WriteFileWhole(const std::filesystem::path& path, std::span<const std::byte> bytes);
void WriteFileWhole(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts);

// The bytes of a file. Throws Error: NotFound (no such file, a folder, or no permission), OutOfMemory.
std::vector<std::byte> ReadFileWhole(const std::filesystem::path& path);

}  // namespace facet

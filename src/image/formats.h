// The formats that picture files have: one table, in formats.cc, by which all goes that reads and writes pictures. To
// add a codec: a file of the functions that its row names, the row, and the file's name in CMakeLists.txt. (Messages
// list formats in words: two in oiio_loader.cc facet's own codecs, one in codec.cc those that hold text.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "facet/image.h"
#include "image/codec.h"
#include "image/file_start.h"
#include "image/limits.h"

namespace facet {

// How a file that facet writes holds alpha. None: only opaque pictures are written.
enum class FileAlpha : std::uint8_t { None, Straight, Associated };

using MakeText = std::function<ImageText()>;

struct ImageFormat {
  std::string_view name;                // for messages
  std::string_view extensions[2] = {};  // lower case, with its dot; OpenImageIO knows the format by the first
  // What files begin with: one of these, in which a dot is any byte. None: they are told by their name's extension.
  std::string_view signatures[4] = {};
  bool in_gltf = false;  // glTF 2.0 or an extension that facet supports allows it

  // See ProbeImage; `format` and `bytes` are filled in already. May be null.
  void (*probe)(const FileStart& file, ImageHeader& header) = nullptr;
  // See DecodeImage. By pieces of `piece_rows` rows, or whole; both null: the OpenImageIO module does it.
  void (*decode_rows)(std::span<const std::byte> bytes, const std::string& name, int piece_rows,
                      const PieceReceiver& receive) = nullptr;
  Image (*decode)(std::span<const std::byte> bytes, const std::string& name) = nullptr;
  // Throws where the module must not see the file. May be null.
  void (*check)(std::span<const std::byte> bytes, const std::string& name) = nullptr;
  // See ReadImageText. Null: files of this format hold no text, and none is written to them.
  std::map<std::string, std::string> (*read_text)(std::span<const std::byte> bytes, const std::string& name) = nullptr;

  // Writing. The kinds of numbers that a file holds, bits of 1 << ChannelType; none: facet does not write the format.
  unsigned types = 0;
  FileAlpha alpha = FileAlpha::None;
  bool has_grey = true;  // 1 and 2 channels; else grey is repeated into RGB
  // A whole file of a picture in the form that the above says. Null: the OpenImageIO module does it.
  std::vector<std::byte> (*encode)(const Image& form, const MakeText& make_text) = nullptr;

  bool Holds(ChannelType type) const { return (types >> static_cast<unsigned>(type) & 1) != 0; }
  // Its files hold linear light, as floats, and nothing else.
  bool IsLinear() const { return Holds(ChannelType::F32) && !Holds(ChannelType::U8); }
};

// Told by the first bytes, or by `name`, the file's. Null for what is not known.
const ImageFormat* FormatOf(std::span<const std::byte> bytes, std::string_view name = {});

// The extension of a file's name in lower case, with its dot; empty where there is none.
std::string ExtensionOf(const std::filesystem::path& path);

// The format that the extension of `path` names, one that is written. Throws Error(InvalidUsage).
const ImageFormat& FormatToWrite(const std::filesystem::path& path);

}  // namespace facet

// The table of image file formats, in formats.cc, which all reading and writing of images goes by. A new codec takes a
// file with the functions that its row names, the row itself, and an entry in CMakeLists.txt. (One message, in
// codec.cc, lists in words those that store text.)
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

// How the files that facet writes store alpha. None: only opaque images can be written.
enum class FileAlpha : std::uint8_t { None, Straight, Associated };

using MakeText = std::function<ImageText()>;

struct ImageFormat {
  std::string_view name;                // for messages
  std::string_view extensions[2] = {};  // lower case, with its dot; OpenImageIO knows the format by the first
  // The bytes that files begin with: one of these, in which a dot stands for any byte. None: files are recognised by
  // their extension.
  std::string_view signatures[4] = {};
  bool in_gltf = false;  // glTF 2.0 or an extension that facet supports allows it

  // See ProbeImage(); `format` and `bytes` have been set already. May be null.
  void (*probe)(const FileStart& file, ImageHeader& header) = nullptr;
  // See DecodeImage(). One decodes in pieces of `piece_rows` rows, the other whole images; if both are null, the
  // OpenImageIO module decodes.
  void (*decode_rows)(std::span<const std::byte> bytes, const std::string& name, int piece_rows,
                      const PieceReceiver& receive) = nullptr;
  Image (*decode)(std::span<const std::byte> bytes, const std::string& name) = nullptr;
  // Throws if the file must not be passed to the OpenImageIO module. May be null.
  void (*check)(std::span<const std::byte> bytes, const std::string& name) = nullptr;
  // See ReadImageText(). Null: no text is read from or written to files of this format.
  std::map<std::string, std::string> (*read_text)(std::span<const std::byte> bytes, const std::string& name) = nullptr;

  // Writing. The component types that files may have, as bits 1 << ChannelType; none: facet does not write the format.
  unsigned types = 0;
  FileAlpha alpha = FileAlpha::None;
  bool has_grey = true;  // files may have 1 or 2 channels; false: grey is repeated into RGB
  // Encodes an image that has been converted as the fields above say. Null: the OpenImageIO module does it.
  std::vector<std::byte> (*encode)(const Image& form, const MakeText& make_text) = nullptr;

  bool Holds(ChannelType type) const { return (types >> static_cast<unsigned>(type) & 1) != 0; }
  // Whether files can store linear light, as floats, only.
  bool IsLinear() const { return Holds(ChannelType::F32) && !Holds(ChannelType::U8); }
};

// The names of the formats that facet reads (or writes) without OpenImageIO, with commas between them.
std::string FormatsOfFacet(bool writing);

// Recognises a format by the first bytes alone, at least `fewest` of them. Null: not known.
const ImageFormat* FormatBySignature(std::string_view file, std::size_t fewest = 1);

// Recognises a format by the first bytes, or by `name`, the file's name. Null: not known.
const ImageFormat* FormatOf(std::span<const std::byte> bytes, std::string_view name = {});

// The extension of a file name in lower case, with its dot; empty if there is none.
std::string ExtensionOf(const std::filesystem::path& path);

// The format that the extension of `path` stands for, which must be one that can be written. Throws
// Error(InvalidUsage).
const ImageFormat& FormatToWrite(const std::filesystem::path& path);

}  // namespace facet

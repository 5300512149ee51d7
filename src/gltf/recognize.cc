#include "gltf/recognize.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>

#include "facet/error.h"
#include "image/formats.h"

namespace facet::gltf {
namespace {

using namespace std::string_view_literals;

constexpr const char* kConvert = "convert it to glTF 2.0, with Blender for example";
constexpr const char* kPicture = "name the glTF file that uses it";
constexpr const char* kUnpack = "unpack it, and name the .gltf or .glb file in it";
constexpr const char* kDownload = "fetch the file itself; what was fetched is the page around it, or a server's answer";

struct Signature {
  std::size_t at;
  std::string_view bytes;
  const char* what;
  const char* hint;
};

// The first match counts. (Pictures of known formats: see RecognizeForeign().)
constexpr Signature kSignatures[] = {
    {0, "version https://git-lfs.github.com/spec/"sv, "a Git LFS pointer in place of the file", "run \"git lfs pull\""},
    {0, "\x1F\x8B"sv, "compressed by gzip", "unpack it first: gunzip"},
    {0, "BZh"sv, "compressed by bzip2", "unpack it first: bunzip2"},
    {0,
     "\xFD"
     "7zXZ\0"sv,
     "compressed by xz", "unpack it first: unxz"},
    {0, "\x28\xB5\x2F\xFD"sv, "compressed by Zstandard", "unpack it first: unzstd"},
    {0, "\x04\x22\x4D\x18"sv, "compressed by LZ4", "unpack it first: unlz4"},
    {0, "7z\xBC\xAF\x27\x1C"sv, "a 7z archive", kUnpack},
    {0, "Rar!\x1A\x07"sv, "a RAR archive", kUnpack},
    {257, "ustar"sv, "a tar archive", kUnpack},
    {0, "sB"sv, "a Basis Universal texture", kPicture},
    {0, "\0\0\0\x0CJXL "sv, "a JPEG XL picture", kPicture},
    {4, "ftyp"sv, "a video", nullptr},
    {0, "%PDF-"sv, "a PDF document", nullptr},
    {0, "Kaydara FBX Binary"sv, "an FBX file", kConvert},
    {0, "; FBX"sv, "an FBX file", kConvert},
    {0, "BLENDER"sv, "a Blender file", "export it from Blender as glTF 2.0"},
    {0, "PXR-USDC"sv, "a USD file", kConvert},
    {0, "#usda"sv, "a USD file", kConvert},
    {0, "ply\n"sv, "a PLY file", kConvert},
    {0, "ply\r"sv, "a PLY file", kConvert},
    {0, "Ogawa"sv, "an Alembic file", kConvert},
    {0, "\x89HDF"sv, "an HDF5 file", kConvert},
    {0, "//Maya ASCII"sv, "a Maya file", kConvert},
    {0, "FOR4"sv, "a Maya file", kConvert},
    {0, "#VRML"sv, "a VRML file", kConvert},
    {0, "#X3D"sv, "an X3D file", kConvert},
    {0, "ISO-10303-21"sv, "a STEP or IFC file", kConvert},
    {0, "AC10"sv, "a DWG drawing", kConvert},
    {0, "3D Geometry File Format"sv, "a Rhino file", kConvert},
    {0, "xof 0"sv, "a DirectX .x file", kConvert},
    {0, "[gd_scene"sv, "a Godot scene", kConvert},
    {0, "DRACO"sv, "Draco's bare data", kConvert},
    {0, "b3dm"sv, "a 3D tile", "extract the glTF file that it holds"},
    {0, "i3dm"sv, "a 3D tile", "extract the glTF file that it holds"},
    {0, "cmpt"sv, "a 3D tile", "extract the glTF file that it holds"},
    {0, "pnts"sv, "a 3D tile of points", kConvert},
    {0, "[InternetShortcut]"sv, "a shortcut to an address", "open it in a browser and fetch the file"},
    {0, "[Desktop Entry]"sv, "a shortcut", "name the file that it leads to"},
    {0, "L\0\0\0\x01\x14\x02\0"sv, "a Windows shortcut", "name the file that it leads to"},
    {0, "book\0\0\0\0"sv, "a macOS alias", "name the file that it leads to"},
    {0, "\0\x05\x16\x07"sv, "what macOS keeps beside a file", "name the file without the leading \"._\""},
    {0, "\xFF\xFE"sv, "text in UTF-16", "save it as UTF-8"},
    {0, "\xFE\xFF"sv, "text in UTF-16", "save it as UTF-8"},
    {0, "{\0"sv, "text in UTF-16", "save it as UTF-8"},
    {0, "\0{"sv, "text in UTF-16", "save it as UTF-8"},
    {0,
     "\x7F"
     "ELF"sv,
     "a program", nullptr},
    {0, "MZ"sv, "a program", nullptr},
};

bool Holds(std::string_view file, std::size_t at, std::string_view bytes) {
  return file.size() >= at + bytes.size() && file.substr(at, bytes.size()) == bytes;
}

bool Contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::uint32_t Little(std::string_view file, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(file[at + i]);
  return value;
}

// Recognises an archive by the names of the files in it, which are at its start and at its end.
ForeignFile RecognizeZip(std::string_view file) {
  constexpr std::size_t kFew = 64 << 10;
  const std::string_view first = file.substr(0, kFew), last = file.substr(file.size() - std::min(kFew, file.size()));
  const auto names = [&](std::string_view name) { return Contains(first, name) || Contains(last, name); };
  if (names(".usdc") || names(".usda") || names(".usd")) return {"a USDZ file", kConvert};
  if (names("3D/3dmodel.model")) return {"a 3MF file", kConvert};
  return {"a zip archive", kUnpack};
}

// Recognises markup by its first elements. `start` is in lower case.
ForeignFile RecognizeMarkup(std::string_view start) {
  if (Contains(start, "<html") || Contains(start, "<!doctype html") || Contains(start, "<head")) {
    return {"an HTML page", kDownload};
  }
  if (Contains(start, "<collada")) return {"a COLLADA file", kConvert};
  if (Contains(start, "<x3d")) return {"an X3D file", kConvert};
  if (Contains(start, "<svg")) return {"an SVG picture", kPicture, true};
  if (Contains(start, "<plist")) return {"a shortcut", "name the file that it leads to"};
  return {"an XML document", kDownload};
}

// Recognises text formats by the first line that is not a comment.
std::optional<ForeignFile> RecognizeText(std::string_view start) {
  while (!start.empty()) {
    const std::size_t end = std::min(start.find('\n'), start.size() - 1);
    std::string_view line = start.substr(0, end + 1);
    start.remove_prefix(end + 1);
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front()))) line.remove_prefix(1);
    if (line.empty() || line.front() == '#') continue;
    for (const std::string_view word : {"v "sv, "vn "sv, "vt "sv, "o "sv, "g "sv, "s "sv, "mtllib "sv, "usemtl "sv}) {
      if (line.starts_with(word)) return ForeignFile{"an OBJ file", kConvert};
    }
    if (line.starts_with("newmtl ")) return ForeignFile{"the materials of an OBJ file", kConvert};
    if (line.starts_with("solid")) return ForeignFile{"an STL file", kConvert};
    if (line.starts_with("OFF") || line.starts_with("COFF")) return ForeignFile{"an OFF file", kConvert};
    return std::nullopt;
  }
  return std::nullopt;
}

bool IsBinaryStl(std::string_view file) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  return file.size() > kHeader && file.size() - kHeader == std::uint64_t(Little(file, 80, 4)) * kTriangle;
}

bool IsText(std::string_view start) {
  return std::all_of(start.begin(), start.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || std::isspace(static_cast<unsigned char>(c));
  });
}

}  // namespace

std::optional<ForeignFile> RecognizeForeign(std::string_view file) {
  constexpr std::size_t kStart = 4096;
  const bool is_text = IsText(file.substr(0, kStart));
  const std::size_t fewest = is_text ? 3 : 1;  // two letters may begin any text
  if (const ImageFormat* const format = FormatBySignature(file, fewest)) {
    const bool an = std::string_view("AOSi").find(format->name[0]) != std::string_view::npos;
    return ForeignFile{(an ? "an " : "a ") + std::string(format->name) + " picture", kPicture, true};
  }
  for (const Signature& known : kSignatures) {
    if (known.bytes.size() < fewest) continue;
    if (!Holds(file, known.at, known.bytes)) continue;
    return ForeignFile{known.what, known.hint ? known.hint : "", known.hint == kPicture};
  }
  if (Holds(file, 0, "PK\x03\x04") || Holds(file, 0, "PK\x05\x06")) return RecognizeZip(file);
  if (Holds(file, 0, "MM") && file.size() >= 6 && Little(file, 2, 4) == file.size()) {
    return ForeignFile{"a 3DS file", kConvert};
  }
  if (file.find_first_not_of('\0') == std::string_view::npos) {
    return ForeignFile{file.empty() ? "empty" : "zeros throughout", "fetch the file again"};
  }
  std::string_view text = file;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  if (text.starts_with('{')) return std::nullopt;
  const std::string_view start = text.substr(0, kStart);
  if (start.starts_with('<')) return RecognizeMarkup(Lower(start));
  if (IsBinaryStl(file)) return ForeignFile{"an STL file", kConvert};
  if (start.empty() || !is_text) return std::nullopt;
  if (const auto known = RecognizeText(start)) return known;
  constexpr std::size_t kShown = 40;
  std::string line(start.substr(0, std::min(start.find_first_of("\r\n"), kShown)));
  while (!line.empty() && static_cast<unsigned char>(line.back()) >= 0x80) line.pop_back();  // may be cut
  return ForeignFile{"text that begins with \"" + line + "\"", "if a server sent it, fetch the file again"};
}

void RefuseForeignJson(std::string_view file, const std::string& name) {
  const std::size_t first = file.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && (file[first] == '{' || file[first] == '[')) return;
  const auto foreign = RecognizeForeign(file);
  if (!foreign) return;
  const std::string hint = foreign->is_picture ? "" : foreign->hint;
  throw Error(ErrorCode::InvalidInput, "not JSON, but " + foreign->what, name, hint);
}

}  // namespace facet::gltf

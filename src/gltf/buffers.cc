#include "gltf/buffers.h"

#include <algorithm>

#include "gltf/meshopt.h"
#include "gltf/recognize.h"
#include "gltf/uri.h"

namespace facet::gltf {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

BufferView ReadDescription(const Json& object, std::size_t buffer_count, const Place& place) {
  BufferView view;
  view.buffer = RequireIndex(object, "buffer", buffer_count, "buffers", place);
  view.offset = SizeAt(object, "byteOffset", place).value_or(0);
  view.length = RequireSize(object, "byteLength", place);
  view.stride = SizeAt(object, "byteStride", place).value_or(0);  // some exporters write 0
  if (view.stride > 252 || view.stride % 4 != 0) {
    Place(place, "byteStride").Warn(std::to_string(view.stride) + " is not a multiple of 4 up to 252");
  }
  return view;
}

// The existing part of `length` bytes from `offset` on, in a buffer of `size` bytes.
std::size_t Available(std::size_t size, std::size_t offset, std::size_t length) {
  return offset > size ? 0 : std::min(length, size - offset);
}

}  // namespace

BufferStore::BufferStore(Context& context, std::optional<Bytes> bin) : context_(context), bin_(std::move(bin)) {
  const Place buffers_place(context.place, "buffers"), views_place(context.place, "bufferViews");
  context.Charge(context.document.Count("buffers"), sizeof(Buffer), buffers_place);
  buffers_.resize(context.document.Count("buffers"));
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const Json& object = context.Object("buffers", i);
    const Place place(buffers_place, i);
    buffers_[i].has_data = Find(object, "uri") != nullptr || (i == 0 && bin_);
    buffers_[i].declared_length = LenientSize(object, "byteLength", place);
    if (!Find(object, "byteLength")) place.Warn("\"byteLength\" is missing; all that there is counts");
  }
  context.Charge(context.document.Count("bufferViews"), sizeof(View), views_place);
  views_.resize(context.document.Count("bufferViews"));
}

Bytes BufferStore::Load(std::size_t index) {
  const Json& object = context_.Object("buffers", index);
  const Place list_place(context_.place, "buffers");
  const Place place(list_place, index), uri_place(place, "uri");
  const auto uri = StringAt(object, "uri", place);
  if (!uri) {
    if (index == 0 && bin_) return *bin_;
    Fail(place, "has no data");
  }
  if (IsDataUri(*uri)) {
    auto bytes = DecodeDataUri(*uri);
    if (!bytes) Fail(uri_place, "is a malformed data URI");
    return *std::move(bytes);
  }
  const std::filesystem::path path = context_.files.Find(*uri, uri_place);
  try {
    return context_.files.Read(path);
  } catch (const Error& error) {
    if (IsFatal(error)) throw;
    Fail(uri_place, "the file \"" + path.string() + "\" cannot be read: " + error.message(),
         "put the buffer's file beside the glTF file", error.code());
  }
}

const Bytes& BufferStore::Whole(std::size_t index) {
  Buffer& buffer = buffers_[index];
  if (buffer.error) throw Error(*buffer.error);
  if (buffer.bytes) return *buffer.bytes;
  try {
    buffer.bytes = Load(index);
  } catch (const Error& error) {
    buffer.error = error;
    throw;
  }
  if (buffer.declared_length && buffer.bytes->size < *buffer.declared_length) {
    const std::string what =
        "has " + std::to_string(buffer.bytes->size) + " bytes and declares " + std::to_string(*buffer.declared_length);
    const Bytes& bytes = *buffer.bytes;
    const auto foreign = RecognizeForeign(bytes.Text());
    const std::string kind = foreign ? ": it is " + foreign->what + "; " + foreign->hint : std::string();
    buffer.shortage = "buffers[" + std::to_string(index) + "] " + what + (foreign ? kind : ": fetch the file again");
    const Place list_place(context_.place, "buffers");
    Place(list_place, index).Warn(what + kind);
  }
  return *buffer.bytes;
}

Bytes BufferStore::Slice(std::size_t buffer, std::size_t offset, std::size_t length, const Place& place) {
  if (!buffers_[buffer].has_data) Fail(place, "buffers[" + std::to_string(buffer) + "] has no data");
  const Bytes& whole = Whole(buffer);
  return whole.Slice(std::min(offset, whole.size), Available(whole.size, offset, length));
}

const BufferView& BufferStore::Describe(int index) {
  const auto i = static_cast<std::size_t>(index);
  std::optional<BufferView>& known = views_[i].description;
  if (known) return *known;
  const Place list_place(context_.place, "bufferViews");
  const Place place(list_place, i);
  const BufferView view = ReadDescription(context_.Object("bufferViews", i), buffers_.size(), place);
  const auto declared = buffers_[static_cast<std::size_t>(view.buffer)].declared_length;
  if (declared && Available(*declared, view.offset, view.length) < view.length) {
    place.Warn("its " + std::to_string(view.length) + " bytes from byte " + std::to_string(view.offset) +
               " on reach past the " + std::to_string(*declared) + " of buffers[" + std::to_string(view.buffer) +
               "]; those that are there are read");
  }
  return known.emplace(view);
}

bool BufferStore::HasData(int index) {
  const BufferView& view = Describe(index);
  if (buffers_[static_cast<std::size_t>(view.buffer)].has_data) return true;
  const auto i = static_cast<std::size_t>(index);
  const Place list_place(context_.place, "bufferViews");
  return ExtensionOf(context_.Object("bufferViews", i), kMeshopt, Place(list_place, i)) != nullptr;
}

std::size_t BufferStore::Size(int index) {
  const BufferView& view = Describe(index);
  const Buffer& buffer = buffers_[static_cast<std::size_t>(view.buffer)];
  const auto i = static_cast<std::size_t>(index);
  const Place list_place(context_.place, "bufferViews");
  const bool is_packed = ExtensionOf(context_.Object("bufferViews", i), kMeshopt, Place(list_place, i)) != nullptr;
  return is_packed || !buffer.declared_length ? view.length
                                              : Available(*buffer.declared_length, view.offset, view.length);
}

std::string BufferStore::Shortage(int index) {
  return buffers_[static_cast<std::size_t>(Describe(index).buffer)].shortage;
}

// Nothing if the view is not compressed, or if its compressed data is damaged and there is an uncompressed fallback.
std::optional<Bytes> BufferStore::Unpack(std::size_t index, const Place& place) {
  const Json* compression = ExtensionOf(context_.Object("bufferViews", index), kMeshopt, place);
  if (!compression) return std::nullopt;
  const BufferView& view = Describe(static_cast<int>(index));
  const Place extensions_place(place, "extensions");
  const Place meshopt_place(extensions_place, kMeshopt);
  std::optional<Bytes> bytes;
  const bool has_fallback = buffers_[static_cast<std::size_t>(view.buffer)].has_data && !context_.IsRequired(kMeshopt);
  context_.Try(!has_fallback, meshopt_place, "the uncompressed data is used", [&] {
    const MeshoptView description = ReadMeshoptView(*compression, buffers_.size(), meshopt_place);
    if (description.stride == 0 || description.count > view.length / description.stride ||
        description.count * description.stride != view.length) {
      Fail(meshopt_place, "count times byteStride is not the buffer view's byteLength");
    }
    const Bytes packed =
        Slice(static_cast<std::size_t>(description.buffer), description.offset, description.length, meshopt_place);
    CheckMeshoptSize(description, meshopt_place);
    const std::size_t before = context_.Charged();
    context_.Charge(description.count, description.stride, meshopt_place);
    bytes = DecodeMeshopt(description, packed, meshopt_place);
    context_.KeepSince(before);
  });
  return bytes;
}

const Bytes& BufferStore::Read(int index) {
  const BufferView& view = Describe(index);
  std::optional<Bytes>& bytes = views_[static_cast<std::size_t>(index)].bytes;
  if (bytes) return *bytes;
  const Place list_place(context_.place, "bufferViews");
  const Place place(list_place, static_cast<std::size_t>(index));
  bytes = Unpack(static_cast<std::size_t>(index), place);
  if (!bytes) bytes = Slice(static_cast<std::size_t>(view.buffer), view.offset, view.length, place);
  return *bytes;
}

void BufferStore::CheckUnused() {
  const Place views_place(context_.place, "bufferViews"), buffers_place(context_.place, "buffers");
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (views_[i].description) continue;
    context_.TryUnused(Place(views_place, i), "nothing reads it", [&] { Describe(static_cast<int>(i)); });
  }
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    if (buffers_[i].bytes || buffers_[i].error) continue;
    const Place place(buffers_place, i);
    const auto uri = LenientString(context_.Object("buffers", i), "uri", place);
    if (!uri) continue;
    const Place uri_place(place, "uri");
    if (IsDataUri(*uri)) {
      if (IsMalformedDataUri(*uri)) uri_place.Warn("is a malformed data URI, and nothing reads it");
      continue;
    }
    context_.TryUnused(uri_place, "nothing reads it", [&] {
      const std::filesystem::path path = context_.files.Find(*uri, uri_place);
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(path, ignored)) {
        Fail(uri_place, "the file \"" + path.string() + "\" is not there");
      }
    });
  }
}

}  // namespace facet::gltf

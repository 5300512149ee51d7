#include "gltf/buffers.h"

#include "gltf/meshopt.h"
#include "gltf/uri.h"

namespace facet::gltf {

BufferStore::BufferStore(Context& context, std::optional<Bytes> bin) : context_(context) {
  const Json* list = Find(context.document.root, "buffers");
  const std::size_t count = list ? list->size() : 0;
  for (std::size_t i = 0; i < count; ++i) buffers_.push_back(LoadBuffer(i, bin));
  views_.resize(context.document.core.bufferViews.size());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const auto& view = context.document.core.bufferViews[i];
    const Place list_place(context.place, "bufferViews");
    const Place place(list_place, i);
    const std::size_t length = buffers_[static_cast<std::size_t>(view.buffer)].declared_length;
    if (view.byteOffset > length || view.byteLength > length - view.byteOffset) {
      Fail(place, "bytes " + std::to_string(view.byteOffset) + " to " +
                      std::to_string(view.byteOffset + view.byteLength) + " reach past the " + std::to_string(length) +
                      " bytes of buffers[" + std::to_string(view.buffer) + "]");
    }
  }
}

BufferStore::Buffer BufferStore::LoadBuffer(std::size_t index, const std::optional<Bytes>& bin) {
  const Json& object = context_.Object("buffers", index);
  const Place list_place(context_.place, "buffers");
  const Place place(list_place, index);
  Buffer buffer;
  buffer.declared_length = RequireSize(object, "byteLength", place);
  if (const auto uri = StringAt(object, "uri", place)) {
    const Place uri_place(place, "uri");
    if (IsDataUri(*uri)) {
      auto bytes = DecodeDataUri(*uri);
      if (!bytes) Fail(uri_place, "is a malformed data URI");
      buffer.bytes = *std::move(bytes);
    } else {
      const auto path = ResolveRelative(context_.path.parent_path(), *uri);
      if (!path) Fail(uri_place, "is not a relative path", "put the buffer's file beside the glTF file");
      try {
        buffer.bytes = ReadWholeFile(*path);
      } catch (const Error& error) {
        Fail(uri_place, "the file \"" + path->string() + "\" cannot be read: " + error.message(),
             "put the buffer's file beside the glTF file", error.code());
      }
      context_.report.file_bytes += buffer.bytes.size;
    }
    buffer.present = true;
  } else if (index == 0 && bin) {
    buffer.bytes = *bin;
    buffer.present = true;
  }
  if (buffer.present && buffer.bytes.size < buffer.declared_length) {
    Fail(place,
         "has " + std::to_string(buffer.bytes.size) + " bytes and declares " + std::to_string(buffer.declared_length),
         "fetch the file again");
  }
  return buffer;
}

Bytes BufferStore::Slice(std::size_t buffer, std::size_t offset, std::size_t length, const Place& place) const {
  const Buffer& from = buffers_[buffer];
  if (!from.present) Fail(place, "buffers[" + std::to_string(buffer) + "] has no data");
  if (offset > from.declared_length || length > from.declared_length - offset) {
    Fail(place, "reaches past the end of buffers[" + std::to_string(buffer) + "]");
  }
  return from.bytes.Slice(offset, length);
}

bool BufferStore::HasData(int index) const {
  const auto i = static_cast<std::size_t>(index);
  if (buffers_[static_cast<std::size_t>(context_.document.core.bufferViews[i].buffer)].present) return true;
  const Place list_place(context_.place, "bufferViews");
  return ExtensionOf(context_.Object("bufferViews", i), "EXT_meshopt_compression", Place(list_place, i)) != nullptr;
}

const Bytes& BufferStore::View(int index) {
  const auto i = static_cast<std::size_t>(index);
  if (views_[i]) return *views_[i];
  const auto& view = context_.document.core.bufferViews[i];
  const Place list_place(context_.place, "bufferViews");
  const Place place(list_place, i);
  constexpr const char* kMeshopt = "EXT_meshopt_compression";
  if (const Json* compression = ExtensionOf(context_.Object("bufferViews", i), kMeshopt, place)) {
    const Place extensions_place(place, "extensions");
    const Place meshopt_place(extensions_place, kMeshopt);
    try {
      const MeshoptView description = ReadMeshoptView(*compression, buffers_.size(), meshopt_place);
      if (description.stride == 0 || description.count > view.byteLength / description.stride ||
          description.count * description.stride != view.byteLength) {
        Fail(meshopt_place, "count times byteStride is not the buffer view's byteLength");
      }
      const Bytes packed =
          Slice(static_cast<std::size_t>(description.buffer), description.offset, description.length, meshopt_place);
      CheckMeshoptSize(description, meshopt_place);
      context_.Charge(description.count, description.stride, meshopt_place);
      views_[i] = DecodeMeshopt(description, packed, meshopt_place);
      return *views_[i];
    } catch (const Error& error) {
      const bool has_fallback = buffers_[static_cast<std::size_t>(view.buffer)].present;
      if (!has_fallback || context_.IsRequired(kMeshopt) || error.code() == ErrorCode::OutOfMemory) throw;
      context_.Warn(meshopt_place, error.message() + "; the uncompressed data is used");
    }
  }
  views_[i] = Slice(static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength, place);
  return *views_[i];
}

}  // namespace facet::gltf

#include "gltf/meshopt.h"

#include <meshoptimizer.h>

#include "gltf/meshopt_filters.h"

namespace facet::gltf {

MeshoptView ReadMeshoptView(const Json& object, std::size_t buffer_count, const Place& place) {
  MeshoptView view;
  view.buffer = RequireIndex(object, "buffer", buffer_count, "buffers", place);
  view.offset = SizeAt(object, "byteOffset", place).value_or(0);
  view.length = RequireSize(object, "byteLength", place);
  view.stride = RequireSize(object, "byteStride", place);
  view.count = RequireSize(object, "count", place);

  const std::string mode = RequireString(object, "mode", place);
  if (mode == "ATTRIBUTES") {
    view.mode = MeshoptMode::Attributes;
  } else if (mode == "TRIANGLES") {
    view.mode = MeshoptMode::Triangles;
  } else if (mode == "INDICES") {
    view.mode = MeshoptMode::Indices;
  } else {
    Fail(Place(place, "mode"), "is not a mode that the extension knows");
  }
  const std::string filter = StringAt(object, "filter", place).value_or("NONE");
  if (filter == "OCTAHEDRAL") {
    view.filter = MeshoptFilter::Octahedral;
  } else if (filter == "QUATERNION") {
    view.filter = MeshoptFilter::Quaternion;
  } else if (filter == "EXPONENTIAL") {
    view.filter = MeshoptFilter::Exponential;
  } else if (filter != "NONE") {
    Fail(Place(place, "filter"), "is not a filter that the extension knows");
  }

  const Place stride_place(place, "byteStride");
  if (view.mode == MeshoptMode::Attributes) {
    if (view.stride == 0 || view.stride > 256 || view.stride % 4 != 0) {
      Fail(stride_place, "is not a multiple of 4 in [4, 256]");
    }
  } else {
    if (view.stride != 2 && view.stride != 4) Fail(stride_place, "of indices is neither 2 nor 4");
    if (view.filter != MeshoptFilter::None) Fail(Place(place, "filter"), "is for attributes only");
  }
  if (view.mode == MeshoptMode::Triangles && view.count % 3 != 0) {
    Fail(Place(place, "count"), "is not a multiple of 3");
  }
  if (view.filter == MeshoptFilter::Octahedral && view.stride != 4 && view.stride != 8) {
    Fail(stride_place, "of octahedral vectors is neither 4 nor 8");
  }
  if (view.filter == MeshoptFilter::Quaternion && view.stride != 8) Fail(stride_place, "of quaternions is not 8");
  return view;
}

void CheckMeshoptSize(const MeshoptView& view, const Place& place) {
  // The codecs' best cases: 2 bits for 16 bytes of attributes; a byte a triangle; a byte an index.
  std::size_t least = 0;
  switch (view.mode) {
    case MeshoptMode::Attributes: least = view.count / 64 * view.stride; break;
    case MeshoptMode::Triangles: least = view.count / 3; break;
    case MeshoptMode::Indices: least = view.count; break;
  }
  if (least > view.length) {
    Fail(place, std::to_string(view.length) + " bytes cannot hold " + std::to_string(view.count) + " elements");
  }
}

Bytes DecodeMeshopt(const MeshoptView& view, const Bytes& packed, const Place& place) {
  MutableBytes bytes = AllocateBytes(view.count * view.stride);
  const auto* source = reinterpret_cast<const unsigned char*>(packed.data);
  int status = 0;
  switch (view.mode) {
    case MeshoptMode::Attributes:
      status = meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, source, packed.size);
      break;
    case MeshoptMode::Triangles:
      status = meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, source, packed.size);
      break;
    case MeshoptMode::Indices:
      status = meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, source, packed.size);
      break;
  }
  if (status != 0) Fail(place, "the compressed data is damaged", "pack the file again");
  const std::span<std::byte> elements(bytes.data(), bytes.size);
  switch (view.filter) {
    case MeshoptFilter::None: break;
    case MeshoptFilter::Octahedral: (view.stride == 4 ? DecodeOctahedral8 : DecodeOctahedral16)(elements); break;
    case MeshoptFilter::Quaternion: DecodeQuaternions(elements); break;
    case MeshoptFilter::Exponential: DecodeExponential(elements); break;
  }
  return bytes.Freeze();
}

}  // namespace facet::gltf

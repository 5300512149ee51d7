// What passes between facet and its OpenImageIO module (facet_oiio.so): plain C, so that neither exceptions nor a
// library's types cross. The module keeps OpenImageIO's 261 shared libraries out of every start that needs none of
// them.
#pragma once

#include <stddef.h>
#include <stdint.h>

extern "C" {

#define FACET_OIIO_ABI_VERSION 1

// width * height * channels interleaved numbers, top row first, no padding; alpha straight.
struct FacetOiioPicture {
  int32_t width, height, channels;
  int32_t type;      // facet::ChannelType
  int32_t encoding;  // facet::Encoding
  void* pixels;
  size_t size;  // bytes
};

enum FacetOiioResult {
  FACET_OIIO_OK = 0,
  FACET_OIIO_INVALID_INPUT = 1,
  FACET_OIIO_TOO_LARGE = 2,
  FACET_OIIO_OUTPUT_FAILED = 3,
  FACET_OIIO_UNSUPPORTED = 4,
};

// FACET_OIIO_ABI_VERSION of the module.
typedef int32_t (*FacetOiioAbiVersion)(void);

// Decodes a whole file in memory. `name` helps only formats that have no signature. On success `picture->pixels`
// belongs to the caller, who gives it back to FacetOiioFree. On failure `message` (message_size bytes, at least 1) is
// one line.
typedef int32_t (*FacetOiioDecode)(const void* bytes, size_t size, const char* name, int32_t max_side,
                                   uint64_t max_pixels, FacetOiioPicture* picture, char* message, size_t message_size);

// Writes `picture` to `path`, the extension of which says the format. premultiplied: its alpha is associated.
typedef int32_t (*FacetOiioEncode)(const char* path, const FacetOiioPicture* picture, int32_t premultiplied,
                                   char* message, size_t message_size);

typedef void (*FacetOiioFree)(void* pixels);

}  // extern "C"

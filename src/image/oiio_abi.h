// The interface between facet and its OpenImageIO module (facet_oiio.so). It is plain C, so that neither exceptions nor
// types of a library cross it. Thanks to the module, a process that does not need OpenImageIO does not load its 261
// shared libraries.
#pragma once

#include <stddef.h>
#include <stdint.h>

extern "C" {

#define FACET_OIIO_ABI_VERSION 2

// The header of a file.
struct FacetOiioText {
  const char* keyword;
  const char* value;
};

// width * height * channels interleaved components, top row first, without padding; alpha is straight.
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

// Decodes a file in memory. `extension` selects OpenImageIO's reader. Fails if the decoded pixels take more than
// max_bytes. as_stored: associated alpha stays associated. On success the caller owns `picture->pixels`, and passes it
// to FacetOiioFree at the end. On failure `message` (message_size bytes, at least 1) is set to one line.
typedef int32_t (*FacetOiioDecode)(const void* bytes, size_t size, const char* extension, int32_t max_side,
                                   uint64_t max_pixels, uint64_t max_bytes, int32_t as_stored,
                                   FacetOiioPicture* picture, char* message, size_t message_size);

// Encodes a file in memory in the format that `extension` names; the caller owns `*bytes`, as above. premultiplied: the
// image's alpha is associated.
typedef int32_t (*FacetOiioEncode)(const char* extension, const FacetOiioPicture* picture, int32_t premultiplied,
                                   const FacetOiioText* text, size_t text_count, void** bytes, size_t* size,
                                   char* message, size_t message_size);

typedef void (*FacetOiioFree)(void* pixels);

}  // extern "C"

// KTX2, a container of textures (Khronos KTX File Format Specification 2.0 and Data Format Specification 1.3). Its
// header alone is read.
#pragma once

#include "facet/image.h"
#include "image/file_start.h"

namespace facet {

// See ImageFormat::probe.
void ProbeKtx2(const FileStart& file, ImageHeader& header);

}  // namespace facet

#include "facet/version.h"

namespace facet {

const char* Version() { return FACET_VERSION; }

}  // namespace facet

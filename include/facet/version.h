#pragma once

namespace facet {

// "MAJOR.MINOR.PATCH" of the library that is linked.
const char* Version();

}  // namespace facet

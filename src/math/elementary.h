// Deterministic elementary functions of double for the host: never std::sin and its like in the rendering path, whose
// last bits differ between versions of the C library and between processors.
#pragma once

#include "facet/shader/elementary_double.h"

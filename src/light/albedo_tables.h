// The albedo tables that only some materials need.
#pragma once

namespace facet {

// Those that the materials of a frame need besides the DfgTable, which all have.
struct AlbedoTables {
  bool sheen = false;            // SheenTable
  bool anisotropic_dfg = false;  // AnisotropicDfgTable
  bool schlick_dfg[2] = {};      // SharedSchlickDfgTable() of either LectureAlpha
  bool cloth = false;            // SheenTable of Filament's fibres
};

}  // namespace facet

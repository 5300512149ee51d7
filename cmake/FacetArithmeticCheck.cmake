# The picture's bits rest on IEEE 754 as it is written, and on one baseline for every object file. This refuses compiler
# flags that give up either, wherever they were set: on the command line, in CXXFLAGS, or by a project that adds facet.
# What a flag cannot tell is left to include/facet/shader/arithmetic_check.h.
# (Names stand without their dash.)
set(_facet_changes_results ffast-math Ofast funsafe-math-optimizations fassociative-math freciprocal-math
  ffinite-math-only fno-signed-zeros mrecip fsingle-precision-constant mdaz-ftz fexcess-precision=fast
  "ffp-contract=(fast|on)" "ffp-model=(fast|aggressive)" "fdenormal-fp-math=.*" "mfpmath=.*387.*")
set(_facet_changes_baseline "march=.*" "mcpu=.*" "m(fma|fma4|avx|sse3|ssse3|sse4|bmi|f16c|xop|sve).*")

get_directory_property(_facet_options COMPILE_OPTIONS)
set(_facet_flags "${CMAKE_CXX_FLAGS} ${_facet_options}")
foreach(_facet_build IN ITEMS DEBUG RELEASE RELWITHDEBINFO MINSIZEREL)
  string(APPEND _facet_flags " ${CMAKE_CXX_FLAGS_${_facet_build}}")
endforeach()
string(REGEX MATCHALL "[^ ;]+" _facet_flags "${_facet_flags}")
list(JOIN _facet_changes_results "|" _facet_changes_results)
list(JOIN _facet_changes_baseline "|" _facet_changes_baseline)
foreach(_facet_flag IN LISTS _facet_flags)
  if(_facet_flag MATCHES "^-(${_facet_changes_results})$")
    message(FATAL_ERROR "facet cannot be compiled with ${_facet_flag}: it changes the results of floating-point "
      "arithmetic, and facet's pictures are the same to the last bit everywhere. Take it out of the compiler's flags.")
  elseif(_facet_flag MATCHES "^-(${_facet_changes_baseline})$")
    message(FATAL_ERROR "facet cannot be compiled with ${_facet_flag}: it holds code for every instruction set and "
      "chooses when it runs. Take it out of the compiler's flags.")
  endif()
endforeach()

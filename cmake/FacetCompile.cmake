# How every target of facet is compiled. facet_room() makes one library per folder of src/.
include(FacetArithmeticCheck)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
if(NOT CMAKE_BUILD_TYPE AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_BUILD_TYPE Release)
endif()

# The picture's bits: the same arithmetic with every compiler and instruction set. Whoever compiles a shader of their own
# gets these flags from facet::core.
set(FACET_HIGHWAY_DEFINITIONS
  HWY_COMPILE_ALL_ATTAINABLE                     # the scalar target too, everywhere
  HWY_BROKEN_EMU128=1                            # scalar code means one lane, with every compiler
  HWY_IS_DEBUG_BUILD=0                           # its assertions need its library, which nobody else does
  HWY_DISABLED_TARGETS=HWY_SSSE3|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128${FACET_DISABLED_TARGETS})

add_library(facet_arithmetic INTERFACE)
add_library(facet::arithmetic ALIAS facet_arithmetic)
set_target_properties(facet_arithmetic PROPERTIES EXPORT_NAME arithmetic)
target_compile_options(facet_arithmetic INTERFACE -ffp-contract=off -fno-fast-math)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)")
  # Float{} is zero: GCC must not drop that because Highway's vectors have a constructor here, one that sets nothing.
  target_compile_options(facet_arithmetic INTERFACE $<$<CXX_COMPILER_ID:GNU>:-flifetime-dse=1>)
endif()
target_compile_features(facet_arithmetic INTERFACE cxx_std_20)
if(FACET_SCALAR_ONLY)
  target_compile_definitions(facet_arithmetic INTERFACE HWY_COMPILE_ONLY_SCALAR HWY_IS_DEBUG_BUILD=0 FACET_SCALAR_ONLY)
else()
  target_compile_definitions(facet_arithmetic INTERFACE ${FACET_HIGHWAY_DEFINITIONS})
endif()
# See facet/shader/inline.h.
if(FACET_SANITIZE)
  target_compile_definitions(facet_arithmetic INTERFACE FACET_MAY_INLINE)
else()
  target_compile_definitions(facet_arithmetic INTERFACE $<$<CONFIG:Debug>:FACET_MAY_INLINE>)
endif()
target_include_directories(facet_arithmetic INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS facet_arithmetic EXPORT facetTargets)

add_library(facet_warnings INTERFACE)
target_compile_options(facet_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual -Wformat=2 -Wno-psabi -Wno-unknown-pragmas -Wno-unused-function)
if(FACET_SANITIZE)
  add_compile_options(-fsanitize=${FACET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FACET_SANITIZE})
endif()
# What stands before the programs that run while facet is built. Under the thread sanitizer those would end with a failure,
# by races inside TBB that are none.
set(FACET_RUN_WHILE_BUILDING)
if(FACET_SANITIZE MATCHES "thread")
  set(FACET_RUN_WHILE_BUILDING ${CMAKE_COMMAND} -E env
    TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp:ignore_noninstrumented_modules=1)
endif()

# The headers of others that most rooms read, compiled once. What a file uses it includes by itself all the same: the
# smallest build (tests/package/core_alone) goes without.
add_library(facet_precompiled OBJECT ${PROJECT_SOURCE_DIR}/src/precompiled.cc)
target_link_libraries(facet_precompiled PRIVATE facet::arithmetic facet_warnings)
target_precompile_headers(facet_precompiled PRIVATE ${PROJECT_SOURCE_DIR}/src/precompiled.h)

# facet_room(NAME [CORE] SOURCES file... [DEPENDS room-or-library...] [PRIVATE library...])
# One static library per room; DEPENDS must be earlier rooms. CORE rooms make up facet::core.
function(facet_room name)
  cmake_parse_arguments(ROOM "CORE" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
  add_library(facet_${name} STATIC ${ROOM_SOURCES})
  add_library(facet::${name} ALIAS facet_${name})
  set_target_properties(facet_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(facet_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(facet_${name} PUBLIC facet::arithmetic ${ROOM_DEPENDS})
  target_link_libraries(facet_${name} PRIVATE $<BUILD_INTERFACE:facet_warnings> ${ROOM_PRIVATE})
  target_precompile_headers(facet_${name} REUSE_FROM facet_precompiled)
  install(TARGETS facet_${name} EXPORT facetTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  if(ROOM_CORE)
    set_property(GLOBAL APPEND PROPERTY FACET_CORE_ROOMS facet_${name})
  endif()
endfunction()

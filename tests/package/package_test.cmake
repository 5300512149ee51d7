# cmake -P: see CMakeLists.txt beside it.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${prefix})

# Nothing of the source or build tree may be named by what is installed.
file(GLOB_RECURSE configs ${prefix}/*/cmake/facet/*.cmake)
if(NOT configs)
  message(FATAL_ERROR "no package configuration under ${prefix}")
endif()
foreach(config IN LISTS configs)
  file(READ ${config} text)
  string(FIND "${text}" "${BINARY_DIR}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${config} names the build tree")
  endif()
endforeach()

set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=${SANITIZE}")
endif()
function(build name)
  run(${CMAKE_COMMAND} -S ${TEST_DIR}/${name} -B ${WORK_DIR}/${name} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
      -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${prefix} "-DCMAKE_CXX_FLAGS=${flags}" ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${name})
endfunction()

build(consumer)
run(${WORK_DIR}/consumer/consumer)
message(STATUS "${output}")

# With files, and the scene that was installed.
build(file_consumer -DEXAMPLES=${EXAMPLES})
file(GLOB scene ${prefix}/share/facet/scenes/showcase.glb)
run(${WORK_DIR}/file_consumer/file_consumer ${scene} ${WORK_DIR}/showcase.png)
message(STATUS "${output}")
run(${WORK_DIR}/file_consumer/shader_consumer ${scene} ${WORK_DIR}/toon.png)
message(STATUS "${output}")

# A shader of one's own in a project that says nothing of optimisation, and in one that wants none: the same picture.
foreach(type IN ITEMS None Debug)
  run(${CMAKE_COMMAND} -S ${TEST_DIR}/file_consumer -B ${WORK_DIR}/file_consumer_${type} -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_BUILD_TYPE=${type} -DCMAKE_PREFIX_PATH=${prefix}
      "-DCMAKE_CXX_FLAGS=${flags}" -DEXAMPLES=${EXAMPLES})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/file_consumer_${type} --target shader_consumer)
  run(${WORK_DIR}/file_consumer_${type}/shader_consumer ${scene} ${WORK_DIR}/toon_${type}.png)
  run(${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/toon.png ${WORK_DIR}/toon_${type}.png)
endforeach()

# What the README leads to is there.
foreach(page IN ITEMS README.md docs/library.md docs/golden-tests.md docs/examples/toon.h docs/pictures/showcase.jpg)
  if(NOT EXISTS ${prefix}/share/doc/facet/${page})
    message(FATAL_ERROR "${page} is not among the installed documentation")
  endif()
endforeach()

# The program, as it was installed.
run(${prefix}/bin/facet info ${scene})
run(${prefix}/bin/facet render ${scene} -o ${WORK_DIR}/program.png --size 64x64)

# facet::core brings TBB and the runtime of the compiler, nothing else.
if(NOT SANITIZE)
  run(${READELF} -d ${WORK_DIR}/consumer/consumer)
  string(REGEX MATCHALL "Shared library: \\[[^]]+\\]" needed "${output}")
  if(NOT needed)
    message(FATAL_ERROR "no shared libraries listed:\n${output}")
  endif()
  foreach(entry IN LISTS needed)
    string(REGEX REPLACE ".*\\[(.*)\\]" "\\1" library "${entry}")
    if(NOT library MATCHES "^(libtbb|libstdc\\+\\+|libc\\+\\+|libgcc_s|libm|libc|libpthread|libdl|ld-linux[^.]*)\\.so")
      message(FATAL_ERROR "a program that links facet::core alone needs ${library}")
    endif()
  endforeach()
endif()

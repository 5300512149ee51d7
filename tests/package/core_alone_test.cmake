# cmake -P: builds core_alone/ from the sources, runs it, and sees that it needs no shared library.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${TEST_DIR}/core_alone -B ${WORK_DIR} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    -DCMAKE_BUILD_TYPE=MinSizeRel -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DFACET=${FACET})
run(${CMAKE_COMMAND} --build ${WORK_DIR} --target consumer)
file(GLOB_RECURSE consumer LIST_DIRECTORIES false ${WORK_DIR}/consumer)
list(FILTER consumer INCLUDE REGEX "/consumer$")
list(GET consumer 0 consumer)
run(${consumer})
message(STATUS "${output}")
run(${READELF} -d ${consumer})
if(output MATCHES "Shared library")
  message(FATAL_ERROR "a static program needs shared libraries:\n${output}")
endif()

# SPDX-License-Identifier: MIT
# Configures, builds and runs the consumer KIND in the scratch folder WORK.
cmake_minimum_required(VERSION 3.22)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message("${command}\n${output}")
    message(FATAL_ERROR "failed: ${code}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix_path ${PREFIX_PATH})
if(KIND MATCHES "find_package")
  if(NOT INSTALLS)
    message("skipped: SPHMBS_INSTALL is OFF")
    return()
  endif()
  # Installed in one place and used from another: the package must be relocatable.
  run(${CMAKE_COMMAND} --install ${BUILT} --config ${CONFIG} --prefix ${WORK}/staged)
  file(RENAME ${WORK}/staged ${WORK}/installed)
  list(PREPEND prefix_path ${WORK}/installed)
  file(GLOB_RECURSE installed ${WORK}/installed/*.cmake)
  foreach(file IN LISTS installed)
    file(READ ${file} text)
    string(FIND "${text}" "${SOURCE}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names the source folder ${SOURCE}")
    endif()
  endforeach()
endif()

run(${CMAKE_COMMAND} -S ${SOURCE}/tests/consumers/${KIND} -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D "CMAKE_PREFIX_PATH=${prefix_path}"
  -D SPHMBS_SOURCE=${SOURCE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

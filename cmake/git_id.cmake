# SPDX-License-Identifier: MIT
# cmake -D SOURCE=<repository> -D HEADER=<file> -P git_id.cmake
# Run at each build: writes the commit into HEADER, with "+" where files are changed, and leaves the
# file alone if it says so already. Without git, or outside a repository, the text is empty.
cmake_minimum_required(VERSION 3.22)
set(id "")
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${git} -C ${SOURCE} describe --always --dirty=+ --exclude=*
    OUTPUT_VARIABLE id OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT
  "// SPDX-License-Identifier: MIT\n#pragma once\n#define SPHMBS_GIT_ID \"${id}\"\n")
